// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// A sparse matrix of N x N blocks with a symmetric pattern, and its incomplete LU factors, which
/// have blocks where the matrix has some and nowhere else: ILU(0) [Saad2003]. Memory and the cost
/// of a solve are those of the matrix. It is a preconditioner: BlockLu solves.
///
/// `analyze` once per pattern; then `set_zero`, add to `block(slot(i, j))`, `factorize`; blocks
/// that change later change what `multiply` does, not what `precondition` does.
template <int N>
class BlockIlu {
  public:
    using Block = Eigen::Matrix<double, N, N>;
    using Vec = Eigen::VectorXd;

    /// `edges` are the off-diagonal blocks in both directions, repeated or not; blocks on the
    /// diagonal are there anyway.
    void analyze(int nodes, std::span<const std::pair<int, int>> edges);

    int node_count() const { return static_cast<int>(diagonal_.size()); }
    /// Where block (i, j) is, for `block`.
    std::size_t slot(int i, int j) const {
        const auto at = [&](std::size_t k) {
            return column_.begin() + static_cast<std::ptrdiff_t>(k);
        };
        const auto row = static_cast<std::size_t>(i);
        const auto found = std::lower_bound(at(begin_[row]), at(begin_[row + 1]), j);
        return static_cast<std::size_t>(found - column_.begin());
    }
    Block& block(std::size_t slot) { return value_[slot]; }
    void set_zero() { std::fill(value_.begin(), value_.end(), Block::Zero()); }

    /// False if a block on the diagonal becomes singular or not finite.
    bool factorize();
    /// y = A x.
    void multiply(const Vec& x, Vec& y) const {
        y.resize(x.size());
        for (std::size_t i = 0; i < diagonal_.size(); ++i) {
            Segment sum = Segment::Zero();
            for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k)
                sum.noalias() += value_[k] * at(x, column_[k]);
            y.template segment<N>(static_cast<Eigen::Index>(N * i)) = sum;
        }
    }
    /// x := (L U)^-1 x.
    void precondition(Vec& x) const;

  private:
    using Segment = Eigen::Matrix<double, N, 1>;
    static auto at(const Vec& x, int i) {
        return x.template segment<N>(static_cast<Eigen::Index>(N) * i);
    }

    // By rows, columns ascending.
    std::vector<std::size_t> begin_, diagonal_;
    std::vector<int> column_;
    std::vector<Block> value_, factor_;  ///< the factors' diagonal blocks are inverted
    std::vector<std::ptrdiff_t> place_;  ///< of each column in the row in hand, or -1
};

template <int N>
void BlockIlu<N>::analyze(int nodes, std::span<const std::pair<int, int>> edges) {
    // Buckets by row, then each row sorted: linear in the edges but for the short sorts.
    const auto n = static_cast<std::size_t>(nodes);
    std::vector<std::size_t> count(n + 1, 0);
    for (const auto& edge : edges) ++count[static_cast<std::size_t>(edge.first) + 1];
    for (std::size_t i = 0; i < n; ++i) count[i + 1] += count[i] + 1;
    std::vector<int> all(count[n]);
    std::vector<std::size_t> next(count.begin(), count.end() - 1);
    for (int i = 0; i < nodes; ++i) all[next[static_cast<std::size_t>(i)]++] = i;
    for (const auto& [i, j] : edges) all[next[static_cast<std::size_t>(i)]++] = j;
    begin_.assign(1, 0);
    column_.clear();
    for (std::size_t i = 0; i < n; ++i) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(count[i]);
        const auto last = all.begin() + static_cast<std::ptrdiff_t>(count[i + 1]);
        std::sort(first, last);
        column_.insert(column_.end(), first, std::unique(first, last));
        begin_.push_back(column_.size());
    }
    diagonal_.clear();
    for (int i = 0; i < nodes; ++i) diagonal_.push_back(slot(i, i));
    value_.resize(column_.size());
    place_.assign(n, -1);
}

template <int N>
bool BlockIlu<N>::factorize() {
    // Row by row (IKJ): row i has the rows k < i of its pattern subtracted. What would fall on a
    // block that the matrix has not is dropped: that is the 0 of ILU(0).
    factor_ = value_;
    const auto place = [&](std::size_t e) -> std::ptrdiff_t& {
        return place_[static_cast<std::size_t>(column_[e])];
    };
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e)
            place(e) = static_cast<std::ptrdiff_t>(e);
        for (std::size_t e = begin_[i]; e < diagonal_[i]; ++e) {
            const auto k = static_cast<std::size_t>(column_[e]);
            const Block left = factor_[e] * factor_[diagonal_[k]];
            factor_[e] = left;
            for (std::size_t f = diagonal_[k] + 1; f < begin_[k + 1]; ++f)
                if (const std::ptrdiff_t to = place(f); to >= 0)
                    factor_[static_cast<std::size_t>(to)].noalias() -= left * factor_[f];
        }
        for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e) place(e) = -1;
        // Inverted once, as each solve would do otherwise; N is 6 at most. Rows are not exchanged
        // beyond the block: matrices are near to positive definite.
        Block& pivot = factor_[diagonal_[i]];
        pivot = Block(pivot).partialPivLu().inverse();
        if (!pivot.allFinite()) return false;
    }
    return true;
}

template <int N>
void BlockIlu<N>::precondition(Vec& x) const {
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        auto to = x.template segment<N>(static_cast<Eigen::Index>(N * i));
        Segment sum = to;
        for (std::size_t k = begin_[i]; k < diagonal_[i]; ++k)
            sum.noalias() -= factor_[k] * at(x, column_[k]);
        to = sum;
    }
    // U, whose diagonal blocks are stored as inverses; L above has unit ones.
    for (std::size_t i = diagonal_.size(); i-- > 0;) {
        auto to = x.template segment<N>(static_cast<Eigen::Index>(N * i));
        Segment sum = to;
        for (std::size_t k = diagonal_[i] + 1; k < begin_[i + 1]; ++k)
            sum.noalias() -= factor_[k] * at(x, column_[k]);
        to.noalias() = factor_[diagonal_[i]] * sum;
    }
}

}  // namespace talus
