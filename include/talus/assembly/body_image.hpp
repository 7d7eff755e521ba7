// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/ids.hpp>
#include <talus/core/types.hpp>

namespace talus {

/// An image of a body in a periodic cell; as it is made, the body itself.
template <int Dim>
requires SpaceDimension<Dim>
struct BodyImage {
    ImageShift shift = {};
    Vector<Dim> offset = Vector<Dim>::Zero();  ///< from the body [m]
    Vector<Dim> motion = Vector<Dim>::Zero();  ///< beyond that of the body, over one step [m]
};

}  // namespace talus
