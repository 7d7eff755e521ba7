// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/apply_impulses.hpp>
#include <talus/assembly/can_part.hpp>
#include <talus/assembly/contact_detection.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/assembly/contact_velocities.hpp>
#include <talus/assembly/free_velocity.hpp>
#include <talus/assembly/rolling_rows.hpp>
#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/drift.hpp>
#include <talus/dynamics/kept_state.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/stepping/gap_anticipating.hpp>
#include <talus/stepping/step_data.hpp>
#include <talus/stepping/step_hooks.hpp>
#include <talus/stepping/step_params.hpp>
#include <talus/stepping/step_reach.hpp>
#include <talus/stepping/system.hpp>
#include <talus/stepping/warm_start.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace talus {

/// One step of [Moreau] section 2.3, equation (9), stage by stage; owns what the stages share.
///
///   q_mid  = q_begin + (h/2) u_begin             A, G, W, F, gaps taken at (t_mid, q_mid)
///   active = { contacts with gap(t_mid, q_mid) <= closed_gap }
///   u_free = u_begin + h A^-1 F(t_mid, q_mid, u_begin)
///   law( mean of U_begin and U_end , r )  for every active contact,  u_end = u_free + A^-1 G^T r
///   q_end  = q_mid + (h/2) u_end
///
/// A periodic cell deforms to t_mid with the bodies and on to t_end; images move as it does at
/// t_mid, and bodies that have left the home are carried along (CellCarriage). One that a stress
/// drives is one more body of the problem (CellDrive).
template <int Dim, BodyLaw<Dim> Law, Shape<Dim> ShapeType, BroadPhase<Dim> Broad,
          class Hooks = NoHooks>
class MoreauMidpoint {
  public:
    using SystemType = System<Dim, Law, ShapeType>;
    using Data = StepData<Dim, Law>;

    /// Advances `system` from t_begin by h; `data` receives what happened. Throws input_error if a
    /// prescribed motion or an applied force is not finite or an obstacle was moved by hand, and
    /// lets pass what a law, a force, a motion, a shape, a hook or the solver throws: in each case
    /// with the bodies and the impulses remembered as they were, bit for bit (`data` is then of no
    /// step).
    template <ContactSolver<Dim, Law> Solver>
    void step(SystemType& system, double t_begin, double h, const StepParams& params,
              Solver& solver, Data& data) {
        pose_problem(system, t_begin, h, params, data);
        try {
            const SolveReport& report = solver.solve(data.problem, data.solution());
            // As much room as the solver has: no history needs more.
            data.report.history.reserve(report.history.capacity());
            data.report = report;
            complete(system, data);
        } catch (...) {
            undo(system);
            throw;
        }
    }

    /// The first half of a step, up to what a solver is given: the problem, and in
    /// `data.solution()` what it starts from. Free bodies are left at q_mid, and the system within
    /// a step: `complete` or `undo` must follow. Throws as `step` does.
    void pose_problem(SystemType& system, double t_begin, double h, const StepParams& params,
                      Data& data);
    /// The second half, from the impulses that a solver found and what it says of them in
    /// `data.report`: those of a failed solve may be too large to be remembered. Where it throws,
    /// `undo` must follow.
    void complete(SystemType& system, Data& data);
    /// Takes the last step, or what was done of it, back: bodies and remembered impulses are as
    /// before it, bit for bit. Once for each step.
    void undo(SystemType& system) noexcept;

    /// Called between the stages (step_hooks.hpp).
    Hooks& hooks() { return hooks_; }

    /// What the next step begins with. (Each step first follows the bodies that were removed.)
    WarmStart<Dim>& warm_start() { return warm_start_; }
    const WarmStart<Dim>& warm_start() const { return warm_start_; }

  private:
    void pose(SystemType& system, double t_begin, double h, const StepParams& params, Data& data);
    void move_to_midpoint(SystemType& system, Data& data);
    void detect(const SystemType& system, const StepParams& params, Data& data);
    void hold_moving_surfaces(const SystemType& system, Data& data);
    void measure_rolling(const SystemType& system, Data& data);
    void evaluate_forces(SystemType& system, const StepParams& params, Data& data);
    void assemble_contacts(const SystemType& system, const StepParams& params, Data& data);
    bool rests(const Data& data, std::size_t c) const;
    static void require_shapes(const SystemType& system);
    static void require_finite_forces(const Data& data);
    static void finish(SystemType& system, Data& data);

    ContactDetection<Dim, ShapeType, Broad> detection_;
    WarmStart<Dim> warm_start_;
    KeptState<Dim> before_;
    bool kept_ = false, stored_ = false;  // there is a step to take back, with its impulses
    StepReach<Dim> look_;
    Column<Twist<Dim>> excess_;      // shape less surface, by body
    Column<double> rolling_radius_;  // by body; empty for laws without rolling friction
    double time_before_ = 0.0;
    std::optional<PeriodicCell<Dim>> cell_before_;
    [[no_unique_address]] Hooks hooks_;
};

// The bodies stand apart from the class, so that `extern template` can keep them from being
// compiled in every file: what is defined within a class is inline, and is made anyway.

#define TALUS_OF_STEP                                                                              \
    template <int Dim, BodyLaw<Dim> Law, Shape<Dim> ShapeType, BroadPhase<Dim> Broad, class Hooks> \
    void MoreauMidpoint<Dim, Law, ShapeType, Broad, Hooks>

TALUS_OF_STEP::pose_problem(SystemType& system, double t_begin, double h, const StepParams& params,
                            Data& data) {
    system.begin_step();
    kept_ = stored_ = false;
    try {
        pose(system, t_begin, h, params, data);
    } catch (...) {
        undo(system);
        throw;
    }
}

TALUS_OF_STEP::pose(SystemType& system, double t_begin, double h, const StepParams& params,
                    Data& data) {
    require_shapes(system);
    system.require_obstacles_in_place();
    system.require_masses();
    warm_start_.follow(system.bodies);
    before_.keep(system.bodies);
    time_before_ = system.time();
    cell_before_ = system.cell();
    kept_ = true;
    data.t_begin = t_begin;
    data.h = h;
    data.correction_work = 0.0;
    move_to_midpoint(system, data);
    hooks_.at_midpoint(system, data);
    evaluate_forces(system, params, data);
    detect(system, params, data);
    assemble_jacobian(data.contacts, system.bodies, data.problem.jacobian);
    if (data.cell) data.problem.jacobian.cell_rate = data.cell->velocity_gradient();
    if (!data.from_home.empty()) system.cell_routines().carry_walls(system, data);
    hold_moving_surfaces(system, data);
    measure_rolling(system, data);
    assemble_inverse_mass(system.bodies, data.problem.inverse_mass);
    if (system.cell_drive()) system.drive_routines().pose(system, data);
    hooks_.matrices_known(system, data);
    hooks_.forces_known(system, data);
    assemble_contacts(system, params, data);
    warm_start_.recall(data);
    hooks_.problem_known(system, data);
    if constexpr (has_rolling_rows<Law>)
        join_rolling_rows<Dim>(data.problem.jacobian, data.impulse, data.moment,
                               data.solver_impulses.r);
}

TALUS_OF_STEP::complete(SystemType& system, Data& data) {
    // Impulses that do not solve their problem and are out of all proportion to it are no start:
    // the next solve would take its loads for what such impulses have left of zero. (Those of a jam
    // are as large, and solve it.)
    constexpr double out_of_proportion = 1e-7;
    if constexpr (has_rolling_rows<Law>)
        part_rolling_rows<Dim>(data.problem.jacobian, data.solver_impulses.r, data.impulse,
                               data.moment);
    warm_start_.store(data, data.report.status == SolveStatus::converged ||
                                !(data.report.rounding > out_of_proportion));
    hooks_.solved(system, data);
    data.end = data.free;
    apply_impulses<Dim>(data.problem.jacobian, data.problem.inverse_mass, data.impulse, data.end);
    if constexpr (has_rolling_rows<Law>)
        apply_moments<Dim>(data.problem.jacobian, data.problem.inverse_mass, data.moment, data.end);
    if (data.cell_is_driven) system.drive_routines().apply(system, data);
    hooks_.velocities_known(system, data);
    finish(system, data);
    hooks_.finished(system, data);
    warm_start_.keep(data.h);
    stored_ = true;
    system.end_step();
}

TALUS_OF_STEP::undo(SystemType& system) noexcept {
    if (kept_) {
        before_.restore(system.bodies);
        system.set_time(time_before_);
        system.put_cell(cell_before_);
    }
    if (stored_) warm_start_.undo();
    kept_ = stored_ = false;
    system.end_step();
}

TALUS_OF_STEP::require_shapes(const SystemType& system) {
    require_count("shapes", system.shapes().size(),
                  "bodies (which System::add and add_obstacle add)", system.bodies.count());
}

TALUS_OF_STEP::move_to_midpoint(SystemType& system, Data& data) {
    Bodies<Dim>& bodies = system.bodies;
    const std::size_t n = bodies.count();
    for (std::size_t i = 0; i < n; ++i)
        if (!bodies.position[i].allFinite())
            require_finite(detail::numbered("position of body", i), bodies.position[i]);
    constexpr double part_of_step = 1e-3;  // over which the obstacles' motion is checked
    require_finite("gravity", system.gravity);
    system.place_obstacles(data.t_mid(), part_of_step * data.h);
    data.from_home.clear();
    data.cell_is_driven = false;
    if (system.cell()) system.cell_routines().begin(system, data);
    drift(bodies, 0.5 * data.h);
    if (system.cell()) system.cell_routines().to_midpoint(system, data);
    data.cell = system.cell();
    if (data.cell) data.cell_rate_free = data.cell_rate_end = data.cell->velocity_gradient();
    data.begin.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        data.begin[i] = bodies.twist(i);
        require_finite_twist("velocity of body", i, data.begin[i]);
    }
}

TALUS_OF_STEP::detect(const SystemType& system, const StepParams& params, Data& data) {
    require_count("bodies after the forces were called", system.bodies.count(),
                  "the beginning of the step", data.begin.size());
    look_.measure(system, params, data);
    detection_.detect(system.bodies, system.shape_list(),
                      params.skin * system.mean_bounding_radius(), look_.reach, look_.motion,
                      params.contact_tolerance.value_or(0.0), system.ignored, data.contacts,
                      system.step_cell(data.h));
    data.contacts.keep_if([&](std::size_t c) {
        const ContactKey& key = data.contacts.key[c];
        if (!can_part(data.contacts, c, system.bodies) &&
            !holds_any_pull<Dim>(system.law_of(key)) &&
            !(system.cell_drive() && system.drive_routines().pushes(system, data, c)))
            return false;
        const auto a = static_cast<std::size_t>(key.a), b = static_cast<std::size_t>(key.b);
        const double thinner = std::min(look_.thickness(system, a), look_.thickness(system, b));
        return data.contacts.gap[c] <=
                   closed_gap(params, thinner, std::max(look_.fall[a], look_.fall[b])) ||
               (params.scheme == Scheme::gap_anticipating && !bounces<Dim>(system.law_of(key)) &&
                !attracts<Dim>(system.law_of(key)));
    });
}

TALUS_OF_STEP::hold_moving_surfaces(const SystemType& system, Data& data) {
    excess_.clear();
    for (const auto& [body, motion] : system.obstacles) {
        if (!motion.surface_moves()) continue;
        if (excess_.empty()) excess_.assign(system.bodies.count(), Twist<Dim>{});
        const auto i = static_cast<std::size_t>(body);
        const Twist<Dim> way = motion.displacement(data.t_begin, data.t_end());
        excess_[i] = {way.linear / data.h - data.begin[i].linear,
                      way.angular / data.h - data.begin[i].angular};
    }
    if (!excess_.empty()) hold_surfaces<Dim>(excess_, data.problem.jacobian);
}

/// Lengths of the rolling rows, for laws that have some. An obstacle counts as flat, whatever its
/// shape: how large a floor is says nothing of how round it is.
TALUS_OF_STEP::measure_rolling(const SystemType& system, Data& data) {
    if constexpr (has_rolling_rows<Law>) {
        rolling_radius_.assign(system.half_thickness());
        for (std::size_t i = 0; i < system.bodies.count(); ++i)
            if (system.bodies.is_obstacle(i))
                rolling_radius_[i] = std::numeric_limits<double>::infinity();
        assemble_rolling_lengths<Dim>(rolling_radius_, data.problem.jacobian);
    }
}

TALUS_OF_STEP::evaluate_forces(SystemType& system, const StepParams& params, Data& data) {
    const Bodies<Dim>& bodies = system.bodies;
    const std::size_t n = bodies.count();
    if (!system.forces.empty()) {
        data.applied.assign(n, Wrench<Dim>{});
        for (const auto& force : system.forces) {
            if (!force) throw input_error("a force of the system is empty, but must be callable");
            force(data.t_mid(), bodies, data.applied);
        }
        require_finite_forces(data);
    } else {
        data.applied.clear();
    }
    data.gyroscopic.clear();
    data.turned_too_far = 0;
    data.free.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto [change, turns_too_far] =
            gyroscopic_change<Dim>(bodies, i, data.h, params.gyroscopic);
        data.turned_too_far += turns_too_far ? 1 : 0;
        if (data.gyroscopic.empty() && !change.is_zero())
            data.gyroscopic.assign(n, AngularVector<Dim>::Zero());
        if (!data.gyroscopic.empty()) data.gyroscopic[i] = change;
        data.free[i] =
            free_velocity<Dim>(bodies, i, data.h, system.gravity,
                               data.applied.empty() ? Wrench<Dim>{} : data.applied[i], change);
        require_finite_twist("free velocity (of forces and inertia) of body", i, data.free[i]);
    }
}

TALUS_OF_STEP::require_finite_forces(const Data& data) {
    for (std::size_t i = 0; i < data.applied.size(); ++i) {
        if (data.applied[i].force.allFinite() && data.applied[i].torque.allFinite()) continue;
        require_finite(detail::numbered("applied force on body", i), data.applied[i].force);
        require_finite(detail::numbered("applied force on body", i, ", its torque"),
                       data.applied[i].torque);
    }
}

TALUS_OF_STEP::assemble_contacts(const SystemType& system, const StepParams& params, Data& data) {
    data.problem.laws.clear();
    for (const ContactKey& key : data.contacts.key) data.problem.laws.push_back(system.law_of(key));
    assemble_velocities<Dim, Law>(data.problem.jacobian, data.begin, data.free, data.problem.laws,
                                  data.problem.free_velocity);
    if (data.cell_is_driven) system.drive_routines().add_loads(data);
    const bool by_rule = !params.contact_tolerance && params.gaps_may_close;
    if (params.scheme != Scheme::gap_anticipating && !by_rule) return;
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const double way = anticipated_velocity(data.contacts.gap[c], data.h);
        if (!(way > 0.0) || holds_any_pull<Dim>(data.problem.laws[c])) continue;
        if (bounces<Dim>(data.problem.laws[c]) && !(by_rule && rests(data, c))) continue;
        data.problem.free_velocity[c][0] += way;
    }
}

/// Whether a contact approaches no faster than loads alone make it within a step: it has no speed
/// to return.
template <int Dim, BodyLaw<Dim> Law, Shape<Dim> ShapeType, BroadPhase<Dim> Broad, class Hooks>
bool MoreauMidpoint<Dim, Law, ShapeType, Broad, Hooks>::rests(const Data& data,
                                                              std::size_t c) const {
    const ContactKey& key = data.contacts.key[c];
    const double fall = std::max(look_.fall[static_cast<std::size_t>(key.a)],
                                 look_.fall[static_cast<std::size_t>(key.b)]);
    return -data.h * relative_velocity<Dim>(data.problem.jacobian, c, data.begin)[0] <= fall;
}

TALUS_OF_STEP::finish(SystemType& system, Data& data) {
    Bodies<Dim>& bodies = system.bodies;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        bodies.velocity[i] = data.end[i].linear;
        bodies.spin[i] = bodies.rotation[i].spin_body(data.end[i].angular);
    }
    drift(bodies, 0.5 * data.h);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (!bodies.position[i].allFinite())
            require_finite(detail::numbered("position after the step of body", i),
                           bodies.position[i]);
        if (!bodies.rotation[i].matrix().allFinite())
            require_finite(detail::numbered("rotation after the step of body", i),
                           bodies.rotation[i].matrix());
    }
    system.place_obstacles(data.t_end());
    if (data.cell) system.cell_routines().to_end(system, data);
}

#undef TALUS_OF_STEP

}  // namespace talus

TALUS_IN_PLANE(class talus::ContactDetection<2, talus::AnyShape<2>, talus::HierarchicalGrid<2>>)
TALUS_IN_PLANE(class talus::MoreauMidpoint<2, talus::DefaultLaw<2>, talus::AnyShape<2>,
                                           talus::HierarchicalGrid<2>>)
TALUS_IN_SPACE(class talus::ContactDetection<3, talus::AnyShape<3>, talus::HierarchicalGrid<3>>)
TALUS_IN_SPACE(class talus::MoreauMidpoint<3, talus::DefaultLaw<3>, talus::AnyShape<3>,
                                           talus::HierarchicalGrid<3>>)
