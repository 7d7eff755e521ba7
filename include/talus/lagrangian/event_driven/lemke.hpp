// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace talus {

/// How Lemke's algorithm ended.
enum class LemkeStatus {
    solved,
    ray,         ///< on a secondary ray: for copositive M of some classes a proof that there is no
                 ///< solution, otherwise nothing
    pivot_limit  ///< or arithmetic that is not finite
};

struct LemkeResult {
    LemkeStatus status;
    Eigen::VectorXd z;
    int pivots;
};

/// One solution of the linear complementarity problem
///
///   w = M z + q ,   w >= 0, z >= 0, w . z = 0 ,
///
/// by complementary pivots on a dense tableau [Lemke1965], with the covering vector of ones. Ties
/// are broken by lexicographic order, so that it does not cycle. Entries of a pivot column below
/// 1e-11 of its largest count as zero.
inline LemkeResult lemke(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                         int max_pivots = 1000) {
    const Eigen::Index n = q.size();
    TALUS_CHECK(m.rows() == n && m.cols() == n, "M is square and as large as q");
    LemkeResult result{LemkeStatus::solved, Eigen::VectorXd::Zero(n), 0};
    if (n == 0 || q.minCoeff() >= 0.0) return result;
    // Columns: w (n), z (n), the covering variable, right-hand side.
    const Eigen::Index cover = 2 * n, right = 2 * n + 1;
    Eigen::MatrixXd table(n, 2 * n + 2);
    table << Eigen::MatrixXd::Identity(n, n), -m, -Eigen::VectorXd::Ones(n), q;
    std::vector<Eigen::Index> basic(static_cast<std::size_t>(n));
    for (Eigen::Index i = 0; i < n; ++i) basic[static_cast<std::size_t>(i)] = i;

    // Whether row i over its pivot comes before row j: the right-hand side, then the columns of w.
    const auto before = [&](Eigen::Index i, double pivot_i, Eigen::Index j, double pivot_j) {
        for (Eigen::Index c = -1; c < n; ++c) {
            const Eigen::Index column = c < 0 ? right : c;
            const double a = table(i, column) / pivot_i, b = table(j, column) / pivot_j;
            if (a != b) return a < b;
        }
        return false;
    };
    const auto pivot = [&](Eigen::Index row, Eigen::Index column) {
        table.row(row) /= table(row, column);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double factor = table(i, column);
            if (i == row || factor == 0.0) continue;
            table.row(i) -= factor * table.row(row);
            table(i, column) = 0.0;
        }
        Eigen::Index& place = basic[static_cast<std::size_t>(row)];
        const Eigen::Index left = place;
        place = column;
        ++result.pivots;
        return left;
    };

    Eigen::Index row = 0;
    for (Eigen::Index i = 1; i < n; ++i)
        if (before(i, 1.0, row, 1.0)) row = i;
    Eigen::Index left = pivot(row, cover);
    while (left != cover) {
        const Eigen::Index enter = left < n ? left + n : left - n;
        const double least = 1e-11 * table.col(enter).cwiseAbs().maxCoeff();
        row = -1;
        for (Eigen::Index i = 0; i < n; ++i) {
            if (!(table(i, enter) > least)) continue;
            if (row < 0 || before(i, table(i, enter), row, table(row, enter))) row = i;
        }
        if (row < 0) {
            result.status = LemkeStatus::ray;
            return result;
        }
        // The covering variable leaves as soon as it may, also where only rounding lets another one
        // go first: that is the end.
        constexpr double rounding = 1e-11;
        const double ratio = table(row, right) / table(row, enter);
        for (Eigen::Index i = 0; i < n; ++i)
            if (basic[static_cast<std::size_t>(i)] == cover && table(i, enter) > least &&
                table(i, right) / table(i, enter) <= (1.0 + rounding) * ratio)
                row = i;
        left = pivot(row, enter);
        if (result.pivots >= max_pivots || !table.allFinite()) {
            result.status = LemkeStatus::pivot_limit;
            return result;
        }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index v = basic[static_cast<std::size_t>(i)];
        if (v >= n && v < cover) result.z[v - n] = std::max(0.0, table(i, right));
    }
    return result;
}

}  // namespace talus
