// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace talus {

/// The dimensions of space that talus knows: the plane and ordinary space.
template <int Dim>
concept SpaceDimension = Dim == 2 || Dim == 3;

/// Degrees of freedom of a rotation: 1 in the plane, 3 in space.
template <int Dim>
requires SpaceDimension<Dim>
inline constexpr int rotation_dof = Dim == 2 ? 1 : 3;

/// Degrees of freedom of a rigid body: 3 in the plane, 6 in space.
template <int Dim>
requires SpaceDimension<Dim>
inline constexpr int twist_dof = Dim + rotation_dof<Dim>;

/// Rows of a contact's velocity u and impulse r: the normal and the tangents (2 in the plane, 3 in
/// space), or these and the rolling components as well (3 in the plane, 5 in space).
template <int Rows>
concept ContactRows = Rows == 2 || Rows == 3 || Rows == 5;

/// Rows of a contact with rolling components: (n, t, m) in the plane, (n, t1, t2, m1, m2) in space.
template <int Rows>
concept RollingRows = Rows == 3 || Rows == 5;

/// Those rows in space of that dimension.
template <int Dim>
requires SpaceDimension<Dim>
inline constexpr int rows_with_rolling = 2 * Dim - 1;

/// A dimension as a type, for tests and dispatch: `Dim<2>`, `Dim<3>`.
template <int D>
requires SpaceDimension<D>
struct DimensionTag {
    static constexpr int value = D;
};

}  // namespace talus
