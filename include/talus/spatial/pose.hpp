// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/spatial/rotation.hpp>

namespace talus {

/// Placement of a body: where its frame stands in the world (or in another frame).
template <int Dim>
requires SpaceDimension<Dim>
struct Pose {
    Vector<Dim> position = Vector<Dim>::Zero();  ///< origin of the body frame [m]
    Rotation<Dim> rotation;                      ///< body axes to world axes

    /// World coordinates of a point given in the body frame.
    Vector<Dim> point_world(const Vector<Dim>& point_body) const {
        return position + rotation * point_body;
    }
    /// Body coordinates of a point given in the world.
    Vector<Dim> point_body(const Vector<Dim>& point_world) const {
        return rotation.transpose_times(point_world - position);
    }
    Pose inverse() const { return {-rotation.transpose_times(position), rotation.inverse()}; }
    /// The pose, in the frame that holds *this*, of a frame placed by `inner` in this one.
    Pose operator*(const Pose& inner) const {
        return {point_world(inner.position), rotation * inner.rotation};
    }
};

}  // namespace talus
