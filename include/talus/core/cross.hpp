// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <Eigen/Geometry>

namespace talus {

/// Velocity of the point at `arm` from the centre, turning with `spin`: spin x arm.
template <int Dim>
requires SpaceDimension<Dim>
inline Vector<Dim> cross(const AngularVector<Dim>& spin, const Vector<Dim>& arm) {
    if constexpr (Dim == 2)
        return {-spin[0] * arm[1], spin[0] * arm[0]};
    else
        return spin.cross(arm);
}

/// Moment about the centre of `force` acting at `arm`: arm x force.
template <int Dim>
requires SpaceDimension<Dim>
inline AngularVector<Dim> moment(const Vector<Dim>& arm, const Vector<Dim>& force) {
    if constexpr (Dim == 2)
        return AngularVector<2>(arm[0] * force[1] - arm[1] * force[0]);
    else
        return arm.cross(force);
}

/// The matrix L with moment(arm, f) = L f and cross(w, arm) = L^T w.
template <int Dim>
requires SpaceDimension<Dim>
inline Eigen::Matrix<double, rotation_dof<Dim>, Dim> moment_matrix(const Vector<Dim>& arm) {
    Eigen::Matrix<double, rotation_dof<Dim>, Dim> l;
    if constexpr (Dim == 2)
        l << -arm[1], arm[0];
    else
        l << 0.0, -arm[2], arm[1], arm[2], 0.0, -arm[0], -arm[1], arm[0], 0.0;
    return l;
}

}  // namespace talus
