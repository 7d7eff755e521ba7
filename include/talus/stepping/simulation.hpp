// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/core/observer.hpp>
#include <talus/stepping/moreau_midpoint.hpp>
#include <talus/stepping/run_summary.hpp>
#include <talus/stepping/simulation_types.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace talus {

namespace detail {

[[noreturn, gnu::cold]] inline void refuse_data() {
    throw input_error(
        "data of the last step are of bodies that were removed since, but must be read before the "
        "removal, or after the next step");
}

}  // namespace detail

/// Settings of a simulation.
struct SimulationParams {
    /// Step size [s]. Overlaps are at most h times the speed of approach; a grain of radius R that
    /// falls from height H wants h well below R / sqrt(2 g H).
    double h = 1e-3;
    StepParams step = {};
};

/// A system and its clock. The defaults are those most runs want; another law, solver, list of
/// shapes or broad phase is named in a struct derived from SimulationTypes.
///
///     Simulation<3> sim({Coulomb<3>{.mu = 0.4}}, {.h = 1e-3});
///     sim.system().gravity[2] = -9.81;
///     sim.system().add_obstacle(HalfSpace<3>{Vector<3>::Unit(2), 0.0});
///     sim.system().add(Ball<3>{0.005}, 2600.0, Pose<3>{{0.0, 0.0, 0.1}, {}});
///     const RunSummary run = sim.run(1.0);
///     if (!run.certified()) std::puts(to_string(run).c_str());
template <int Dim, class Types = SimulationTypes<Dim>>
requires SpaceDimension<Dim>
class Simulation {
  public:
    using Law = typename Types::Law;
    using ShapeType = typename Types::Shape;
    using Solver = SolverOf<Dim, Types>;
    using Broad = typename Types::BroadPhase;
    using Hooks = typename Types::Hooks;
    using Correction = typename Types::GapCorrection;
    static_assert(ContactLaw<Law, law_rows<Law, Dim>>, "Types::Law must be a ContactLaw");
    static_assert(ContactSolver<Solver, Dim, Law>,
                  "Types::Solver must be a ContactSolver for Types::Law");
    static_assert(BroadPhase<Broad, Dim>, "Types::BroadPhase must be a BroadPhase");

    static_assert(Shape<ShapeType, Dim>, "Types::Shape must be a Shape");
    using SystemType = System<Dim, Law, ShapeType>;
    using Data = StepData<Dim, Law>;
    static_assert(StepHooks<Hooks, SystemType, Data>, "Types::Hooks must be StepHooks");
    static_assert(PositionCorrection<Correction, SystemType, Data>,
                  "Types::GapCorrection must be a PositionCorrection");

    /// The clock begins where the system's does. Throws input_error if a setting is out of range.
    explicit Simulation(SystemType system, SimulationParams params = {},
                        Solver solver = default_solver<Dim, Types>())
        : system_(std::move(system)), params_(params), solver_(std::move(solver)) {
        start();
    }
    /// One material.
    explicit Simulation(const Law& law, SimulationParams params = {},
                        Solver solver = default_solver<Dim, Types>())
        : system_(law), params_(params), solver_(std::move(solver)) {
        start();
    }
    /// Several materials: a MaterialTable. (A template, for which no braces are meant.)
    template <std::same_as<MaterialTable<Law>> Table>
    explicit Simulation(const Table& laws, SimulationParams params = {},
                        Solver solver = default_solver<Dim, Types>())
        : system_(laws), params_(params), solver_(std::move(solver)) {
        start();
    }

    /// Advances by one step; returns what it did. Whatever is thrown on the way (by a law, a force,
    /// a motion, a shape, the solver, for want of memory) leaves the simulation as it was, bit for
    /// bit.
    const Data& step();

    /// Makes the steps that bring the clock to `duration` [s] from now, to the nearest step, and
    /// tells whether they can be believed. `on_step(const Simulation&)` is called after each; if it
    /// returns bool, false stops the run. Throws input_error for a duration that is not finite,
    /// negative or of more than 1e15 steps.
    template <class OnStep = Ignore>
    [[nodiscard("whether all steps met their tolerance")]] RunSummary run(double duration,
                                                                          OnStep on_step = {}) {
        constexpr double most_steps = 1e15;
        require_in("duration", duration, 0.0, most_steps * params_.h);
        const std::int64_t steps = std::llround(duration / params_.h);
        RunSummary summary;
        for (std::int64_t k = 0; k < steps; ++k) {
            step();
            summary.record(system_, data_[last_]);
            summary.stopped = !notify(on_step, std::as_const(*this));
            if (summary.stopped) break;
        }
        return summary;
    }

    /// All that the next step depends on apart from laws, forces, settings and solver: to go back
    /// to, to try from, or to write down (io/checkpoint).
    RunState<Dim, ShapeType> state() const;
    /// Puts a state in place of what there is; the run that follows makes the same bits as the one
    /// that the state was taken from. Throws input_error, and changes nothing, if it is of another
    /// step size or does not fit together. `data()` is then of no step.
    void restore(const RunState<Dim, ShapeType>& state);

    double time() const { return time_; }  ///< [s]
    std::int64_t step_count() const { return step_count_; }
    const SimulationParams& params() const { return params_; }
    SystemType& system() { return system_; }
    const SystemType& system() const { return system_; }
    Solver& solver() { return solver_; }
    const Solver& solver() const { return solver_; }
    /// Of the last step; empty before the first one, and after `restore`. Throws input_error when
    /// bodies were removed since: its indices were those of others.
    const Data& data() const {
        if (system_.bodies.removals() != removals_) detail::refuse_data();
        return data_[last_];
    }
    /// Impulses remembered for the warm start; clear it to make the next step start cold.
    ImpulseCache<Dim>& impulse_cache() {
        integrator_.warm_start().follow(system_.bodies);
        return integrator_.warm_start().impulses();
    }
    /// Called between the stages of a step (step_hooks.hpp).
    Hooks& hooks() { return integrator_.hooks(); }
    /// The correction of positions, if the types have one: its settings are in `params`.
    Correction& gap_correction() { return gap_correction_; }

  private:
    void start();

    SystemType system_;
    SimulationParams params_;
    Solver solver_;
    MoreauMidpoint<Dim, Law, ShapeType, Broad, Hooks> integrator_;
    [[no_unique_address]] Correction gap_correction_;
    std::array<Data, 2> data_;
    std::size_t last_ = 0;  // the one of the last step; the other is of a step under way
    double time_start_ = 0.0, time_ = 0.0;
    std::int64_t step_count_ = 0;
    std::int64_t removals_ = 0;  // of bodies, at the last step
};

template <int Dim, class Types>
requires SpaceDimension<Dim>
void Simulation<Dim, Types>::start() {
    require_positive("step size h", params_.h);
    require_valid(params_.step);
    time_start_ = time_ = system_.time();
    removals_ = system_.bodies.removals();
}

template <int Dim, class Types>
requires SpaceDimension<Dim>
auto Simulation<Dim, Types>::step() -> const Data& {
    gap_correction_.require_valid();
    Data& next = data_[1 - last_];
    integrator_.step(system_, time_, params_.h, params_.step, solver_, next);
    try {
        gap_correction_.apply(system_, next);
    } catch (...) {
        integrator_.undo(system_);
        throw;
    }
    last_ = 1 - last_;
    removals_ = system_.bodies.removals();
    ++step_count_;
    time_ = time_start_ + static_cast<double>(step_count_) * params_.h;
    return next;
}

template <int Dim, class Types>
requires SpaceDimension<Dim>
auto Simulation<Dim, Types>::state() const -> RunState<Dim, ShapeType> {
    RunState<Dim, ShapeType> state;
    system_.write_to(state);
    integrator_.warm_start().write_to(state);
    state.h = params_.h;
    state.time_start = time_start_;
    state.step_count = step_count_;
    if constexpr (requires { gap_correction_.write(state.correction); })
        gap_correction_.write(state.correction);
    return state;
}

template <int Dim, class Types>
requires SpaceDimension<Dim>
void Simulation<Dim, Types>::restore(const RunState<Dim, ShapeType>& state) {
    system_.require_between_steps();
    if (state.h != params_.h)
        detail::reject("step size h of the state", state.h,
                       "that of the simulation, " + detail::text_of(params_.h));
    require_non_negative("steps of the state", static_cast<double>(state.step_count));
    if (!std::isfinite(state.time_start))
        detail::reject("begin of the state", state.time_start, "finite");
    const double now = state.time_start + static_cast<double>(state.step_count) * state.h;
    if (!(std::abs(state.time - now) <= 1e-9 * (std::abs(now) + state.h)))
        detail::reject("time of the obstacles of the state", state.time,
                       "that of its clock, " + detail::text_of(now));
    SystemType system = system_;
    system.restore(state);
    Correction correction = gap_correction_;
    NumberRecordReader remembered(state.correction);
    if constexpr (requires { correction.restore(remembered); }) correction.restore(remembered);
    remembered.require_end();
    integrator_.warm_start().restore(state);
    system_ = std::move(system);
    gap_correction_ = std::move(correction);
    data_[last_] = Data();
    removals_ = system_.bodies.removals();
    time_start_ = state.time_start;
    step_count_ = state.step_count;
    time_ = time_start_ + static_cast<double>(step_count_) * params_.h;
}

}  // namespace talus

TALUS_IN_PLANE(class talus::Simulation<2>)
TALUS_IN_SPACE(class talus::Simulation<3>)
