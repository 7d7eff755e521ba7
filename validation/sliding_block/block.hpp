// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"

/// Blocks that slide without turning, and what the friction at their contact does.
namespace validation {

/// A body that touches the floor at one point below its centre and does not turn: the point block.
template <int Dim>
talus::BodyIndex add_block(World<Dim>& world, double mass, const V<Dim>& foot,
                           const V<Dim>& velocity, double size = 0.1) {
    return world.add(talus::Ball<Dim>(size), point_mass<Dim>(mass), {foot + size * up<Dim>(), {}},
                     {velocity});
}

/// Speed at which the surfaces slide over each other at contact c at the end of the step [m/s].
template <int Dim>
double slip_speed(const StepData<Dim>& data, std::size_t c = 0) {
    return end_velocity(data, c).template tail<Dim - 1>().norm();
}

/// A direction along the floor that favours no axis of the contact's frame: at 37 degrees in space.
template <int Dim>
V<Dim> heading() {
    V<Dim> direction = V<Dim>::Unit(0);
    if constexpr (Dim == 3) direction = {std::cos(37 * degree), std::sin(37 * degree), 0.0};
    return direction;
}

/// A horizontal force on one body as a function of time and place.
template <int Dim, class Force>
void push(World<Dim>& world, talus::BodyIndex body, Force force) {
    const auto i = static_cast<std::size_t>(body);
    world.system().forces.push_back([i, force](double t, const talus::Bodies<Dim>& bodies,
                                               std::span<talus::Wrench<Dim>> wrenches) {
        wrenches[i].force += force(t, bodies.position[i]);
    });
}

/// Mean of |error(shift)| over eight starts shifted by fractions of a step: what is left is the
/// trend, without the luck of where in its step an event falls.
template <class Error>
double mean_over_shifts(Error error) {
    constexpr int count = 8;
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += std::abs(error((k + 0.37) / count));
    return sum / count;
}

}  // namespace validation
