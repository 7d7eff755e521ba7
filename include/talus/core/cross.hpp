// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

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
inline SmallMatrix<rotation_dof<Dim>, Dim> moment_matrix(const Vector<Dim>& arm) {
    SmallMatrix<rotation_dof<Dim>, Dim> l;
    if constexpr (Dim == 2)
        l << -arm[1], arm[0];
    else
        l << 0.0, -arm[2], arm[1], arm[2], 0.0, -arm[0], -arm[1], arm[0], 0.0;
    return l;
}

/// The axes about which two bodies roll on each other, in rows, from those of their contact, (n,
/// t...): the tangents; in the plane, which knows one axis only, the normal of the plane.
template <int Dim>
requires SpaceDimension<Dim>
inline SmallMatrix<Dim - 1, rotation_dof<Dim>> rolling_axes(
    [[maybe_unused]] const Matrix<Dim>& frame) {
    if constexpr (Dim == 2)
        return Matrix<1>::Identity();
    else
        return frame.template bottomRows<2>();
}

/// m diag(scale): each column times its factor.
template <int N>
Matrix<N> columns_scaled(Matrix<N> m, const Vector<N>& scale) {
    for (int j = 0; j < N; ++j)
        for (int i = 0; i < N; ++i) m(i, j) *= scale[j];
    return m;
}

/// The x with m x = b, by Cramer's rule: as accurate as the condition of m allows, and not finite
/// if m is singular.
inline Vector<3> solve_by_cramer(const Matrix<3>& m, const Vector<3>& b) {
    const Vector<3> x(m(0, 0), m(1, 0), m(2, 0)), y(m(0, 1), m(1, 1), m(2, 1)),
        z(m(0, 2), m(1, 2), m(2, 2));
    const Vector<3> across = y.cross(z);
    return Vector<3>(across.dot(b), z.cross(x).dot(b), x.cross(y).dot(b)) / x.dot(across);
}

}  // namespace talus
