// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"
#include "harness/gsl.hpp"
#include "harness/observed.hpp"

/// Bodies whose centre moves on a circle of one metre: inside a bowl, or over a dome.
namespace validation {

inline constexpr double particle = 0.1;  ///< radius of the moving ball [m]

/// A ball that does not turn inside a bowl, its centre one metre from that of the bowl, at an angle
/// from the lowest point and with a speed along the circle.
template <int Dim>
World<Dim> particle_in_bowl(Trial<Dim>& trial, double h, double angle, double speed) {
    auto world = trial.world({.h = h});
    world.add_obstacle(Bowl<Dim>{1.0 + particle});
    world.add(talus::Ball<Dim>(particle), point_mass<Dim>(1.0),
              {in_plane<Dim>(std::sin(angle), -std::cos(angle)), {}},
              {speed * in_plane<Dim>(std::cos(angle), std::sin(angle))});
    return world;
}

/// Angle of body 1 from the lowest point of a circle about the origin.
template <int Dim>
double angle_from_bottom(const World<Dim>& world) {
    const V<Dim>& x = world.bodies().position[1];
    return std::atan2(x[0], -x[Dim - 1]);
}
/// And from the highest one.
template <int Dim>
double angle_from_top(const World<Dim>& world) {
    const V<Dim>& x = world.bodies().position[1];
    return std::atan2(x[0], x[Dim - 1]);
}

}  // namespace validation
