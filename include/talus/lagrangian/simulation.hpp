// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/observer.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/midpoint_step.hpp>
#include <talus/lagrangian/state.hpp>
#include <talus/lagrangian/step_data.hpp>
#include <talus/lagrangian/step_params.hpp>
#include <talus/lagrangian/summary.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/step_hooks.hpp>

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <utility>

namespace talus {

/// The solver of a LagrangianSimulation that names no other: few contacts are solved to rounding
/// in no time.
template <LagrangianSystem System>
using LagrangianSolver =
    GaussSeidel<LagrangianTypes<System>::rows, typename LagrangianTypes<System>::Law>;

/// A mechanical system in coordinates of its own, and its clock: Moreau's midpoint step with exact
/// friction and impacts for machines, robots and models of few degrees of freedom.
///
///   struct Bouncer {
///       static constexpr int dof = 1;
///       void mass(double, const auto&, auto& a) const { a << 2.0; }
///       void force(double, const auto&, const auto&, auto& f) const { f << -2.0 * 9.81; }
///       void gaps(const auto&, const auto& q, auto& contacts) const {
///           contacts.add(q[0], {.law = {}, .restitution_normal = 0.8});
///       }
///   };
///   LagrangianSimulation sim(Bouncer{}, Eigen::Vector<double, 1>(1.0), {.h = 1e-4});
///   const LagrangianSummary run = sim.run(2.0);
template <LagrangianSystem System, class Solver = LagrangianSolver<System>, class Hooks = NoHooks>
class LagrangianSimulation {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;
    using Data = LagrangianStepData<System>;
    static_assert(AssembledSolver<Solver, Types::rows, typename Types::Law>,
                  "Solver must be an AssembledSolver for the system's rows and law");
    static_assert(StepHooks<Hooks, System, Data>, "Hooks must be StepHooks");

    /// Tight: contacts are few.
    static Solver default_solver() {
        Solver solver;
        if constexpr (requires { solver.params.tolerance = 1e-12; })
            solver.params.tolerance = 1e-12;
        return solver;
    }

    /// At rest at q, at time 0. Throws as `set_state`, and if a setting is out of range.
    LagrangianSimulation(System system, const Coordinates& q, LagrangianParams params = {},
                         Solver solver = default_solver())
        : LagrangianSimulation(std::move(system), q, Coordinates(Coordinates::Zero(q.size())), 0.0,
                               params, std::move(solver)) {}
    /// At q with velocity u, at time t [s]. (A template, for which no braces are meant.)
    template <std::convertible_to<Coordinates> Velocity>
    LagrangianSimulation(System system, const Coordinates& q, const Velocity& u, double t = 0.0,
                         LagrangianParams params = {}, Solver solver = default_solver())
        : system_(std::move(system)), params_(params), solver_(std::move(solver)) {
        params_.require_valid();
        set_state(q, u, t);
    }

    /// Puts the system elsewhere, without what the last step left for the next. Throws input_error,
    /// and changes nothing, if q and u are not finite and as many as the degrees of freedom, or if
    /// the system's functions do not give there what they must: A symmetric and positive definite,
    /// everything finite, laws valid, Jacobians (if they are checked) those of the gaps.
    void set_state(const Coordinates& q, const Coordinates& u, double t = 0.0) {
        require_count("velocities", static_cast<std::size_t>(u.size()), "coordinates",
                      static_cast<std::size_t>(q.size()));
        if (q.size() == 0) detail::reject("number of coordinates", 0.0, "positive");
        if (!std::isfinite(t)) detail::reject("time", t, "finite");
        require_finite("q", q);
        require_finite("u", u);
        midpoint_.require_valid(system_, params_, t, q, u);
        q_ = q;
        u_ = u;
        time_start_ = time_ = t;
        step_count_ = 0;
        data_ = Data();
        midpoint_.forget();
    }

    /// Advances by one step; returns what it did. Whatever is thrown on the way (input_error for
    /// what the system gives, or anything by the system itself, a hook or the solver) leaves the
    /// simulation as it was, bit for bit.
    const Data& step() {
        next_data_.q_begin = q_;
        next_data_.begin = u_;
        next_data_.t_begin = time_;
        midpoint_.step(system_, params_, solver_, next_data_);
        std::swap(data_, next_data_);
        q_ = data_.q_end;
        u_ = data_.end;
        ++step_count_;
        time_ = time_start_ + static_cast<double>(step_count_) * params_.h;
        return data_;
    }

    /// Makes the steps that bring the clock to `duration` [s] from now, to the nearest step, and
    /// tells whether they can be believed. `on_step(const LagrangianSimulation&)` is called after
    /// each; if it returns bool, false stops the run. Throws input_error for a duration that is not
    /// finite, negative or of more than 1e15 steps.
    template <class OnStep = Ignore>
    [[nodiscard("whether all steps met their tolerance")]] LagrangianSummary run(
        double duration, OnStep on_step = {}) {
        constexpr double most_steps = 1e15;
        require_in("duration", duration, 0.0, most_steps * params_.h);
        const std::int64_t steps = std::llround(duration / params_.h);
        LagrangianSummary summary;
        for (std::int64_t k = 0; k < steps; ++k) {
            step();
            summary.record(data_);
            summary.stopped = !notify(on_step, std::as_const(*this));
            if (summary.stopped) break;
        }
        return summary;
    }

    /// All that the next step depends on apart from system, settings and solver: to go back to, to
    /// try from, or to write down (NumberRecord).
    LagrangianState state() const {
        LagrangianState state;
        state.q.assign(q_.data(), q_.data() + q_.size());
        state.u.assign(u_.data(), u_.data() + u_.size());
        state.h = params_.h;
        state.time_start = time_start_;
        state.step_count = step_count_;
        midpoint_.write_to(state);
        return state;
    }
    /// Puts a state in place of what there is; the run that follows makes the same bits as the one
    /// that the state was taken from. Throws input_error, and changes nothing, if it is of another
    /// step size, of other numbers of coordinates or rows, or not as a state must be; the system is
    /// not asked before the next step. `data()` is then of no step.
    void restore(const LagrangianState& state) {
        state.require_valid();
        if (state.h != params_.h)
            detail::reject("step size h of the state", state.h,
                           "that of the simulation, " + detail::text_of(params_.h));
        require_count("coordinates of the state", state.q.size(), "the simulation",
                      static_cast<std::size_t>(q_.size()));
        require_count("rows of the state", static_cast<std::size_t>(state.rows), "the system",
                      static_cast<std::size_t>(Types::rows));
        Data none;
        midpoint_.restore(state);  // asks for memory before it changes anything
        for (Eigen::Index i = 0; i < q_.size(); ++i) {
            q_[i] = state.q[static_cast<std::size_t>(i)];
            u_[i] = state.u[static_cast<std::size_t>(i)];
        }
        time_start_ = state.time_start;
        step_count_ = state.step_count;
        time_ = time_start_ + static_cast<double>(step_count_) * params_.h;
        data_ = std::move(none);
    }

    const Coordinates& position() const { return q_; }  ///< q
    const Coordinates& velocity() const { return u_; }  ///< u = dq/dt
    double time() const { return time_; }               ///< [s]
    std::int64_t step_count() const { return step_count_; }
    const LagrangianParams& params() const { return params_; }
    System& system() { return system_; }
    const System& system() const { return system_; }
    Solver& solver() { return solver_; }
    const Solver& solver() const { return solver_; }
    /// Of the last step; without contacts before the first one, and after `restore`.
    const Data& data() const { return data_; }
    /// Called between the stages of a step (LagrangianMidpoint::hooks).
    Hooks& hooks() { return midpoint_.hooks(); }

  private:
    System system_;
    LagrangianParams params_;
    Solver solver_;
    LagrangianMidpoint<System, Hooks> midpoint_;
    Data data_, next_data_;  // the next one: of a step under way
    Coordinates q_, u_;
    double time_start_ = 0.0, time_ = 0.0;
    std::int64_t step_count_ = 0;
};

}  // namespace talus
