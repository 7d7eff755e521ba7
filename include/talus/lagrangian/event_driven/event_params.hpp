// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <cstdint>

namespace talus {

/// Settings of EventDriven.
struct EventDrivenParams {
    /// Error allowed in a smooth step, relative to each coordinate and velocity [-], in
    /// [1e-13, 1e-2]. The steps of order 5 cost 1.6 times as many for each digit.
    double relative_tolerance = 1e-10;
    /// The same, in the unit of each coordinate and velocity; for those near 0.
    double absolute_tolerance = 1e-12;
    /// Longest smooth step [s]. Eight instants in each are looked at for events: a force that
    /// vanishes and comes back between two of them is not seen. (A gap that closes and opens is.)
    double longest_step = 1e-2;
    /// Gap up to which contacts count as closed where something happens: contacts that are hit
    /// together, or that a motion begins with [m]. What overlaps more at the beginning is refused.
    double touching = 1e-9;
    /// Relative velocity that counts as none: below it a contact stays, or sticks [m/s].
    double resting_speed = 1e-9;
    /// Impacts of one contact accumulate where so many in a row come each within this time of the
    /// one before [s].
    double accumulation_time = 1e-6;
    int accumulation_count = 5;
    int max_events = 100000;            ///< of one `advance`
    std::int64_t max_steps = 10000000;  ///< smooth ones of one `advance`
    /// Contacts up to which all statuses are tried, and solutions counted, in [0, 8]; above it
    /// Lemke's algorithm takes one. 4^n systems are solved where n contacts are at rest.
    int enumeration_contacts = 5;
    /// By what coordinates change as the system moves, and in what time what moves as told does
    /// [s]: where differences of G and W are begun with. Need not be known well.
    double coordinate_scale = 1.0;
    double time_scale = 1.0;

    /// Throws input_error naming the setting that is out of range.
    void require_valid() const {
        constexpr double most = 1e9;
        require_in("relative tolerance", relative_tolerance, 1e-13, 1e-2);
        require_positive("absolute tolerance", absolute_tolerance);
        require_positive("longest step", longest_step);
        require_positive("gap that counts as touching", touching);
        require_positive("resting speed", resting_speed);
        require_positive("accumulation time", accumulation_time);
        require_in("accumulation count", accumulation_count, 2.0, most);
        require_in("greatest number of events", max_events, 1.0, most);
        require_in("greatest number of steps", static_cast<double>(max_steps), 1.0, 1e15);
        require_in("contacts to enumerate", enumeration_contacts, 0.0, 8.0);
        require_positive("coordinate scale", coordinate_scale);
        require_positive("time scale", time_scale);
    }
};

}  // namespace talus
