// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

namespace talus {

/// One contact in its local frame (n, t...), the others frozen:  u = W r + b.
template <int Dim>
requires SpaceDimension<Dim>
struct LocalProblem {
    Matrix<Dim> W;  ///< diagonal Delassus block [1/kg], symmetric positive semidefinite
    Vector<Dim> b;  ///< relative velocity without this contact's impulse [m/s]

    Vector<Dim> velocity(const Vector<Dim>& r) const { return W * r + b; }
};

}  // namespace talus
