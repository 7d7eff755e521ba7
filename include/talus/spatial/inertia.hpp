// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/types.hpp>
#include <talus/spatial/rotation.hpp>

namespace talus {

/// Inertia of a body about its mass centre, in its principal axes (so that the inertia matrix A of
/// the paper, section 1.2, is diagonal and constant).
template <int Dim>
requires SpaceDimension<Dim>
struct Inertia {
    double mass = 1.0;                                          ///< [kg]
    AngularVector<Dim> principal = AngularVector<Dim>::Ones();  ///< [kg m^2]
};

/// Inertia tensor in world axes of principal moments `principal` turned by `rotation`:
/// R diag(principal) R^T; in the plane just the number.
template <int Dim>
AngularMatrix<Dim> tensor_world(const Rotation<Dim>& rotation,
                                const AngularVector<Dim>& principal) {
    if constexpr (Dim == 2) {
        return AngularMatrix<2>(principal[0]);
    } else {
        const Matrix<3> r = rotation.matrix();
        return columns_scaled<3>(r, principal) * r.transpose();
    }
}

}  // namespace talus
