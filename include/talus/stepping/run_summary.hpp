// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/stepping/step_data.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace talus {

/// What is to be known of a run before its result is believed.
struct RunSummary {
    /// A number that was the worst of the run, with when and between which bodies.
    struct Worst {
        double value = 0.0;
        double time = 0.0;  ///< end of the step [s]
        /// Indices in that step; no_body where there was none.
        BodyIndex a = no_body, b = no_body;
    };
    static constexpr BodyIndex no_body = -1;
    static constexpr double deepest_overlap = 0.15;  ///< of a run that is certified [-]

    std::int64_t steps = 0;
    std::int64_t missed = 0;  ///< steps whose solver did not converge
    /// Steps whose solver met its tolerance but not what it aims at beyond (DefaultSolver): many of
    /// them do not harm what flows; what stands by little may creep.
    std::int64_t short_of_aim = 0;
    Worst residual;        ///< of SolveReport [-]
    Worst contact_error;   ///< of SolveReport: at the worst contact, in its own scale [-]
    Worst velocity_error;  ///< largest velocity by which a contact violated its law [m/s]
    /// The sum over all steps of h times the worst velocity error [m]: times sqrt(1 + mu^2), or 2
    /// if that is less, no overlap has grown by more for want of accuracy. A bound, and far above
    /// what comes of it where the worst contact is another one in each step: it is told, `overlap`
    /// is judged. It is of one contact: along a chain of them, as up a tower, overlaps add up.
    double drift = 0.0;
    /// Deepest overlap as a fraction of half the thickness of the thinner body
    /// (System::half_thickness; of discs and balls: the radius) [-].
    Worst overlap;
    /// How far two bodies went in one step, of their thicknesses together [-]. Contacts are looked
    /// for once a step: beyond 1 the two that went furthest could have passed through each other
    /// unseen, had they met. Only the gap-anticipating scheme sees what is in the way, and not for
    /// contacts with restitution.
    Worst travel;
    /// Steps in which a body turned too far to keep its angular momentum (StepData).
    std::int64_t turned_too_far = 0;
    bool stopped = false;  ///< by the observer

    /// Every step converged, no body was entered by more than 0.15 of half its thickness, and none
    /// turned too far. Of contacts that were seen: look at `travel` where bodies are thin or fast.
    bool certified() const {
        return missed == 0 && overlap.value <= deepest_overlap && turned_too_far == 0;
    }

    /// Notes a step. O(bodies + contacts). Throws input_error if bodies were removed since the
    /// step; those that were added are left out.
    template <int Dim, class Law, class ShapeType>
    void record(const System<Dim, Law, ShapeType>& system, const StepData<Dim, Law>& data) {
        data.contacts.require_bodies(system.bodies.id);
        ++steps;
        if (data.report.status != SolveStatus::converged)
            ++missed;
        else if (data.report.short_of_aim)
            ++short_of_aim;
        turned_too_far += data.turned_too_far > 0 ? 1 : 0;
        const std::size_t c = data.report.worst_contact;
        note(residual, data.report.residual, data, c);
        note(contact_error, data.report.contact_error, data, c);
        note(velocity_error, data.report.velocity_error, data, data.report.fastest_contact);
        drift += data.h * data.report.velocity_error;
        note_travel(system, data);
        const auto half = system.half_thickness();
        for (std::size_t k = 0; k < data.contact_count(); ++k) {
            if (data.contacts.gap[k] >= 0.0) continue;
            const BodyIndex a = data.contacts.key[k].a, b = data.contacts.key[k].b;
            const double thinner =
                std::min(half[static_cast<std::size_t>(a)], half[static_cast<std::size_t>(b)]);
            note(overlap, -data.contacts.gap[k] / thinner, data, k);
        }
    }

    /// Takes in a run that went on after this one.
    void add(const RunSummary& later) {
        steps += later.steps;
        missed += later.missed;
        short_of_aim += later.short_of_aim;
        turned_too_far += later.turned_too_far;
        drift += later.drift;
        stopped = later.stopped;
        for (const auto worst : all_worst) {
            const Worst& other = later.*worst;
            if (other.value > (this->*worst).value || std::isnan(other.value)) this->*worst = other;
        }
    }

    /// To be carried through a checkpoint.
    void write(NumberRecord& out) const {
        for (const std::int64_t k : {steps, missed, short_of_aim, turned_too_far}) out.integer(k);
        out.integer(stopped);
        out.real(drift);
        for (const auto one : all_worst) {
            const Worst& worst = this->*one;
            out.real(worst.value);
            out.real(worst.time);
            out.integer(worst.a);
            out.integer(worst.b);
        }
    }
    static RunSummary read(NumberRecordReader& in) {
        RunSummary run;
        for (std::int64_t* k : {&run.steps, &run.missed, &run.short_of_aim, &run.turned_too_far})
            *k = in.integer(0);
        run.stopped = in.integer(0, 1) == 1;
        run.drift = in.real();
        for (const auto one : all_worst) {
            Worst& worst = run.*one;
            worst.value = in.real();
            worst.time = in.real();
            worst.a = in.integer<BodyIndex>();
            worst.b = in.integer<BodyIndex>();
        }
        return run;
    }

  private:
    static constexpr std::array all_worst{&RunSummary::residual, &RunSummary::contact_error,
                                          &RunSummary::velocity_error, &RunSummary::overlap,
                                          &RunSummary::travel};

    /// Of all pairs, that of the two bodies with the most way beyond their own thickness has the
    /// most together; what has no bounds has no other side.
    template <class System, class Data>
    void note_travel(const System& system, const Data& data) {
        struct Way {
            double beyond = -std::numeric_limits<double>::infinity(), way = 0.0, thickness = 0.0;
            std::size_t body = 0;
        } first, second;
        const auto compare = [&](std::size_t i, const auto& linear, const auto& angular) {
            const double radius = system.bounding_radius()[i];
            const double thickness = 2.0 * system.half_thickness()[i];
            if (!std::isfinite(radius) || !std::isfinite(thickness)) return;
            const double way = linear.norm() + angular.norm() * radius;
            const Way one{way - thickness, way, thickness, i};
            if (one.beyond > first.beyond)
                second = std::exchange(first, one);
            else if (one.beyond > second.beyond)
                second = one;
        };
        for (std::size_t i = 0; i < data.end.size(); ++i) {
            if (system.bodies.is_obstacle(i)) continue;
            auto linear = data.end[i].linear;
            // In a periodic cell they go past each other by what they do not move as it does.
            if (data.cell) linear -= data.cell->velocity_at(system.bodies.position[i]);
            compare(i, data.h * linear, data.h * data.end[i].angular);
        }
        // Where they went, not by what their motions say of it: they may have jumped.
        for (const auto& [body, motion] : system.obstacles) {
            if (static_cast<std::size_t>(body) >= data.end.size()) continue;
            const auto way = motion.displacement(data.t_begin, data.t_end());
            compare(static_cast<std::size_t>(body), way.linear, way.angular);
        }
        const double thickness = first.thickness + second.thickness;
        if (!std::isfinite(second.beyond) || !(thickness > 0.0)) return;
        const double share = (first.way + second.way) / thickness;
        if (share > travel.value)
            travel = {share, data.t_end(), static_cast<BodyIndex>(first.body),
                      static_cast<BodyIndex>(second.body)};
    }

    template <class Data>
    [[gnu::noinline]] static void note(Worst& worst, double value, const Data& data,
                                       std::size_t contact) {
        if (!(value > worst.value) && !std::isnan(value)) return;
        worst = {value, data.t_end()};
        if (contact >= data.contact_count()) return;
        worst.a = data.contacts.key[contact].a;
        worst.b = data.contacts.key[contact].b;
    }
};

/// One sentence for people.
inline std::string to_string(const RunSummary& run) {
    const auto at = [](const RunSummary::Worst& worst) {
        std::string text =
            detail::text_of(worst.value) + " at t = " + detail::text_of(worst.time) + " s";
        if (worst.a != RunSummary::no_body)
            text +=
                " between bodies " + std::to_string(worst.a) + " and " + std::to_string(worst.b);
        return text;
    };
    if (run.steps == 0) return "no step was made";
    std::string text = (run.certified() ? "certified: " : "not certified: ") +
                       std::to_string(run.steps) + " steps, " + std::to_string(run.missed) +
                       " missed the tolerance";
    if (run.short_of_aim > 0)
        text += ", " + std::to_string(run.short_of_aim) + " met it short of the solver's aim";
    if (run.residual.value > 0.0)
        text += "; worst residual " + detail::text_of(run.residual.value) + ", worst contact " +
                at(run.contact_error);
    if (run.drift > 0.0)
        text += "; errors of velocity add up to " + detail::text_of(run.drift) + " m";
    if (run.overlap.value > 0.0)
        text += "; deepest overlap, of half the thinner body, " + at(run.overlap) +
                (run.overlap.value > RunSummary::deepest_overlap
                     ? ", but must be at most " + detail::text_of(RunSummary::deepest_overlap)
                     : "");
    if (run.turned_too_far > 0)
        text += "; a body turned by more than 1.5 rad in " + std::to_string(run.turned_too_far) +
                " steps, and lost its angular momentum: a smaller h keeps it";
    if (run.travel.value > 1.0)
        text += "; went too far in one step to be sure to meet, of their thicknesses, " +
                at(run.travel);
    return text;
}

}  // namespace talus
