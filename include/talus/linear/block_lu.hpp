// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/linear/frontal_plan.hpp>
#include <talus/linear/serial_product.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// LU factors of a sparse matrix made of blocks, whose pattern (not its values) is symmetric: the
/// multifrontal method [DuffReid1983] on the graph of blocks, ordered by minimum degree or nested
/// dissection (FrontalPlan::Ordering). Rows are exchanged within the pivot block of a front only,
/// which is enough for matrices whose symmetric part is positive definite and in practice for those
/// near.
///
/// `analyze` once per pattern; then `set_zero`, add to `block(slot(i, j))`, `factorize` and `solve`
/// as often as values change. Cost for the contacts of n bodies: in the plane n^1.5 operations and
/// n log n numbers, in space n^2 and n^(4/3), about.
class BlockLu {
  public:
    using Dense = Eigen::MatrixXd;
    using BlockMap = Eigen::Map<Dense>;

    /// Plans the factorisation of a pattern: see FrontalPlan::analyze. Takes no memory for numbers
    /// yet.
    void analyze(std::span<const int> node_size, std::span<const std::pair<int, int>> edges,
                 FrontalPlan::Ordering ordering = FrontalPlan::Ordering::better) {
        plan_.analyze(node_size, edges, ordering);
        values_.clear();
    }

    int size() const { return plan_.size(); }  ///< rows
    /// Multiplications of one factorisation.
    double operations() const { return plan_.operations(); }
    std::size_t front_count() const { return plan_.fronts().size(); }
    /// Numbers in the factors: what memory and the cost of a solve go with.
    std::size_t factor_size() const { return plan_.factor_size(); }
    /// Memory for the numbers of the matrix, its factors and the work of factorising [bytes].
    double bytes() const {
        return static_cast<double>(sizeof(double)) *
               static_cast<double>(plan_.value_count() + plan_.factor_size() +
                                   plan_.largest_front() + plan_.deepest_stack());
    }

    /// Where block (i, j) is, for `block`. The block must be on the diagonal or among the edges.
    int slot(int i, int j) const { return plan_.slot(i, j); }
    /// The values of a block, to be added to after the first `set_zero`.
    BlockMap block(int slot) {
        const FrontalPlan::Slot& s = plan_.slot(slot);
        return BlockMap(values_.data() + s.value, s.rows, s.columns);
    }
    void set_zero() { values_.assign(plan_.value_count(), 0.0); }

    /// Factorises the present values. False if a pivot is zero or not finite.
    bool factorize();
    /// x := A^-1 x.
    void solve(Eigen::Ref<Eigen::VectorXd> x) const;

  private:
    using Front = FrontalPlan::Front;
    static std::size_t node(int i) { return static_cast<std::size_t>(i); }
    static bool eliminate(Eigen::Ref<Dense> a, int* exchange);

    FrontalPlan plan_;
    std::vector<int> exchange_, scatter_;
    std::vector<int> local_;  ///< row in the front in hand, of each position
    std::vector<double> values_, factor_, stack_, work_;
    mutable std::vector<double> gathered_;
};

#if TALUS_BODIES

/// LU with row exchanges of the upper square of `a` (as many rows as columns count), in place;
/// recursive, so that nearly all work is in matrix products.
TALUS_FUNCTION bool BlockLu::eliminate(Eigen::Ref<Dense> a, int* exchange) {
    // a = (a11 a12; a21 a22): the left half is factorised with all rows below it, its exchanges
    // carried over to the right half, and what is left of that factorised in turn.
    const Eigen::Index n = a.cols();
    constexpr Eigen::Index small = 8;
    if (n <= small) {
        for (Eigen::Index k = 0; k < n; ++k) {
            Eigen::Index best = 0;
            const double pivot = a.col(k).tail(a.rows() - k).cwiseAbs().maxCoeff(&best);
            // Not a test for a small pivot: the refinement of ConeSystem::solve sees to those.
            if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
            best += k;
            exchange[k] = static_cast<int>(best);
            if (best != k) a.row(k).swap(a.row(best));
            const Eigen::Index left = a.rows() - k - 1;
            a.col(k).tail(left) /= a(k, k);
            a.block(k + 1, k + 1, left, n - k - 1).noalias() -=
                a.col(k).tail(left) * a.row(k).tail(n - k - 1);
        }
        return true;
    }
    const Eigen::Index half = n / 2, other = n - half, rows = a.rows() - half;
    if (!eliminate(a.leftCols(half), exchange)) return false;
    for (Eigen::Index k = 0; k < half; ++k)
        if (exchange[k] != k) a.row(k).tail(other).swap(a.row(exchange[k]).tail(other));
    auto upper = a.topRightCorner(half, other);
    a.topLeftCorner(half, half).triangularView<Eigen::UnitLower>().solveInPlace(upper);
    subtract_product(a.bottomRightCorner(rows, other), a.bottomLeftCorner(rows, half), upper);
    if (!eliminate(a.bottomRightCorner(rows, other), exchange + half)) return false;
    for (Eigen::Index k = half; k < n; ++k) {
        exchange[k] += static_cast<int>(half);
        if (exchange[k] != k) a.row(k).head(half).swap(a.row(exchange[k]).head(half));
    }
    return true;
}

TALUS_FUNCTION bool BlockLu::factorize() {
    TALUS_CHECK(values_.size() == plan_.value_count(), "set_zero comes first");
    // Nothing is allocated after the first time: the plan knows all sizes.
    factor_.resize(plan_.factor_size());
    exchange_.resize(plan_.pivot_rows());
    work_.resize(plan_.largest_front());
    stack_.resize(plan_.deepest_stack());
    std::size_t top = 0;
    std::vector<int>& local = local_;
    local.assign(node(plan_.node_count()), 0);
    for (std::size_t index = 0; index < plan_.fronts().size(); ++index) {
        const Front& f = plan_.fronts()[index];
        const int rows = f.pivots + f.rest;
        // The front: rows of its pivots, then of the positions that they change.
        BlockMap a(work_.data(), rows, rows);
        a.setZero();
        for (const int k : plan_.slots_of(index)) {
            const FrontalPlan::Slot& s = plan_.slot(k);
            a.block(s.row, s.column, s.rows, s.columns) =
                Eigen::Map<const Dense>(values_.data() + s.value, s.rows, s.columns);
        }
        int row = 0;
        for (int k = f.first; k <= f.last; ++k) {
            local[node(k)] = row;
            row += plan_.width(k);
        }
        for (const int k : plan_.updates(f)) {
            local[node(k)] = row;
            row += plan_.width(k);
        }
        // The last child is on top of the stack.
        for (std::size_t c = f.children.size(); c-- > 0;) {
            const Front& child = plan_.fronts()[node(f.children[c])];
            top -= node(child.rest) * node(child.rest);
            const double* from = stack_.data() + top;
            // Row of the front for each row of the child's part.
            scatter_.clear();
            for (const int k : plan_.updates(child))
                for (int d = 0; d < plan_.width(k); ++d) scatter_.push_back(local[node(k)] + d);
            for (const int column : scatter_) {
                double* to = work_.data() + static_cast<std::ptrdiff_t>(column) * rows;
                for (std::size_t i = 0; i < scatter_.size(); ++i) to[scatter_[i]] += from[i];
                from += child.rest;
            }
        }
        // Pivots are looked for in the pivot block alone: rows of other fronts are not at hand, and
        // delayed pivots would change the plan. So a singular pivot block fails, and a nearly
        // singular one costs digits.
        auto pivot = a.topLeftCorner(f.pivots, f.pivots);
        int* exchange = exchange_.data() + f.row;
        if (!eliminate(pivot, exchange)) return false;
        double* out = factor_.data() + f.factor;
        BlockMap(out, f.pivots, f.pivots) = pivot;
        if (f.rest == 0) continue;
        BlockMap lower(out + f.pivots * f.pivots, f.rest, f.pivots);
        BlockMap upper(out + f.pivots * rows, f.pivots, f.rest);
        upper = a.topRightCorner(f.pivots, f.rest);
        for (int k = 0; k < f.pivots; ++k)
            if (exchange[k] != k) upper.row(k).swap(upper.row(exchange[k]));
        pivot.triangularView<Eigen::UnitLower>().solveInPlace(upper);
        lower = a.bottomLeftCorner(f.rest, f.pivots);
        pivot.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(lower);
        // The Schur complement waits for the parent.
        BlockMap s(stack_.data() + top, f.rest, f.rest);
        s = a.bottomRightCorner(f.rest, f.rest);
        subtract_product(s, lower, upper);
        top += node(f.rest) * node(f.rest);
    }
    return true;
}

TALUS_FUNCTION void BlockLu::solve(Eigen::Ref<Eigen::VectorXd> x) const {
    TALUS_CHECK(x.size() == size(), "one number per row");
    // In the order of elimination, and room for the rest of a front.
    gathered_.resize(node(size()) + work_.size());
    Eigen::Map<Eigen::VectorXd> y(gathered_.data(), size());
    for (int k = 0; k < plan_.node_count(); ++k)
        y.segment(plan_.ordered_row(k), plan_.width(k)) =
            x.segment(plan_.given_row(k), plan_.width(k));
    double* const rest = gathered_.data() + size();
    const auto each = [&](const Front& f, auto&& visit) {
        int r = 0;
        for (const int k : plan_.updates(f)) {
            visit(r, plan_.ordered_row(k), plan_.width(k));
            r += plan_.width(k);
        }
    };
    for (const Front& f : plan_.fronts()) {
        const double* data = factor_.data() + f.factor;
        const Eigen::Map<const Dense> pivot(data, f.pivots, f.pivots);
        const Eigen::Map<const Dense> lower(data + f.pivots * f.pivots, f.rest, f.pivots);
        auto top = y.segment(plan_.ordered_row(f.first), f.pivots);
        for (int k = 0; k < f.pivots; ++k) std::swap(top[k], top[exchange_[node(f.row + k)]]);
        pivot.triangularView<Eigen::UnitLower>().solveInPlace(top);
        if (f.rest == 0) continue;
        Eigen::Map<Eigen::VectorXd> down(rest, f.rest);
        down.noalias() = lower * top;
        each(f, [&](int r, int to, int w) { y.segment(to, w) -= down.segment(r, w); });
    }
    // Back: parents come first.
    for (std::size_t index = plan_.fronts().size(); index-- > 0;) {
        const Front& f = plan_.fronts()[index];
        const double* data = factor_.data() + f.factor;
        const Eigen::Map<const Dense> pivot(data, f.pivots, f.pivots);
        const Eigen::Map<const Dense> upper(data + f.pivots * (f.pivots + f.rest), f.pivots,
                                            f.rest);
        auto top = y.segment(plan_.ordered_row(f.first), f.pivots);
        if (f.rest > 0) {
            Eigen::Map<Eigen::VectorXd> down(rest, f.rest);
            each(f, [&](int r, int from, int w) { down.segment(r, w) = y.segment(from, w); });
            top.noalias() -= upper * down;
        }
        pivot.triangularView<Eigen::Upper>().solveInPlace(top);
    }
    for (int k = 0; k < plan_.node_count(); ++k)
        x.segment(plan_.given_row(k), plan_.width(k)) =
            y.segment(plan_.ordered_row(k), plan_.width(k));
}

#endif

}  // namespace talus
