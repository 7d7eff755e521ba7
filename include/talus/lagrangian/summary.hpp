// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/contact_list.hpp>
#include <talus/lagrangian/step_data.hpp>
#include <talus/solver/report.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace talus {

/// What is to be known of a run of a Lagrangian system before its result is believed: what
/// RunSummary says of bodies.
struct LagrangianSummary {
    static constexpr std::size_t no_contact = std::numeric_limits<std::size_t>::max();
    /// A number that was the worst of the run, with when and where.
    struct Worst {
        double value = 0.0;
        double time = 0.0;                 ///< end of the step [s]
        std::size_t contact = no_contact;  ///< its place in the system's list
    };

    std::int64_t steps = 0;
    std::int64_t missed = 0;  ///< steps whose solver did not converge
    /// Steps whose free velocity was not found (VelocityForces::implicit_midpoint).
    std::int64_t missed_free = 0;
    Worst free_error;      ///< of FreeVelocityReport, of those [-]
    Worst residual;        ///< of SolveReport [-]
    Worst contact_error;   ///< of SolveReport: at the worst contact, in its own scale [-]
    Worst velocity_error;  ///< largest velocity by which a contact violated its law [m/s]
    /// The sum over all steps of h times the worst velocity error [m]: no overlap has grown by more
    /// than some 2 of it for want of accuracy (RunSummary::drift).
    double drift = 0.0;
    /// Deepest overlap of a closed contact, at a midpoint [m]. With the midpoint scheme it is up to
    /// h times the speed of approach; whether that is small the system alone knows.
    Worst overlap;
    bool stopped = false;  ///< by the observer

    /// Every step converged, and found its free velocity. (Look at `overlap` too.)
    bool certified() const { return missed == 0 && missed_free == 0; }

    /// Notes a step: a LagrangianStepData.
    template <class Data>
    void record(const Data& data) {
        ++steps;
        const SolveReport& report = data.report;
        if (report.status != SolveStatus::converged) ++missed;
        if (data.free_report.status != FreeVelocityStatus::converged) {
            ++missed_free;
            note(free_error, data.free_report.error, data, no_contact);
        }
        note(residual, report.residual, data, report.worst_contact);
        note(contact_error, report.contact_error, data, report.worst_contact);
        note(velocity_error, report.velocity_error, data, report.fastest_contact);
        drift += data.h * report.velocity_error;
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            note(overlap, -data.contacts[data.closed[c]].gap, data, c);
    }

    /// Takes in a run that went on after this one.
    void add(const LagrangianSummary& later) {
        steps += later.steps;
        missed += later.missed;
        missed_free += later.missed_free;
        drift += later.drift;
        stopped = later.stopped;
        for (const auto worst : {&LagrangianSummary::free_error, &LagrangianSummary::residual,
                                 &LagrangianSummary::contact_error,
                                 &LagrangianSummary::velocity_error, &LagrangianSummary::overlap}) {
            const Worst& other = later.*worst;
            if (other.value > (this->*worst).value || std::isnan(other.value)) this->*worst = other;
        }
    }

  private:
    template <class Data>
    static void note(Worst& worst, double value, const Data& data, std::size_t c) {
        if (!(value > worst.value) && !std::isnan(value)) return;
        worst = {value, data.t_end(), c < data.contact_count() ? data.closed[c] : no_contact};
    }
};

/// One sentence for people.
inline std::string to_string(const LagrangianSummary& run) {
    const auto at = [](const LagrangianSummary::Worst& worst) {
        std::string text =
            detail::text_of(worst.value) + " at t = " + detail::text_of(worst.time) + " s";
        if (worst.contact != LagrangianSummary::no_contact)
            text += " in " + detail::contact_text(worst.contact, {});
        return text;
    };
    if (run.steps == 0) return "no step was made";
    std::string text = (run.certified() ? "certified: " : "not certified: ") +
                       std::to_string(run.steps) + " steps, " + std::to_string(run.missed) +
                       " missed the tolerance";
    if (run.missed_free > 0)
        text += ", " + std::to_string(run.missed_free) +
                " did not find their free velocity (last change of it " + at(run.free_error) + ")";
    if (run.residual.value > 0.0)
        text += "; worst residual " + detail::text_of(run.residual.value) + ", worst contact " +
                at(run.contact_error);
    if (run.drift > 0.0)
        text += "; errors of velocity add up to " + detail::text_of(run.drift) + " m";
    if (run.overlap.value > 0.0) text += "; deepest overlap " + at(run.overlap);
    return text;
}

}  // namespace talus
