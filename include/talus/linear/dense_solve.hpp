// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>

#include <Eigen/Core>
#if TALUS_BODIES
#include <Eigen/LU>
#include <Eigen/QR>
#endif

/// Dense systems of a few unknowns, as oracles solve them: no templates, since a pivoted
/// factorisation takes seconds to compile and needs no size that is known then.
namespace talus {

/// x with a x = b, refined once, and true; where the square `a` is singular to rounding, the x of
/// least norm with the least |a x - b|, and false. Cost: O(n^3).
TALUS_FUNCTION bool solve_dense(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                Eigen::VectorXd& x);
/// a^-1 b by LU with full pivoting. Not finite, or far off, where `a` is singular. Cost: O(n^3).
TALUS_FUNCTION Eigen::MatrixXd solved_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// Determinant of a square matrix, by LU. Cost: O(n^3).
TALUS_FUNCTION double dense_determinant(const Eigen::MatrixXd& a);

#if TALUS_BODIES

TALUS_FUNCTION bool solve_dense(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                Eigen::VectorXd& x) {
    x.resize(a.rows());
    if (a.rows() == 0) return true;
    constexpr double rank = 1e-11;  // pivots smaller than that part of the largest count as zero
    Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
    lu.setThreshold(rank);
    if (!lu.isInvertible()) {
        // The threshold first: it decides which columns are reduced.
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least(a.rows(), a.cols());
        least.setThreshold(rank);
        least.compute(a);
        x = least.solve(b);
        return false;
    }
    x = lu.solve(b);
    x += lu.solve(Eigen::VectorXd(b - a * x));
    return true;
}
TALUS_FUNCTION Eigen::MatrixXd solved_dense(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.fullPivLu().solve(b);
}
TALUS_FUNCTION double dense_determinant(const Eigen::MatrixXd& a) { return a.determinant(); }

#endif

}  // namespace talus
