// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/observer.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/event_driven/contact_motion.hpp>
#include <talus/lagrangian/event_driven/dense_step.hpp>
#include <talus/lagrangian/event_driven/event_course.hpp>
#include <talus/lagrangian/event_driven/event_params.hpp>
#include <talus/lagrangian/event_driven/event_report.hpp>
#include <talus/lagrangian/event_driven/event_search.hpp>
#include <talus/lagrangian/event_driven/event_settlement.hpp>
#include <talus/lagrangian/event_driven/watch_list.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace talus {

/// A smooth step that was taken, up to an event or its end: what observers are shown.
template <class Coordinates>
class EventDrivenStep {
  public:
    EventDrivenStep(const DenseStep& step, double t_end) : step_(step), t_end_(t_end) {}

    double t_begin() const { return step_.t_begin(); }  ///< [s]
    double t_end() const { return t_end_; }             ///< [s]
    /// q and u at a time within it, by dense output. Before the projection on closed contacts,
    /// which is of the size of the tolerance.
    Coordinates position(double t) const { return part(t, 0); }
    Coordinates velocity(double t) const { return part(t, step_.x_begin().size() / 2); }

  private:
    Coordinates part(double t, std::size_t from) const {
        DenseStep::State x;
        step_.interpolate(require_in("time within the step", t, t_begin(), t_end()), x);
        const std::size_t n = x.size() / 2;
        return Eigen::Map<const Eigen::VectorXd>(x.data() + from, static_cast<Eigen::Index>(n));
    }

    const DenseStep& step_;
    double t_end_;
};

/// A mechanical system with unilateral contacts and friction by events: the rival of Moreau's step.
/// Between events contacts are open, slide or stick, and the motion is a differential equation
/// (order 5, adaptive); events are found to rounding, impacts obey the laws of the time-stepping
/// method, and the next modes are a solution of the complementarity problem on accelerations.
///
///   EventDriven machine(Bouncer{}, Eigen::Vector<double, 1>(1.0));
///   const EventReport run = machine.advance(2.0);
///   if (!run.done()) ...  // accumulated impacts, a Painleve point: run.end says
///
/// What the method cannot do it says (EventEnd): go through an accumulation of impacts, or on
/// where accelerations do not exist or are not unique. LagrangianSimulation does both.
template <LagrangianSystem System,
          class Solver =
              GaussSeidel<LagrangianTypes<System>::rows, typename LagrangianTypes<System>::Law>>
class EventDriven {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;
    using Step = EventDrivenStep<Coordinates>;
    static_assert(AssembledSolver<Solver, Types::rows, typename Types::Law>,
                  "Solver must be an AssembledSolver for the system's rows and law");

    /// For impacts: tight, and patient, since contacts are few.
    static Solver default_solver() {
        Solver solver;
        if constexpr (requires { solver.params.tolerance = 1e-12; })
            solver.params.tolerance = 1e-12;
        if constexpr (requires { solver.params.max_sweeps = 1; }) solver.params.max_sweeps = 100000;
        return solver;
    }

    /// At rest at q, at time 0. Throws as `set_state`, and if a setting is out of range.
    EventDriven(System system, const Coordinates& q, EventDrivenParams params = {},
                Solver solver = default_solver())
        : EventDriven(std::move(system), q, Coordinates(Coordinates::Zero(q.size())), 0.0, params,
                      std::move(solver)) {}
    /// At q with velocity u, at time t [s]. (A template, for which no braces are meant.)
    template <std::convertible_to<Coordinates> Velocity>
    EventDriven(System system, const Coordinates& q, const Velocity& u, double t = 0.0,
                EventDrivenParams params = {}, Solver solver = default_solver())
        : system_(std::move(system)), params_(params), solver_(std::move(solver)) {
        params_.require_valid();
        set_state(q, u, t);
    }

    /// Puts the system elsewhere. Throws input_error, and changes nothing, if q and u are not
    /// finite and as many as the degrees of freedom, if the system's functions do not give there
    /// what they must, or if contacts overlap by more than `touching`.
    void set_state(const Coordinates& q, const Coordinates& u, double t = 0.0) {
        require_count("velocities", static_cast<std::size_t>(u.size()), "coordinates",
                      static_cast<std::size_t>(q.size()));
        if (q.size() == 0) detail::reject("number of coordinates", 0.0, "positive");
        if (!std::isfinite(t)) detail::reject("time", t, "finite");
        require_finite("q", q);
        require_finite("u", u);
        EventCourse course;
        course.t = t;
        course.x.assign(q.data(), q.data() + q.size());
        course.x.insert(course.x.end(), u.data(), u.data() + u.size());
        SystemEvaluation<System> evaluation;
        typename Types::Contacts contacts;
        evaluation.contacts(system_, t, q, contacts);
        course.impacts.resize(contacts.size());
        ContactMotion<System> motion(params_, contacts.size());
        motion.evaluate(system_, t, course.x);
        for (std::size_t k = 0; k < contacts.size(); ++k) {
            (void)motion.friction(k);
            if (contacts[k].gap < -params_.touching)
                detail::reject(
                    detail::at_time("gap of " + detail::contact_text(k, contacts[k].name), t),
                    contacts[k].gap, "at least " + detail::text_of(-params_.touching));
        }
        course_ = std::move(course);
    }

    /// Moves on by `duration` [s], or as far as the method goes: the report says which, and what
    /// happened. `on_step(const Step&)` is called after each smooth step; if it returns bool, false
    /// stops. Whatever is thrown on the way (input_error for what the system gives or a duration
    /// that is negative or not finite, or anything by system, observer or solver) leaves the state
    /// as it was.
    template <class OnStep = Ignore>
    [[nodiscard("whether the time was reached, and why not")]] EventReport advance(
        double duration, OnStep on_step = {}) {
        require_non_negative("duration", duration);
        EventCourse course = course_;
        EventReport report;
        EventSettlement<System, Solver> settlement(system_, params_, solver_,
                                                   course.impacts.size());
        run(course, course.t + duration, settlement, report, on_step);
        report.time = course.t;
        course_ = std::move(course);
        return report;
    }

    Coordinates position() const { return part(0); }                     ///< q
    Coordinates velocity() const { return part(course_.x.size() / 2); }  ///< u = dq/dt
    double time() const { return course_.t; }                            ///< [s]
    std::size_t contact_count() const { return course_.impacts.size(); }
    /// What a contact does now, by its place in the system's list. Open before the first `advance`.
    ContactMode mode(std::size_t contact) const { return course_.phase.mode_at(contact); }
    const EventDrivenParams& params() const { return params_; }
    const System& system() const { return system_; }

  private:
    Coordinates part(std::size_t from) const {
        const std::size_t n = course_.x.size() / 2;
        return Eigen::Map<const Eigen::VectorXd>(course_.x.data() + from,
                                                 static_cast<Eigen::Index>(n));
    }

    template <class OnStep>
    void run(EventCourse& course, double target, EventSettlement<System, Solver>& settlement,
             EventReport& report, OnStep& on_step) {
        constexpr int most_without_progress = 50;
        ContactMotion<System>& motion = settlement.motion();
        bool within = true;
        DenseStep step([&](const DenseStep::State& x, DenseStep::State& dx, double t) {
            if (!motion.derivative(system_, t, x, course.phase, dx)) within = false;
        });
        EventSearch search(params_.resting_speed, params_.touching);
        std::vector<Watch> watches;
        WatchSample sample;
        int without_progress = 0;
        if (!course.settled && !settlement.settle(course, report, {})) return;
        while (course.t < target) {
            if (report.events.size() >= static_cast<std::size_t>(params_.max_events))
                return end(report, EventEnd::event_limit);
            if (report.steps >= params_.max_steps) return end(report, EventEnd::step_limit);
            settlement.turn_slips(course);
            step.begin(course.t, course.x);
            watches = watches_of(course.phase, motion.problem, course.impacts.size());
            if (!take_step(step, course, target, within, report)) {
                if (within) return end(report, EventEnd::step_too_small);
                settlement.note_border(course, report);
                return;
            }
            const std::optional<Crossing> event = search.first(
                step.t_begin(), step.t_end(), watches, [&](double t, bool exact, WatchSample& out) {
                    exact ? step.step_to(t, state_) : step.interpolate(t, state_);
                    motion.solve(system_, t, state_, course.phase);
                    out.t = t;
                    take_sample(motion, course.phase, watches, params_.resting_speed, out);
                });
            const double before = course.t;
            course.t = event ? event->t : step.t_end();
            if (event)
                step.step_to(course.t, course.x);
            else
                course.x = step.x_end();
            if (std::abs(target - course.t) <= least_length(target)) course.t = target;
            motion.project(system_, course.t, course.x, course.phase, report.gap_correction,
                           report.velocity_correction);
            const bool go_on = notify(on_step, Step(step, std::min(course.t, step.t_end())));
            if (event) {
                const bool moved = course.t - before > least_length(course.t);
                without_progress = moved ? 0 : without_progress + 1;
                if (without_progress > most_without_progress)
                    return end(report, EventEnd::no_progress);
                if (!settlement.settle(course, report, {watches[event->watch]})) return;
            }
            if (!go_on) return end(report, EventEnd::stopped);
        }
        end(report, EventEnd::duration_reached);
    }

    /// Tries lengths until one has the error that is allowed, and lies within the phase. False if
    /// none does.
    bool take_step(DenseStep& step, EventCourse& course, double target, bool& within,
                   EventReport& report) const {
        constexpr double cautious = 1e-3, half = 0.5;
        double wish = course.length > 0.0 ? course.length : cautious * params_.longest_step;
        for (;;) {
            wish = std::min(wish, params_.longest_step);
            const double rest = target - course.t;
            const bool last = wish >= rest;
            const double length = last ? rest : wish;
            within = true;
            const double error =
                step.attempt(length, params_.absolute_tolerance, params_.relative_tolerance);
            if (within && error <= 1.0) {
                ++report.steps;
                const double next = DenseStep::next_length(length, error);
                course.length = last ? std::max(next, course.length) : next;
                return true;
            }
            ++report.rejected;
            wish = within ? DenseStep::next_length(length, error) : half * length;
            if (wish < least_length(course.t)) return false;
        }
    }
    /// Below which a step is no step [s].
    double least_length(double t) const {
        constexpr double few = 8.0;
        return few * std::numeric_limits<double>::epsilon() *
               std::max(std::abs(t), params_.longest_step);
    }
    static void end(EventReport& report, EventEnd why) { report.end = why; }

    System system_;
    EventDrivenParams params_;
    Solver solver_;
    EventCourse course_;
    DenseStep::State state_;
};

}  // namespace talus
