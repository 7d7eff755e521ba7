// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/dimension.hpp>

#include <Eigen/Core>

#include <cstddef>

namespace talus {

/// A vector of space; in a contact's local frame its components are (normal, tangent...).
template <int Dim, class Real = double>
using Vector = Eigen::Matrix<Real, Dim, 1>;

/// A linear map of space.
template <int Dim, class Real = double>
using Matrix = Eigen::Matrix<Real, Dim, Dim>;

/// A spin or a moment: one number in the plane, a vector in space.
template <int Dim, class Real = double>
using AngularVector = Eigen::Matrix<Real, rotation_dof<Dim>, 1>;

/// A linear map of spins, such as an inertia tensor.
template <int Dim, class Real = double>
using AngularMatrix = Eigen::Matrix<Real, rotation_dof<Dim>, rotation_dof<Dim>>;

}  // namespace talus
