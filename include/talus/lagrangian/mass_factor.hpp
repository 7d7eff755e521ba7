// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/contact_list.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace talus {

/// A = L L^T of a mass matrix, by Cholesky. Keeps its memory.
template <int Dof>
class MassFactor {
  public:
    using MassMatrix = Eigen::Matrix<double, Dof, Dof>;

    /// Throws input_error, naming the degree of freedom, unless A, the mass matrix at time t, is
    /// symmetric to 1e-9 and positive definite to rounding.
    void factor(const MassMatrix& a, double t) {
        require_symmetric(a, t);
        const Eigen::Index n = a.rows();
        l_ = a;
        for (Eigen::Index j = 0; j < n; ++j) {
            double pivot = a(j, j);
            for (Eigen::Index k = 0; k < j; ++k) pivot -= l_(j, k) * l_(j, k);
            const double least = 4.0 * static_cast<double>(n) *
                                 std::numeric_limits<double>::epsilon() * std::abs(a(j, j));
            if (!(pivot > least)) reject_pivot(j, pivot, least, t);
            l_(j, j) = std::sqrt(pivot);
            for (Eigen::Index i = j + 1; i < n; ++i) {
                double x = a(i, j);
                for (Eigen::Index k = 0; k < j; ++k) x -= l_(i, k) * l_(j, k);
                l_(i, j) = x / l_(j, j);
            }
        }
    }
    /// L^-1 b in place of b, column by column.
    template <class Columns>
    void forward(Columns& b) const {
        for (Eigen::Index c = 0; c < b.cols(); ++c)
            for (Eigen::Index i = 0; i < l_.rows(); ++i) {
                for (Eigen::Index k = 0; k < i; ++k) b(i, c) -= l_(i, k) * b(k, c);
                b(i, c) /= l_(i, i);
            }
    }
    /// L^-T b in place of b.
    template <class Columns>
    void backward(Columns& b) const {
        for (Eigen::Index c = 0; c < b.cols(); ++c)
            for (Eigen::Index i = l_.rows() - 1; i >= 0; --i) {
                for (Eigen::Index k = i + 1; k < l_.rows(); ++k) b(i, c) -= l_(k, i) * b(k, c);
                b(i, c) /= l_(i, i);
            }
    }
    /// A^-1 b in place of b.
    template <class Columns>
    void solve(Columns& b) const {
        forward(b);
        backward(b);
    }
    /// sqrt(x^T A x): the one size of a velocity whose components have different units [sqrt(J)].
    template <class Coordinates>
    double norm(const Coordinates& x) const {
        double sum = 0.0;
        for (Eigen::Index j = 0; j < l_.rows(); ++j) {
            double y = 0.0;
            for (Eigen::Index i = j; i < l_.rows(); ++i) y += l_(i, j) * x[i];
            sum += y * y;
        }
        return std::sqrt(sum);
    }

  private:
    static void require_symmetric(const MassMatrix& a, double t) {
        constexpr double tolerance = 1e-9;
        for (Eigen::Index i = 0; i < a.rows(); ++i)
            for (Eigen::Index j = 0; j < i; ++j) {
                const double size = std::abs(a(i, i)) + std::abs(a(j, j));
                if (!(std::abs(a(i, j) - a(j, i)) <= tolerance * size))
                    detail::reject(detail::at_time(entry(i, j), t), a(i, j),
                                   "that of " + entry(j, i) + ", " + detail::text_of(a(j, i)));
            }
    }
    static std::string entry(Eigen::Index i, Eigen::Index j) {
        return "mass matrix[" + std::to_string(i) + "][" + std::to_string(j) + "]";
    }
    [[noreturn]] static void reject_pivot(Eigen::Index j, double pivot, double least, double t) {
        detail::reject(detail::at_time("mass matrix is not positive definite: its pivot of "
                                       "coordinate " +
                                           std::to_string(j),
                                       t),
                       pivot, "above " + detail::text_of(least));
    }

    MassMatrix l_;  // lower triangle
};

}  // namespace talus
