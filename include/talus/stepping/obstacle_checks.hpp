// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/place.hpp>
#include <talus/dynamics/run_state.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// As the motion of an obstacle left its body.
template <int Dim>
struct PlacedObstacle {
    BodyIndex body;
    PlacedState<Dim> state;
};

/// Throws input_error if an obstacle is not as its motion left it at that time [s]: a place or a
/// velocity written into `bodies` would be lost without a word at the next step.
template <int Dim>
void require_in_place(const Bodies<Dim>& bodies, std::span<const Obstacle<Dim>> obstacles,
                      std::span<const PlacedObstacle<Dim>> placed, double time) {
    // Where the list of obstacles was written by hand there is no record to compare with.
    if (placed.size() != obstacles.size()) return;
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const auto i = static_cast<std::size_t>(obstacles[k].body);
        const bool recorded = placed[k].body == obstacles[k].body;
        if (recorded && bodies.is_obstacle(i) && !placed[k].state.is_of(bodies, i))
            detail::reject_motion(i, time,
                                  " does not lead to where the body is or to its velocity, which "
                                  "were changed by hand, but must: change the motion "
                                  "(System::obstacles)");
    }
}

/// Throws input_error for inverse masses and moments that no body has, and for a body without mass
/// or motion that has a velocity, with which it would push others and stay where it is.
template <int Dim>
void require_masses_or_motions(const Bodies<Dim>& bodies,
                               std::span<const Obstacle<Dim>> obstacles) {
    const std::size_t n = bodies.count();
    for (const Obstacle<Dim>& obstacle : obstacles) {
        require_in("body of an obstacle", obstacle.body, 0.0, static_cast<double>(n) - 1.0);
        if (!bodies.is_obstacle(obstacle.body))
            detail::reject(
                detail::numbered("inverse mass of body", static_cast<std::size_t>(obstacle.body),
                                 ", which has a prescribed motion,"),
                bodies.inverse_mass[obstacle.body], "0");
    }
    if (require_masses_of(bodies) == obstacles.size()) return;
    const auto has_motion = [&](std::size_t i) {
        for (const Obstacle<Dim>& obstacle : obstacles)
            if (static_cast<std::size_t>(obstacle.body) == i) return true;
        return false;
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (!bodies.is_obstacle(i)) continue;
        const double speed = bodies.velocity[i].norm() + bodies.spin[i].norm();
        const double turns = bodies.inverse_inertia[i].maxCoeff();
        if ((speed == 0.0 && turns == 0.0) || has_motion(i)) continue;
        if (turns != 0.0)
            detail::reject(detail::numbered("inverse moment of inertia of body", i), turns,
                           "0 like its inverse mass, which makes it an obstacle");
        detail::reject(detail::numbered("velocity of body", i), speed,
                       "0, as it has neither mass nor a prescribed motion");
    }
}

}  // namespace talus
