// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"
#include "harness/observed.hpp"

/// Blocks that slide without turning.
namespace validation {

/// A body that touches the floor at one point below its centre and does not turn: the point block.
template <int Dim>
talus::BodyIndex add_block(World<Dim>& world, double mass, const V<Dim>& foot,
                           const V<Dim>& velocity, double size = 0.1) {
    return world.add(talus::Ball<Dim>(size), point_mass<Dim>(mass), {foot + size * up<Dim>(), {}},
                     {velocity});
}

/// A direction along the floor that favours no axis of the contact's frame: at 37 degrees in space.
template <int Dim>
V<Dim> heading() {
    V<Dim> direction = V<Dim>::Unit(0);
    if constexpr (Dim == 3) direction = {std::cos(37 * degree), std::sin(37 * degree), 0.0};
    return direction;
}

}  // namespace validation
