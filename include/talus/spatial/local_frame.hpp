// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <cmath>

namespace talus {

/// Axes of a contact as the rows of an orthonormal matrix, normal first: (n, t) or (n, t1, t2),
/// right-handed. `local = frame * world`, `world = frame^T * local`.
template <int Dim>
using LocalFrame = Matrix<Dim>;

/// The frame of a unit `normal`. In the plane t is n turned by +90 degrees. In space the tangents
/// follow from n by [DuffEtAl2017], continuous but for the normals with n_z = 0-: nothing that
/// talus computes depends on the choice of tangents, and impulses are carried over in world axes.
template <int Dim>
requires SpaceDimension<Dim> LocalFrame<Dim> local_frame(const Vector<Dim>& normal) {
    LocalFrame<Dim> frame;
    if constexpr (Dim == 2) {
        frame << normal[0], normal[1], -normal[1], normal[0];
    } else {
        const double sign = std::copysign(1.0, normal[2]);
        const double a = -1.0 / (sign + normal[2]);
        const double b = normal[0] * normal[1] * a;
        frame << normal[0], normal[1], normal[2],                                 //
            1.0 + sign * normal[0] * normal[0] * a, sign * b, -sign * normal[0],  //
            b, sign + normal[1] * normal[1] * a, -normal[1];
    }
    return frame;
}

}  // namespace talus
