// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "world.hpp"

namespace validation {

/// The situation of a world as an SVG, seen along the middle axis in space: bodies, obstacles,
/// velocities (blue) and the impulses of the last step (red).
template <int Dim>
std::string sketch(const World<Dim>& world);

}  // namespace validation
