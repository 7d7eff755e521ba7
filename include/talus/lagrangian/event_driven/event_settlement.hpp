// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/event_driven/acceleration_choice.hpp>
#include <talus/lagrangian/event_driven/contact_motion.hpp>
#include <talus/lagrangian/event_driven/event_course.hpp>
#include <talus/lagrangian/event_driven/event_impact.hpp>
#include <talus/lagrangian/event_driven/event_params.hpp>
#include <talus/lagrangian/event_driven/event_report.hpp>
#include <talus/lagrangian/event_driven/smooth_phase.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace talus {

/// What is done between two smooth phases: impacts of contacts that approach, then the modes of
/// the next phase from the problem on accelerations.
template <LagrangianSystem System, class Solver>
class EventSettlement {
  public:
    static constexpr int rows = LagrangianTypes<System>::rows;

    EventSettlement(const System& system, const EventDrivenParams& params, Solver& solver,
                    std::size_t contact_count)
        : system_(system), params_(params), solver_(solver), motion_(params, contact_count) {}

    ContactMotion<System>& motion() { return motion_; }

    /// Brings a course to the begin of its next phase and notes what happened. `ended` is what
    /// came to its end, if anything did. Whether there is a next phase; otherwise report.end says
    /// why not.
    bool settle(EventCourse& course, EventReport& report, const std::vector<Watch>& ended) {
        const bool begins = !course.settled;
        course.settled = false;
        if (!hit(course, report)) return false;
        closed_.clear();
        for (const std::size_t place : touching(course))
            if (motion_.normal_velocity(place) <= params_.resting_speed) closed_.push_back(place);
        motion_.pose_accelerations(system_, closed_);
        exclude(course.phase, ended);
        const AccelerationChoice choice =
            choose_accelerations(motion_.problem, excluded_, params_.enumeration_contacts);
        report.counted = report.counted && choice.counted;
        if (choice.status != ChoiceStatus::one) {
            note_no_choice(choice.status, course.t, report);
            return false;
        }
        const SmoothPhase before = std::move(course.phase);
        take(choice.solution.modes, course.phase);
        if (!begins) note_changes(before, course, report);
        motion_.project(system_, course.t, course.x, course.phase, report.gap_correction,
                        report.velocity_correction);
        motion_.solve(system_, course.t, course.x, course.phase);
        course.phase.determinant = motion_.forces.determinant;
        course.phase.singular = motion_.forces.singular;
        course.settled = true;
        return true;
    }

    /// A phase that led to the border of Painleve's paradox.
    void note_border(EventCourse& course, EventReport& report) {
        motion_.solve(system_, course.t, course.x, course.phase);
        closed_ = course.phase.closed;
        note_no_choice(ChoiceStatus::none, course.t, report);
        course.settled = false;
    }
    /// Of contacts that slide in space: their directions as they are now.
    void turn_slips(EventCourse& course) {
        if (rows < 3 || course.phase.closed.empty()) return;
        motion_.evaluate(system_, course.t, course.x);
        motion_.pose(course.phase.closed);
        for (std::size_t c = 0; c < course.phase.closed.size(); ++c)
            if (motion_.problem.slides(c))
                course.phase.modes.slip.col(motion_.problem.column(c)) =
                    motion_.problem.slip.col(motion_.problem.column(c));
    }

  private:
    static ExcludedMode excluded_by(WatchKind kind) {
        if (kind == WatchKind::normal_force) return ExcludedMode::closed;
        if (kind == WatchKind::friction_margin) return ExcludedMode::sticking;
        return ExcludedMode::none;
    }
    /// Modes that shall not be taken again. Where one of several contacts that hold each other
    /// comes to its limit, those that are at theirs already (they slide, but not yet) are not to
    /// take its turn.
    void exclude(const SmoothPhase& before, const std::vector<Watch>& ended) {
        excluded_.assign(ended.empty() ? 0 : closed_.size(), ExcludedMode::none);
        for (const Watch& watch : ended)
            for (std::size_t c = 0; c < closed_.size(); ++c) {
                const bool at_limit = before.mode_at(closed_[c]) == ContactMode::sliding &&
                                      motion_.problem.mu[c] > 0.0 && !motion_.problem.slides(c);
                if (closed_[c] == watch.contact)
                    excluded_[c] = excluded_by(watch.kind);
                else if (watch.kind == WatchKind::friction_margin && at_limit)
                    excluded_[c] = ExcludedMode::sticking;
            }
    }
    /// Contacts that take part in what happens now: of the phase, or with a gap that is none.
    const std::vector<std::size_t>& touching(const EventCourse& course) {
        touching_.clear();
        for (std::size_t k = 0; k < motion_.contacts.size(); ++k)
            if (motion_.contacts[k].gap <= params_.touching ||
                course.phase.index_of(k) != SmoothPhase::none)
                touching_.push_back(k);
        return touching_;
    }
    /// Impacts, until no contact approaches any more. (A contact that was leaving may be hit from
    /// behind by the first.)
    bool hit(EventCourse& course, EventReport& report) {
        constexpr int most = 50;
        for (int k = 0; k < most; ++k) {
            motion_.evaluate(system_, course.t, course.x);
            const std::vector<std::size_t>& places = touching(course);
            approach_.clear();
            bool approaches = false;
            for (const std::size_t place : places) {
                approach_.push_back(motion_.normal_velocity(place));
                approaches = approaches || approach_.back() < -params_.resting_speed;
            }
            if (!approaches) return true;
            report.impact = impact_.solve(motion_, places, solver_);
            if (report.impact.status != SolveStatus::converged) {
                report.end = EventEnd::impact_not_solved;
                return false;
            }
            motion_.apply(impact_.impulse, course.x);
            if (!note_impact(places, course, report)) return false;
        }
        report.end = EventEnd::no_progress;
        return false;
    }
    /// Whether the impacts do not accumulate.
    bool note_impact(const std::vector<std::size_t>& places, EventCourse& course,
                     EventReport& report) {
        bool go_on = true;
        for (std::size_t c = 0; c < places.size(); ++c) {
            const double normal = impact_.impulse[motion_.problem.row(c)];
            if (!(normal > 0.0)) continue;
            report.events.push_back({course.t, EventKind::impact, places[c], approach_[c], normal});
            ImpactSeries& series = course.impacts[places[c]];
            series.note(course.t, params_.accumulation_time);
            if (series.count < params_.accumulation_count) continue;
            report.events.push_back({series.limit(), EventKind::accumulation, places[c]});
            report.end = EventEnd::accumulation;
            go_on = false;
        }
        return go_on;
    }
    void take(const ContactModes& modes, SmoothPhase& phase) const {
        phase = {};
        std::size_t count = 0;
        for (std::size_t c = 0; c < closed_.size(); ++c) count += modes.closed(c) ? 1 : 0;
        phase.modes.slip.setZero(rows - 1, static_cast<Eigen::Index>(count));
        for (std::size_t c = 0; c < closed_.size(); ++c) {
            if (!modes.closed(c)) continue;
            phase.modes.slip.col(static_cast<Eigen::Index>(phase.closed.size())) =
                modes.slip.col(static_cast<Eigen::Index>(c));
            phase.closed.push_back(closed_[c]);
            phase.modes.mode.push_back(modes.mode[c]);
        }
    }
    static void note_changes(const SmoothPhase& before, const EventCourse& course,
                             EventReport& report) {
        for (const std::size_t place : before.closed) {
            const ContactMode was = before.mode_at(place), is = course.phase.mode_at(place);
            const auto note = [&](EventKind kind) {
                report.events.push_back({course.t, kind, place});
            };
            if (is == ContactMode::open) {
                note(EventKind::detachment);
            } else if (was != is) {
                note(is == ContactMode::sticking ? EventKind::slip_to_stick
                                                 : EventKind::stick_to_slip);
            } else if (was == ContactMode::sliding &&
                       before.slip_at(place).dot(course.phase.slip_at(place)) < 0.0) {
                note(EventKind::slip_reversal);
            }
        }
    }
    /// Of the contact whose friction is strongest beside its normal stiffness.
    void note_no_choice(ChoiceStatus status, double t, EventReport& report) const {
        const AccelerationProblem& p = motion_.problem;
        if (status == ChoiceStatus::not_found) {
            report.end = AccelerationLcp::has_form(p) ? EventEnd::acceleration_not_found
                                                      : EventEnd::slip_in_space;
            return;
        }
        std::size_t worst = 0;
        double most = -1.0;
        for (std::size_t c = 0; c < closed_.size(); ++c) {
            const Eigen::Index n = p.row(c);
            const double coupling =
                p.mu[c] * p.w.row(n).segment(n + 1, p.rows - 1).norm() / p.w(n, n);
            if (coupling <= most) continue;
            most = coupling;
            worst = closed_[c];
        }
        const bool none = status == ChoiceStatus::none;
        report.events.push_back(
            {t, none ? EventKind::no_acceleration : EventKind::several_accelerations, worst});
        report.end = none ? EventEnd::no_acceleration : EventEnd::several_accelerations;
    }

    const System& system_;
    const EventDrivenParams& params_;
    Solver& solver_;
    ContactMotion<System> motion_;
    EventImpact<System> impact_;
    std::vector<std::size_t> closed_, touching_;
    std::vector<ExcludedMode> excluded_;
    std::vector<double> approach_;
};

}  // namespace talus
