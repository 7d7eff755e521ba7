// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/input.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/moreau_midpoint.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// Answer of the one-step equilibrium test.
enum class Verdict {
    equilibrium,  ///< the forces found hold the bodies: a *possible* equilibrium, stable or not
    moving,       ///< the solver converged and something moves
    undecided,    ///< the solver did not converge: raise its sweep limit or take another solver
};

/// Settings of the equilibrium test.
struct EquilibriumParams {
    double h = 1e-3;  ///< step size [s]; the verdict does not depend on it
    /// Largest end speed, relative to the speed that the loads alone would give in the step, that
    /// counts as rest [-]. Needs a solver tolerance some hundred times smaller.
    double rest = 1e-9;
    /// Gap below which a contact counts as closed [m]; 1e-10 of the bodies' size suits bodies
    /// placed "exactly" in touch.
    double contact_tolerance = 0.0;
};

/// What the test found.
template <int Dim, class Law>
struct EquilibriumReport {
    Verdict verdict = Verdict::undecided;
    double speed = 0.0;       ///< largest point speed at the end of the step [m/s]
    double load_speed = 0.0;  ///< the same if there were no contacts [m/s]
    double residual = 0.0;    ///< of the contact forces [-]
    StepData<Dim, Law> data;  ///< contacts and impulses; divide those by h for forces

    /// Contact force of contact c in its local frame [N].
    Vector<Dim> mean_reaction(std::size_t c) const { return data.impulse[c] / data.h; }
};

namespace detail {

/// Largest speed of a point of a free body.
template <int Dim, class Law, class ShapeType>
double largest_point_speed(const System<Dim, Law, ShapeType>& system,
                           std::span<const Twist<Dim>> twists) {
    double largest = 0.0;
    for (std::size_t i = 0; i < twists.size(); ++i) {
        if (system.bodies.is_obstacle(i)) continue;
        const double spin = twists[i].angular.norm();
        const double turning = spin > 0.0 ? spin * system.bounding_radius()[i] : 0.0;
        largest = std::max(largest, twists[i].linear.norm() + turning);
    }
    return largest;
}

}  // namespace detail

/// Whether a configuration is a possible equilibrium, "found in one step": one step from zero
/// velocity; if the end velocity is zero, the contact forces found agree with equilibrium ([Moreau]
/// end of section 2.1). The system is not changed. `start` offers impulses to begin from (scaled
/// for this h): with self-stress, as in a jammed wedge, the verdict may depend on it, since both
/// answers are then solutions. `hooks` are called between the stages of the step.
template <int Dim, class Law, class ShapeType, class Solver = GaussSeidel<Dim, Law>,
          class Hooks = NoHooks>
EquilibriumReport<Dim, Law> equilibrium(System<Dim, Law, ShapeType> system,
                                        const EquilibriumParams& params, Solver solver = Solver(),
                                        const ImpulseCache<Dim>& start = {},
                                        const Hooks& hooks = {}) {
    require_positive("step size h", params.h);
    require_positive("rest", params.rest);
    require_non_negative("contact tolerance", params.contact_tolerance);
    Bodies<Dim>& bodies = system.bodies;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        bodies.velocity[i].setZero();
        bodies.spin[i].setZero();
    }
    MoreauMidpoint<Dim, Law, ShapeType, HierarchicalGrid<Dim>, Hooks> integrator;
    integrator.hooks() = hooks;
    integrator.impulse_cache() = start;
    EquilibriumReport<Dim, Law> report;
    const StepParams step{.contact_tolerance = params.contact_tolerance};
    integrator.step(system, 0.0, params.h, step, solver, report.data);
    const StepData<Dim, Law>& data = report.data;
    report.residual = data.report.residual;
    report.speed = detail::largest_point_speed<Dim>(system, data.end);

    report.load_speed = detail::largest_point_speed<Dim>(system, data.free);

    if (data.report.status != SolveStatus::converged)
        report.verdict = Verdict::undecided;
    else
        report.verdict = report.speed <= params.rest * report.load_speed ? Verdict::equilibrium
                                                                         : Verdict::moving;
    return report;
}

}  // namespace talus
