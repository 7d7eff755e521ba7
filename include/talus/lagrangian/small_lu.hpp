// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace talus {

/// P A = L U of a square matrix of few rows, by Gauss's elimination with row pivots. Keeps its
/// memory. Eigen's `PartialPivLU` works in blocks, whatever the size, which takes each program that
/// uses it seconds to compile. Cost: n^3 / 3.
template <int Dof>
class SmallLu {
  public:
    using Square = Eigen::Matrix<double, Dof, Dof>;

    /// What is not finite, or a singular A, gives solutions that are not finite.
    void factor(const Square& a) {
        const Eigen::Index n = a.rows();
        lu_ = a;
        row_.resize(static_cast<std::size_t>(n));
        for (Eigen::Index k = 0; k < n; ++k) {
            Eigen::Index largest = k;
            for (Eigen::Index i = k + 1; i < n; ++i)
                if (std::abs(lu_(i, k)) > std::abs(lu_(largest, k))) largest = i;
            row_[static_cast<std::size_t>(k)] = largest;
            if (largest != k)
                for (Eigen::Index j = 0; j < n; ++j) std::swap(lu_(k, j), lu_(largest, j));
            for (Eigen::Index i = k + 1; i < n; ++i) {
                lu_(i, k) /= lu_(k, k);
                for (Eigen::Index j = k + 1; j < n; ++j) lu_(i, j) -= lu_(i, k) * lu_(k, j);
            }
        }
    }
    /// A^-1 b in place of b.
    template <class Column>
    void solve(Column& b) const {
        const Eigen::Index n = lu_.rows();
        for (Eigen::Index k = 0; k < n; ++k) std::swap(b[k], b[row_[static_cast<std::size_t>(k)]]);
        for (Eigen::Index i = 1; i < n; ++i)
            for (Eigen::Index j = 0; j < i; ++j) b[i] -= lu_(i, j) * b[j];
        for (Eigen::Index i = n - 1; i >= 0; --i) {
            for (Eigen::Index j = i + 1; j < n; ++j) b[i] -= lu_(i, j) * b[j];
            b[i] /= lu_(i, i);
        }
    }

  private:
    Square lu_;                      ///< U, and below its diagonal L, whose own diagonal is 1
    std::vector<Eigen::Index> row_;  ///< with which row k changed places as it was reduced
};

}  // namespace talus
