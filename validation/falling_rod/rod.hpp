// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"
#include "harness/gsl.hpp"
#include "harness/observed.hpp"

/// A uniform rod of one metre and one kilogram that falls in a vertical plane, one end (the foot)
/// on the floor. Angles are from the vertical.
namespace validation {

inline constexpr double rod_length = 1.0, rod_mass = 1.0;

/// At rest, leaning towards the first axis, its foot at the origin.
template <int Dim>
World<Dim> leaning_rod(Trial<Dim>& trial, double mu, double h, double angle, double rate = 0.0) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_floor();
    const double half = rod_length / 2;
    world.add(
        Rod<Dim>{rod_length}, rod_inertia<Dim>(rod_mass, rod_length),
        {half * in_plane<Dim>(std::sin(angle), std::cos(angle)), tilt<Dim>(pi / 2 - angle)},
        {rate * half * in_plane<Dim>(std::cos(angle), -std::sin(angle)), rolling_spin<Dim>(rate)});
    return world;
}

/// The rod pivoting about its foot from rest at `start`: its angle and rate after a time `delay`.
inline std::vector<double> pivoted(double start, double delay) {
    std::vector<double> y{start, 0.0};
    if (delay <= 0.0) return y;
    const std::array times{0.0, delay};
    return gsl::ode(
               [](double, std::span<const double> s, std::span<double> ds) {
                   ds[0] = s[1];
                   ds[1] = 1.5 * g / rod_length * std::sin(s[0]);
               },
               y, times)
        .back();
}

template <int Dim>
double rod_angle(const World<Dim>& world) {
    const V<Dim> axis = world.bodies().rotation[1] * V<Dim>(V<Dim>::Unit(0));
    return std::atan2(axis[0], axis[Dim - 1]);
}
template <int Dim>
double rod_rate(const World<Dim>& world) {
    return -tilting_spin<Dim>(world.bodies().twist(1));
}
template <int Dim>
V<Dim> rod_foot(const World<Dim>& world) {
    return world.bodies().pose(1).point_world(Rod<Dim>{rod_length}.end(-1));
}

}  // namespace validation
