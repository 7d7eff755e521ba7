// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>

namespace talus {

/// Eigenvalues, ascending, and eigenvectors of a small symmetric matrix, of which the lower
/// triangle is read. Finite for finite input.
template <int N>
struct SymmetricEigen {
    Eigen::Matrix<double, N, 1> values;
    Eigen::Matrix<double, N, N> vectors;  ///< in columns, of length 1

    explicit SymmetricEigen(const Eigen::Matrix<double, N, N>& m) {
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver;
        double scale = 1.0;
        if constexpr (N == 2) {
            // It is tridiagonal as it stands. Eigen's general way does the same and instantiates
            // Householder sequences for it, which took a sixth of the compile time of a small user.
            scale = m.template triangularView<Eigen::Lower>().toDenseMatrix().cwiseAbs().maxCoeff();
            if (scale == 0.0) scale = 1.0;
            solver.computeFromTridiagonal(m.diagonal() / scale,
                                          Eigen::Matrix<double, 1, 1>(m(1, 0) / scale));
        } else {
            solver.compute(m);
        }
        values = solver.eigenvalues() * scale;
        vectors = solver.eigenvectors();
    }
};

}  // namespace talus
