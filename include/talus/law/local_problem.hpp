// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

namespace talus {

/// One contact in its local frame (n, t...), the others frozen:  u = W r + b. A local vector has
/// `Rows` components: those of space or, for laws with rolling friction, also the rolling ones.
template <int Rows>
requires ContactRows<Rows>
struct LocalProblem {
    Matrix<Rows> W;  ///< diagonal Delassus block [1/kg], symmetric positive semidefinite
    Vector<Rows> b;  ///< relative velocity without this contact's impulse [m/s]

    Vector<Rows> velocity(const Vector<Rows>& r) const { return W * r + b; }
};

}  // namespace talus
