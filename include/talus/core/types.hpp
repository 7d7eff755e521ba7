// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/dimension.hpp>
#include <talus/core/small_matrix.hpp>

#include <cstddef>

namespace talus {

/// A vector of space; in a contact's local frame its components are (normal, tangent...).
template <int Dim, class Real = double>
using Vector = SmallMatrix<Dim, 1, Real>;

/// A linear map of space.
template <int Dim, class Real = double>
using Matrix = SmallMatrix<Dim, Dim, Real>;

/// A spin or a moment: one number in the plane, a vector in space.
template <int Dim, class Real = double>
using AngularVector = SmallMatrix<rotation_dof<Dim>, 1, Real>;

/// A linear map of spins, such as an inertia tensor.
template <int Dim, class Real = double>
using AngularMatrix = SmallMatrix<rotation_dof<Dim>, rotation_dof<Dim>, Real>;

/// The tangential components of a vector in a contact's local frame.
template <int Rows, class Real>
SmallMatrix<Rows - 1, 1, Real> tangential(const SmallMatrix<Rows, 1, Real>& x) {
    SmallMatrix<Rows - 1, 1, Real> t;
    detail::for_each_index<Rows - 1>([&](int i) { t.data()[i] = x.data()[i + 1]; });
    return t;
}

/// The vector with these components in a contact's local frame.
template <int TangentRows, class Real>
SmallMatrix<TangentRows + 1, 1, Real> in_local_frame(
    Real normal, const SmallMatrix<TangentRows, 1, Real>& tangential) {
    SmallMatrix<TangentRows + 1, 1, Real> x;
    x.data()[0] = normal;
    detail::for_each_index<TangentRows>([&](int i) { x.data()[i + 1] = tangential.data()[i]; });
    return x;
}

}  // namespace talus
