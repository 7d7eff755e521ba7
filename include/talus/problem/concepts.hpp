// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <concepts>
#include <cstddef>
#include <span>

namespace talus {

/// W = H^T M^-1 H seen contact by contact. Knows nothing of bodies or shapes.
template <class W, int Rows>
concept DelassusOperator = requires(const W& w, std::size_t i, std::span<const Vector<Rows>> r,
                                    std::span<Vector<Rows>> u) {
    { w.contact_count() } -> std::convertible_to<std::size_t>;
    { w.diagonal_block(i) } -> std::convertible_to<Matrix<Rows>>;  // W_ii [1/kg]
    w.multiply(r, u);                                              // u = W r [m/s]
};

/// A Delassus operator that can follow the impulses one contact at a time, as Gauss-Seidel needs.
/// `start(r)` takes the impulses in; then `velocity(i)` is row i of W r for the current impulses
/// and `add(i, dr)` changes r_i by dr. Costs of the last two: O(1) for a product operator,
/// O(neighbours) for an assembled one.
template <class W, int Rows>
concept SweepableDelassus = DelassusOperator<W, Rows> &&
    requires(W& w, std::size_t i, std::span<const Vector<Rows>> r, const Vector<Rows>& dr) {
    w.start(r);
    { w.velocity(i) } -> std::convertible_to<Vector<Rows>>;  // sum_j W_ij r_j [m/s]
    w.add(i, dr);                                            // r_i += dr [N s]
};

}  // namespace talus
