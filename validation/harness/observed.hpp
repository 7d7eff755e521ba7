// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <limits>
#include <span>

#include "world.hpp"

/// Small things that many cases do: a force of their own, the slip of a contact, means over starts.
namespace validation {

/// Applies force(t, x) [N] to one body through its centre at the place x.
template <int Dim, class Force>
void push(World<Dim>& world, talus::BodyIndex body, Force force) {
    const auto i = static_cast<std::size_t>(body);
    world.system().forces.push_back([i, force](double t, const talus::Bodies<Dim>& bodies,
                                               std::span<talus::Wrench<Dim>> wrenches) {
        wrenches[i].force += force(t, bodies.position[i]);
    });
}

/// Speed at which the surfaces slide over each other at contact c at the end of the step [m/s];
/// infinite where there is no such contact.
template <int Dim>
double slip_speed(const StepData<Dim>& data, std::size_t c = 0) {
    if (c >= data.contact_count()) return std::numeric_limits<double>::infinity();
    return end_velocity(data, c).template tail<Dim - 1>().norm();
}

/// Mean of error(shift) over starts shifted by fractions of a step: what is left is the trend,
/// without the luck of where in its step an event falls.
template <class Error>
double mean_over_shifts(int count, Error error) {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += error((k + 0.37) / count);
    return sum / count;
}

}  // namespace validation
