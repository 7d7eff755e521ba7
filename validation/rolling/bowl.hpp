// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "rolling/round_body.hpp"

/// Round bodies that roll inside a bowl: angles th from the lowest point.
namespace validation {

inline constexpr double bowl_radius = 1.0, ball_radius = 0.1, release = 60 * degree;
inline constexpr double path_radius = bowl_radius - ball_radius;

/// A homogeneous disc or sphere let go on the inside of the bowl at 60 degrees.
template <int Dim>
World<Dim> ball_in_bowl(Trial<Dim>& trial, double mu, double h) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_obstacle(Bowl<Dim>{bowl_radius});
    world.add(talus::Ball<Dim>(ball_radius), round_inertia<Dim>(1.0, ball_radius),
              {path_radius * in_plane<Dim>(std::sin(release), -std::cos(release)), {}});
    return world;
}

template <int Dim>
double bowl_angle(const World<Dim>& world, std::size_t body = 1) {
    const V<Dim>& x = world.bodies().position[body];
    return std::atan2(x[0], -x[Dim - 1]);
}

}  // namespace validation
