// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace validation {

/// Mistakes that are put into the method on purpose, to see which case notices.
enum class Fault {
    none,
    control,  ///< no fault, but through the doors that the faults use: nobody may notice
    friction_off,
    faceted_cone,
    axis_bias,
    pulling_contact,
    restitution_weight,
    friction_on_end_velocity,
    begin_point,
    end_point_drift,
    obstacle_velocity_forgotten,
    force_at_begin,
    gyroscopic_dropped,
    stale_inertia,
    short_arm,
    tilted_normal,
    reaction_lost,
    loose_contact,
    wrong_warm_start,
    residual_ignored,
    forces_in_local_axes,
    mean_over_sectors_forgotten,
    ghost_edge,
    sliver_face,
    worst_contact_ignored,
    stale_candidates,
};

struct FaultText {
    Fault fault;
    std::string_view name;
    std::string_view title;
};

inline constexpr std::array fault_texts{
    FaultText{Fault::friction_off, "friction_off", "Friction coefficient 2 % too large"},
    FaultText{Fault::faceted_cone, "faceted_cone",
              "Friction cone of four generators in place of the round one"},
    FaultText{Fault::axis_bias, "axis_bias",
              "Friction 2 % larger along the first axis of the contact frame, one way"},
    FaultText{Fault::pulling_contact, "pulling_contact", "Contacts pull as well as push"},
    FaultText{Fault::restitution_weight, "restitution_weight",
              "Normal velocities averaged with a weight 2 % off"},
    FaultText{Fault::friction_on_end_velocity, "friction_on_end_velocity",
              "Friction opposes the end velocity, not the mean"},
    FaultText{Fault::begin_point, "begin_point",
              "Geometry taken at the beginning of the step, not at its midpoint"},
    FaultText{Fault::end_point_drift, "end_point_drift",
              "Positions advanced by h times the end velocity"},
    FaultText{Fault::obstacle_velocity_forgotten, "obstacle_velocity_forgotten",
              "Velocity of obstacles left out of the relative velocity"},
    FaultText{Fault::force_at_begin, "force_at_begin",
              "Applied forces taken at the beginning of the step"},
    FaultText{Fault::gyroscopic_dropped, "gyroscopic_dropped", "Gyroscopic term left out"},
    FaultText{Fault::stale_inertia, "stale_inertia", "Inertia tensor not turned with the body"},
    FaultText{Fault::short_arm, "short_arm", "Lever arms 1 % too short"},
    FaultText{Fault::tilted_normal, "tilted_normal", "Contact normals tilted by 1 mrad"},
    FaultText{Fault::reaction_lost, "reaction_lost",
              "One of the two bodies receives 1 % less of the impulse"},
    FaultText{Fault::loose_contact, "loose_contact",
              "Contacts closed at 2 % of the body's size before they touch"},
    FaultText{Fault::wrong_warm_start, "wrong_warm_start",
              "Remembered impulses handed to the neighbouring contact"},
    FaultText{Fault::residual_ignored, "residual_ignored",
              "The solver stops after two sweeps and claims to have converged"},
    FaultText{Fault::forces_in_local_axes, "forces_in_local_axes",
              "Measured contact forces left in contact axes"},
    FaultText{Fault::mean_over_sectors_forgotten, "mean_over_sectors_forgotten",
              "Fourier fit of a histogram without the width of its sectors"},
    FaultText{Fault::ghost_edge, "ghost_edge",
              "Contacts anticipated at the nearest points, also at sides that a body slides past"},
    FaultText{Fault::sliver_face, "sliver_face",
              "Contacts of two hulls drawn into a tenth of their common face"},
    FaultText{Fault::worst_contact_ignored, "worst_contact_ignored",
              "The solver looks at the residual of all contacts together, not at the worst"},
    FaultText{Fault::stale_candidates, "stale_candidates",
              "The broad phase keeps to the pairs that it found first"},
};

inline constexpr const FaultText& text_of(Fault fault) {
    for (const FaultText& text : fault_texts)
        if (text.fault == fault) return text;
    return fault_texts[0];
}

}  // namespace validation
