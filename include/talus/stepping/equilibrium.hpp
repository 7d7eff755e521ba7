// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/problem/islands.hpp>
#include <talus/stepping/moreau_midpoint.hpp>
#include <talus/stepping/simulation_types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// Answer of the one-step equilibrium test.
enum class Verdict {
    equilibrium,  ///< the forces found hold the bodies: a *possible* equilibrium, stable or not
    moving,       ///< something moves, faster than the error of the forces can explain
    undecided,    ///< the forces or the gaps are not accurate enough for either, see `reason`
};

/// The word for a verdict, as its enumerator is written.
constexpr std::string_view to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::equilibrium:
            return "equilibrium";
        case Verdict::moving:
            return "moving";
        case Verdict::undecided:
            return "undecided";
    }
    return "unknown";
}

/// Settings of the equilibrium test.
struct EquilibriumParams {
    /// Step size [s]; `equilibrium` and `moving` do not depend on it. Give that of a simulation for
    /// what it has left.
    double h = 1e-3;
    /// Largest end speed, relative to the speed that the loads alone would give in the step, that
    /// counts as rest, and largest residual of forces that count as found [-].
    double rest = 1e-9;
    /// Gap below which a contact counts as closed [m]. Unless given, 1e-9 of the bodies' mean
    /// bounding radius and what rounding makes of their coordinates: bodies placed "exactly" in
    /// touch are in touch. What moves by that, and would rest if the gaps that a simulation leaves
    /// (`closed_gap`) were closed, is undecided.
    std::optional<double> contact_tolerance = std::nullopt;
};

/// What the test found.
template <int Dim, class Law>
struct EquilibriumReport {
    Verdict verdict = Verdict::undecided;
    std::string reason;       ///< of the verdict, in a sentence
    double speed = 0.0;       ///< largest point speed at the end of the step [m/s]
    double load_speed = 0.0;  ///< the same if there were no contacts [m/s]
    /// Largest point speed relative to that of the loads on the bodies connected by contacts [-].
    double relative_speed = 0.0;
    double residual = 0.0;    ///< of the contact forces [-]
    StepData<Dim, Law> data;  ///< contacts and impulses; divide those by h for forces

    /// Contact force of contact c in its local frame [N].
    Vector<Dim> mean_reaction(std::size_t c) const { return data.impulse[c] / data.h; }
};

namespace detail {

/// Speed of the fastest point of each body; 0 for obstacles [m/s].
template <int Dim, class Law, class ShapeType>
std::vector<double> point_speeds(const System<Dim, Law, ShapeType>& system,
                                 std::span<const Twist<Dim>> twists) {
    std::vector<double> speed(twists.size(), 0.0);
    for (std::size_t i = 0; i < twists.size(); ++i) {
        if (system.bodies.is_obstacle(i)) continue;
        const double spin = twists[i].angular.norm();
        speed[i] =
            twists[i].linear.norm() + (spin > 0.0 ? spin * system.bounding_radius()[i] : 0.0);
    }
    return speed;
}

/// How fast bodies move that contacts connect.
struct IslandSpeed {
    double relative = 0.0;  ///< largest speed over the largest that loads alone would give [-]
    /// How many times its own size an error of the forces may show in the velocities: along a chain
    /// of n contacts, as in a tower, some n^2 times (the condition of its W). Where it shows more,
    /// near a threshold, the residual of an undecided answer tells.
    double amplification = 100.0;

    double over_errors() const { return relative / amplification; }
};

/// Of the islands of bodies the fastest, and the one that errors of the forces explain least.
struct IslandSpeeds {
    IslandSpeed fastest, least_explained;
};
template <int Dim>
IslandSpeeds island_speeds(const Bodies<Dim>& bodies, const ContactSet<Dim>& contacts,
                           std::span<const double> speed, std::span<const double> load) {
    Islands islands;
    islands.reset(speed.size());
    for (const ContactKey& key : contacts.key) {
        const auto a = static_cast<std::size_t>(key.a), b = static_cast<std::size_t>(key.b);
        if (!bodies.is_obstacle(a) && !bodies.is_obstacle(b)) islands.join(a, b);
    }
    std::vector<double> most(speed.size(), 0.0), loaded(speed.size(), 0.0),
        count(speed.size(), 0.0);
    for (const ContactKey& key : contacts.key) {
        const auto a = static_cast<std::size_t>(key.a), b = static_cast<std::size_t>(key.b);
        count[islands.root(bodies.is_obstacle(a) ? b : a)] += 1.0;
    }
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const std::size_t island = islands.root(i);
        most[island] = std::max(most[island], speed[i]);
        loaded[island] = std::max(loaded[island], load[i]);
    }
    IslandSpeeds found;
    for (std::size_t i = 0; i < speed.size(); ++i) {
        if (!(most[i] > 0.0)) continue;
        const IslandSpeed island{most[i] / loaded[i], std::max(100.0, count[i] * count[i])};
        if (island.relative > found.fastest.relative) found.fastest = island;
        if (island.over_errors() > found.least_explained.over_errors())
            found.least_explained = island;
    }
    return found;
}

/// Gap of bodies that are in touch but for rounding [m].
template <int Dim, class Law, class ShapeType>
double touching_gap(const System<Dim, Law, ShapeType>& system) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        const double radius = system.bounding_radius()[i];
        farthest = std::max(
            farthest, system.bodies.position[i].norm() + (std::isfinite(radius) ? radius : 0.0));
    }
    return 1e-9 * system.mean_bounding_radius() +
           16.0 * std::numeric_limits<double>::epsilon() * farthest;
}

/// Verdict and reason from the numbers of a report.
template <int Dim, class Law>
void decide(EquilibriumReport<Dim, Law>& report, const IslandSpeed& moving, double rest) {
    const double error = std::max(report.residual, report.data.report.contact_error);
    const std::string found = "bodies move at " + text_of(report.relative_speed) +
                              " of the speed that the loads alone would give, the residual is " +
                              text_of(report.residual) + ", at the worst contact " +
                              text_of(report.data.report.contact_error);
    if (report.data.report.status == SolveStatus::no_solution) {
        report.reason = "no forces obey all laws: " + found;
    } else if (report.relative_speed <= rest && report.residual <= rest) {
        report.verdict = Verdict::equilibrium;
        report.reason = "forces that hold all bodies were found: " + found;
    } else if (moving.relative > std::max(rest, moving.amplification * error)) {
        report.verdict = Verdict::moving;
        report.reason = "something moves: " + found;
    } else {
        report.reason =
            "the forces are not accurate enough to tell: " + found + ", but must be below " +
            text_of(rest) + " for rest, and the speed above " + text_of(moving.amplification) +
            " times the errors for motion: allow more iterations, or take Automatic, if this was "
            "not, as near a threshold sweeps converge slowly; on it there is no telling";
    }
}

/// The step of the test, from rest, and what follows from it.
template <int Dim, class Law, class ShapeType, class Solver, class Hooks>
EquilibriumReport<Dim, Law> one_step(System<Dim, Law, ShapeType> system, const StepParams& step,
                                     const EquilibriumParams& params, Solver solver,
                                     const ImpulseCache<Dim>& start, const Hooks& hooks) {
    MoreauMidpoint<Dim, Law, ShapeType, HierarchicalGrid<Dim>, Hooks> integrator;
    integrator.hooks() = hooks;
    integrator.warm_start().impulses() = start;
    EquilibriumReport<Dim, Law> report;
    integrator.step(system, system.time(), params.h, step, solver, report.data);
    const StepData<Dim, Law>& data = report.data;
    const std::vector<double> speed = point_speeds<Dim>(system, data.end);
    const std::vector<double> load = point_speeds<Dim>(system, data.free);
    for (const double s : speed) report.speed = std::max(report.speed, s);
    for (const double s : load) report.load_speed = std::max(report.load_speed, s);
    const IslandSpeeds islands = island_speeds<Dim>(system.bodies, data.contacts, speed, load);
    report.relative_speed = islands.fastest.relative;
    report.residual = data.report.residual;
    decide(report, islands.least_explained, params.rest);
    return report;
}

}  // namespace detail

/// Whether a configuration is a possible equilibrium, "found in one step": one step from zero
/// velocity of the free bodies, at the time of the system; if the end velocity is zero, the contact
/// forces found agree with equilibrium ([Moreau] end of section 2.1). Obstacles move as prescribed.
/// The system is not changed. The solver's own tolerance should be `rest` or
/// less. `start` offers impulses to begin from (scaled for this h): with self-stress, as in a
/// jammed wedge, the verdict may depend on it, since both answers are then solutions. `hooks` are
/// called between the stages of the step.
template <int Dim, class Law, class ShapeType, class Solver, class Hooks = NoHooks>
requires ContactSolver<Solver, Dim, Law> EquilibriumReport<Dim, Law> equilibrium(
    System<Dim, Law, ShapeType> system, const EquilibriumParams& params, Solver solver,
    const ImpulseCache<Dim>& start = {}, const Hooks& hooks = {}) {
    require_positive("step size h", params.h);
    require_positive("rest", params.rest);
    const double tolerance = params.contact_tolerance.value_or(detail::touching_gap(system));
    require_non_negative("contact tolerance", tolerance);
    Bodies<Dim>& bodies = system.bodies;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        bodies.velocity[i].setZero();
        bodies.spin[i].setZero();
    }
    auto report = detail::one_step<Dim>(system, {.contact_tolerance = tolerance}, params, solver,
                                        start, hooks);
    if (report.verdict != Verdict::moving || params.contact_tolerance) return report;
    // Bodies that a simulation has brought to rest are apart by what it calls closed.
    const auto nearly =
        detail::one_step<Dim>(system, {.gaps_may_close = false}, params, solver, start, hooks);
    if (nearly.data.contact_count() <= report.data.contact_count() ||
        nearly.verdict != Verdict::equilibrium)
        return report;
    double widest = 0.0;
    for (const double gap : nearly.data.contacts.gap) widest = std::max(widest, gap);
    report.verdict = Verdict::undecided;
    report.reason += ", but would not if gaps of up to " + detail::text_of(widest) +
                     " m were closed, which a simulation leaves between bodies at rest: give "
                     "contact_tolerance to count them as closed, or " +
                     detail::text_of(tolerance) + " to count them as open";
    return report;
}

/// The same with Gauss-Seidel, accelerated by Anderson, as accurate as `rest` asks for within
/// 50,000 double sweeps: a tower of fifty boxes takes 6,000 (plain sweeps are far from it after
/// 100,000). Nearer to a threshold the verdict may be undecided where Automatic finds one.
template <int Dim, class Law, class ShapeType>
EquilibriumReport<Dim, Law> equilibrium(System<Dim, Law, ShapeType> system,
                                        const EquilibriumParams& params = {}) {
    AcceleratedGaussSeidel<law_rows<Law, Dim>, Law> solver(
        {.max_iterations = 50000, .tolerance = 1e-4 * params.rest});
    return equilibrium(std::move(system), params, std::move(solver));
}

}  // namespace talus
