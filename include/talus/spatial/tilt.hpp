// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/spatial/rotation.hpp>

namespace talus {

/// The rotation that turns the first axis towards the last one by `angle` [rad], so that one text
/// tells of inclines in the plane and in space: with the last axis up, it takes that axis to the
/// normal of a plane that rises along the first axis, and stands a box on it.
template <int Dim>
requires SpaceDimension<Dim> Rotation<Dim> tilt(double angle) {
    if constexpr (Dim == 2)
        return Rotation<2>(angle);
    else
        return Rotation<3>::exp(AngularVector<3>(0.0, -angle, 0.0));
}

}  // namespace talus
