// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"

namespace validation {

/// A force on one body as a function of its place.
template <int Dim, class Force>
void add_spring(World<Dim>& world, talus::BodyIndex body, Force force) {
    const auto i = static_cast<std::size_t>(body);
    world.system().forces.push_back([i, force](double, const talus::Bodies<Dim>& bodies,
                                               std::span<talus::Wrench<Dim>> wrenches) {
        wrenches[i].force += force(bodies.position[i]);
    });
}

}  // namespace validation
