// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/contact_list.hpp>
#include <talus/solver/report.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// What happens to a contact between two smooth phases.
enum class EventKind {
    impact,                ///< it closed with a speed, or was hit through others
    detachment,            ///< its force came down to zero, or an impact elsewhere opened it
    slip_to_stick,         ///< its slip came to an end
    stick_to_slip,         ///< its friction no longer held it
    slip_reversal,         ///< it slides the other way
    accumulation,          ///< impacts that come faster and faster, at the time they lead to
    no_acceleration,       ///< no accelerations and forces obey the laws (Painleve: inconsistency)
    several_accelerations  ///< more than one motion goes on from here (Painleve: indeterminacy)
};

/// The word for it, as its enumerator is written.
constexpr std::string_view to_string(EventKind kind) {
    constexpr std::string_view words[] = {
        "impact",        "detachment",   "slip_to_stick",   "stick_to_slip",
        "slip_reversal", "accumulation", "no_acceleration", "several_accelerations"};
    return words[static_cast<std::size_t>(kind)];
}

/// An event of one contact.
struct MotionEvent {
    /// [s]. Of an accumulation: the limit of its impacts, taken from the last three as if of a
    /// geometric series; it lies after the time that was reached.
    double time;
    EventKind kind;
    std::size_t contact;    ///< its place in the system's list
    double approach = 0.0;  ///< of an impact: normal relative velocity before it [m/s]
    double impulse = 0.0;   ///< of an impact: the normal one [N s]
};

/// Why `EventDriven::advance` came to its end. Only the first means that all was done.
enum class EventEnd {
    duration_reached,       ///< the time that was asked for has passed
    stopped,                ///< an observer asked to stop
    event_limit,            ///< EventDrivenParams::max_events
    step_limit,             ///< EventDrivenParams::max_steps
    step_too_small,         ///< the tolerance is not met by any step: F jumps or bends too much, or
                            ///< the tolerance is near rounding
    accumulation,           ///< impacts accumulate: a limit of the method
    no_acceleration,        ///< no continuous motion goes on: a limit of the method
    several_accelerations,  ///< several do, and nothing chooses: a limit of the method
    acceleration_not_found,  ///< more contacts than are enumerated, and Lemke's algorithm found
                             ///< nothing; or their forces are not unique, and none tried is right
    slip_in_space,           ///< a contact with two tangential rows begins to slide from rest, in a
                             ///< direction that is not determined here: not supported
    impact_not_solved,       ///< the solver missed its tolerance: `impact` says by how much
    no_progress              ///< events follow one another without any time between
};

/// The word for it, as its enumerator is written.
constexpr std::string_view to_string(EventEnd end) {
    constexpr std::string_view words[] = {
        "duration_reached",       "stopped",       "event_limit",       "step_limit",
        "step_too_small",         "accumulation",  "no_acceleration",   "several_accelerations",
        "acceleration_not_found", "slip_in_space", "impact_not_solved", "no_progress"};
    return words[static_cast<std::size_t>(end)];
}

/// What a run came to.
struct EventReport {
    EventEnd end = EventEnd::no_progress;
    double time = 0.0;  ///< reached [s]: position and velocity are those of then
    std::vector<MotionEvent> events;
    std::int64_t steps = 0;     ///< smooth ones that were taken
    std::int64_t rejected = 0;  ///< and tried in vain
    /// What contacts that stay had drifted by at the end of a step, the most that was taken back:
    /// gap [m] and relative velocity [m/s]. Of the size of the tolerance.
    double gap_correction = 0.0, velocity_correction = 0.0;
    /// Whether wherever accelerations were chosen all of them were known: not after Lemke's
    /// algorithm, nor where forces of redundant contacts left a doubt.
    bool counted = true;
    SolveReport impact;  ///< of the last impact

    /// Whether the run went where it was asked to.
    bool done() const { return end == EventEnd::duration_reached; }
    /// How many events of a kind there are.
    std::size_t count(EventKind kind) const {
        std::size_t n = 0;
        for (const MotionEvent& e : events)
            if (e.kind == kind) ++n;
        return n;
    }
};

/// One sentence for people.
inline std::string to_string(const EventReport& run) {
    std::string text = std::string(run.done() ? "done" : "not done") + ": " +
                       std::string(to_string(run.end)) + " at t = " + detail::text_of(run.time) +
                       " s, after " + std::to_string(run.steps) + " steps and " +
                       std::to_string(run.events.size()) + " events";
    if (!run.events.empty()) {
        const MotionEvent& e = run.events.back();
        text += ", the last " + std::string(to_string(e.kind)) + " of " +
                detail::contact_text(e.contact, {}) + " at t = " + detail::text_of(e.time) + " s";
    }
    if (!run.counted) text += "; not all choices of accelerations were known to be the only ones";
    return text;
}

}  // namespace talus
