// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <Eigen/Core>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// LU factors of a sparse matrix made of blocks, whose pattern (not its values) is symmetric: the
/// multifrontal method [DuffReid1983] on the graph of blocks, ordered by approximate minimum degree
/// [AmestoyDavisDuff1996]. Rows are exchanged within the pivot block of a front only, which is
/// enough for matrices whose symmetric part is positive definite and in practice for those near.
///
/// `analyze` once per pattern; then `set_zero`, add to `block(slot(i, j))`, `factorize` and `solve`
/// as often as values change. Cost for the contacts of n bodies: in the plane n^1.5 operations and
/// n log n numbers, in space n^2 and n^(4/3), about.
class BlockLu {
  public:
    using Dense = Eigen::MatrixXd;
    using BlockMap = Eigen::Map<Dense>;

    /// Symbolic factorisation for nodes of the given sizes; `edges` are the off-diagonal blocks,
    /// each in one direction or both, repeated or not.
    void analyze(std::span<const int> node_size, std::span<const std::pair<int, int>> edges);

    int size() const { return offset_.empty() ? 0 : offset_.back(); }  ///< rows
    /// Multiplications of one factorisation.
    double operations() const {
        double sum = 0.0;
        for (const Front& f : fronts_) {
            const double p = f.pivots, r = f.rest;
            sum += p * (p * p / 3.0 + r * (p + r));
        }
        return sum;
    }
    std::size_t front_count() const { return fronts_.size(); }
    /// Numbers in the factors: what memory and the cost of a solve go with.
    std::size_t factor_size() const { return factor_.size(); }

    /// Where block (i, j) is, for `block`. The block must be on the diagonal or among the edges.
    int slot(int i, int j) const {
        const auto begin = neighbour_.begin() + row_begin_[node(i)];
        const auto end = neighbour_.begin() + row_begin_[node(i) + 1];
        const auto found = std::lower_bound(begin, end, j);
        TALUS_CHECK(found != end && *found == j, "the block must be in the pattern");
        return static_cast<int>(found - neighbour_.begin());
    }
    /// The values of a block, to be added to.
    BlockMap block(int slot) {
        const Slot& s = slots_[node(slot)];
        return BlockMap(values_.data() + s.value, s.rows, s.columns);
    }
    void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

    /// Factorises the present values. False if a pivot is zero or not finite.
    bool factorize();
    /// x := A^-1 x.
    void solve(Eigen::Ref<Eigen::VectorXd> x) const;

  private:
    struct Slot {
        std::ptrdiff_t value;
        int rows, columns;
        int front;
        int row, column;  ///< where it goes in the front
    };
    struct Front {
        int first, last;        ///< pivots, as positions in the order
        int update_begin;       ///< in update_
        int pivots, rest;       ///< rows of the pivot block, and of the others
        std::ptrdiff_t factor;  ///< in factor_: pivot block, L below it, U beside it
        int row;                ///< in exchange_
        std::vector<int> children;
    };
    static std::size_t node(int i) { return static_cast<std::size_t>(i); }
    int width(int position) const {
        const int i = order_[node(position)];
        return offset_[node(i) + 1] - offset_[node(i)];
    }
    std::span<const int> updates(const Front& f) const {
        const std::size_t front = static_cast<std::size_t>(&f - fronts_.data());
        const int end = front + 1 < fronts_.size() ? fronts_[front + 1].update_begin
                                                   : static_cast<int>(update_.size());
        return std::span(update_).subspan(node(f.update_begin), node(end - f.update_begin));
    }

    void order_nodes(int n);
    std::vector<std::vector<int>> column_structures(int n, std::vector<int>& parent) const;
    void make_fronts(const std::vector<std::vector<int>>& below, const std::vector<int>& parent);
    void place_blocks();
    static bool eliminate(Eigen::Ref<Dense> a, int* exchange);

    std::vector<int> ordered_offset_;    ///< first row of each position
    std::vector<int> offset_;            ///< first row of each node
    std::vector<int> row_begin_;         ///< of each node in neighbour_
    std::vector<int> neighbour_;         ///< of each node, ascending, itself included
    std::vector<int> order_, position_;  ///< node at each position, and back
    std::vector<Slot> slots_;            ///< one per entry of neighbour_
    std::vector<int> slots_of_front_, slots_begin_;
    std::vector<Front> fronts_;
    std::vector<int> update_;  ///< positions
    std::vector<int> exchange_, scatter_;
    std::vector<int> local_;  ///< row in the front in hand, of each position
    std::vector<double> values_, factor_, stack_, work_;
    mutable std::vector<double> gathered_;
};

inline void BlockLu::analyze(std::span<const int> node_size,
                             std::span<const std::pair<int, int>> edges) {
    const int n = static_cast<int>(node_size.size());
    offset_.assign(1, 0);
    for (const int size : node_size) offset_.push_back(offset_.back() + size);
    std::vector<std::pair<int, int>> all;
    all.reserve(2 * edges.size() + node_size.size());
    for (int i = 0; i < n; ++i) all.emplace_back(i, i);
    for (const auto& [i, j] : edges) {
        all.emplace_back(i, j);
        all.emplace_back(j, i);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    row_begin_.assign(node(n) + 1, 0);
    neighbour_.clear();
    for (const auto& [i, j] : all) {
        neighbour_.push_back(j);
        row_begin_[node(i) + 1] = static_cast<int>(neighbour_.size());
    }
    order_nodes(n);
    std::vector<int> parent;
    const auto below = column_structures(n, parent);
    make_fronts(below, parent);
    place_blocks();
}

/// Minimum degree on the graph of nodes, then a postorder of the elimination tree, so that the
/// children of a front come just before it.
inline void BlockLu::order_nodes(int n) {
    Eigen::SparseMatrix<double> pattern(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i)
        for (int k = row_begin_[node(i)]; k < row_begin_[node(i) + 1]; ++k)
            entries.emplace_back(i, neighbour_[node(k)], 1.0);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    order_.assign(permutation.indices().data(), permutation.indices().data() + n);

    const auto number = [&] {
        position_.assign(node(n), 0);
        for (int k = 0; k < n; ++k) position_[node(order_[node(k)])] = k;
    };
    number();
    std::vector<int> parent(node(n), -1), ancestor(node(n), -1);
    for (int k = 0; k < n; ++k) {
        const std::size_t i = node(order_[node(k)]);
        for (int e = row_begin_[i]; e < row_begin_[i + 1]; ++e)
            for (int j = position_[node(neighbour_[node(e)])]; j != -1 && j < k;) {
                const int next = ancestor[node(j)];
                ancestor[node(j)] = k;
                if (next == -1) parent[node(j)] = k;
                j = next;
            }
    }
    std::vector<std::vector<int>> children(node(n));
    std::vector<int> stack, visited;
    for (int k = 0; k < n; ++k) {
        if (parent[node(k)] >= 0)
            children[node(parent[node(k)])].push_back(k);
        else
            stack.push_back(k);
    }
    // Parents before children, then the other way round.
    while (!stack.empty()) {
        const int k = stack.back();
        stack.pop_back();
        visited.push_back(order_[node(k)]);
        for (const int child : children[node(k)]) stack.push_back(child);
    }
    order_.assign(visited.rbegin(), visited.rend());
    number();
}

/// Positions below the diagonal in each column of the factor, ascending.
inline std::vector<std::vector<int>> BlockLu::column_structures(int n,
                                                                std::vector<int>& parent) const {
    std::vector<std::vector<int>> below(node(n)), children(node(n));
    std::vector<int> mark(node(n), -1);
    parent.assign(node(n), -1);
    for (int k = 0; k < n; ++k) {
        auto& column = below[node(k)];
        mark[node(k)] = k;
        const auto take = [&](int j) {
            if (j <= k || mark[node(j)] == k) return;
            mark[node(j)] = k;
            column.push_back(j);
        };
        const std::size_t i = node(order_[node(k)]);
        for (int e = row_begin_[i]; e < row_begin_[i + 1]; ++e)
            take(position_[node(neighbour_[node(e)])]);
        for (const int child : children[node(k)])
            for (const int j : below[node(child)]) take(j);
        std::sort(column.begin(), column.end());
        if (column.empty()) continue;
        parent[node(k)] = column.front();
        children[node(column.front())].push_back(k);
    }
    return below;
}

/// Joins columns of (nearly) equal structure into fronts.
inline void BlockLu::make_fronts(const std::vector<std::vector<int>>& below,
                                 const std::vector<int>& parent) {
    struct Group {
        int first, last;
        double zeros;
    };
    const int n = static_cast<int>(below.size());
    std::vector<Group> groups;
    for (int k = 0; k < n; ++k) {
        Group g{k, k, 0.0};
        const double rest = static_cast<double>(below[node(k)].size());
        while (!groups.empty() && parent[node(groups.back().last)] == k) {
            const Group& child = groups.back();
            const double count = child.last - child.first + 1, own = g.last - g.first + 1;
            const double child_rest = static_cast<double>(below[node(child.last)].size());
            const double zeros = g.zeros + child.zeros + count * (own + rest - child_rest);
            const double total = (count + own) * (count + own + rest);
            const double scalars = (count + own) * width(k);
            // Few zeros, or so small a front that handling it costs more than they do.
            if (zeros > 0.0 && zeros > (scalars <= 24 ? 0.5 : scalars <= 96 ? 0.12 : 0.04) * total)
                break;
            g = {child.first, k, zeros};
            groups.pop_back();
        }
        groups.push_back(g);
    }
    fronts_.clear();
    update_.clear();
    std::vector<int> front_of(node(n), 0);
    std::ptrdiff_t factor = 0;
    int rows = 0;
    for (const Group& g : groups) {
        Front f{g.first, g.last, static_cast<int>(update_.size()), 0, 0, factor, rows, {}};
        for (int k = g.first; k <= g.last; ++k) {
            f.pivots += width(k);
            front_of[node(k)] = static_cast<int>(fronts_.size());
        }
        for (const int j : below[node(g.last)]) {
            update_.push_back(j);
            f.rest += width(j);
        }
        rows += f.pivots;
        factor += static_cast<std::ptrdiff_t>(f.pivots) * (f.pivots + 2 * f.rest);
        fronts_.push_back(std::move(f));
    }
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        const auto update = updates(fronts_[f]);
        if (!update.empty())
            fronts_[node(front_of[node(update.front())])].children.push_back(static_cast<int>(f));
    }
    factor_.resize(static_cast<std::size_t>(factor));
    exchange_.resize(node(rows));
    slots_.assign(neighbour_.size(), {});
    for (std::size_t i = 0; i + 1 < row_begin_.size(); ++i)
        for (int e = row_begin_[i]; e < row_begin_[i + 1]; ++e)
            slots_[node(e)].front =
                front_of[node(std::min(position_[i], position_[node(neighbour_[node(e)])]))];
}

/// Fixes where each block lies in memory and in its front, and the sizes of the work arrays.
inline void BlockLu::place_blocks() {
    std::ptrdiff_t values = 0;
    std::vector<int> local(position_.size(), 0);
    slots_begin_.assign(fronts_.size() + 1, 0);
    for (const Slot& s : slots_) ++slots_begin_[node(s.front) + 1];
    for (std::size_t f = 0; f < fronts_.size(); ++f) slots_begin_[f + 1] += slots_begin_[f];
    slots_of_front_.resize(slots_.size());
    auto next = slots_begin_;
    std::vector<int> row_of(slots_.size());
    for (std::size_t i = 0; i + 1 < row_begin_.size(); ++i)
        for (int e = row_begin_[i]; e < row_begin_[i + 1]; ++e) {
            Slot& s = slots_[node(e)];
            row_of[node(e)] = static_cast<int>(i);
            s.rows = offset_[i + 1] - offset_[i];
            const std::size_t j = node(neighbour_[node(e)]);
            s.columns = offset_[j + 1] - offset_[j];
            s.value = values;
            values += static_cast<std::ptrdiff_t>(s.rows) * s.columns;
            slots_of_front_[node(next[node(s.front)]++)] = e;
        }
    values_.assign(static_cast<std::size_t>(values), 0.0);
    std::size_t largest = 0, stack = 0, deepest = 0;
    const auto square = [](int rows) { return node(rows) * node(rows); };
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        const Front& front = fronts_[f];
        int row = 0;
        for (int k = front.first; k <= front.last; ++k) {
            local[node(k)] = row;
            row += width(k);
        }
        for (const int k : updates(front)) {
            local[node(k)] = row;
            row += width(k);
        }
        for (int k = slots_begin_[f]; k < slots_begin_[f + 1]; ++k) {
            const int e = slots_of_front_[node(k)];
            slots_[node(e)].row = local[node(position_[node(row_of[node(e)])])];
            slots_[node(e)].column = local[node(position_[node(neighbour_[node(e)])])];
        }
        largest = std::max(largest, square(row));
        for (const int child : front.children) stack -= square(fronts_[node(child)].rest);
        stack += square(front.rest);
        deepest = std::max(deepest, stack);
    }
    work_.resize(largest);
    stack_.resize(deepest);
    ordered_offset_.clear();
    int first = 0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        ordered_offset_.push_back(first);
        first += width(static_cast<int>(k));
    }
}

/// LU with row exchanges of the upper square of `a` (as many rows as columns count), in place;
/// recursive, so that nearly all work is in matrix products.
inline bool BlockLu::eliminate(Eigen::Ref<Dense> a, int* exchange) {
    const Eigen::Index n = a.cols();
    constexpr Eigen::Index small = 8;
    if (n <= small) {
        for (Eigen::Index k = 0; k < n; ++k) {
            Eigen::Index best = 0;
            const double pivot = a.col(k).tail(a.rows() - k).cwiseAbs().maxCoeff(&best);
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
    a.bottomRightCorner(rows, other).noalias() -= a.bottomLeftCorner(rows, half) * upper;
    if (!eliminate(a.bottomRightCorner(rows, other), exchange + half)) return false;
    for (Eigen::Index k = half; k < n; ++k) {
        exchange[k] += static_cast<int>(half);
        if (exchange[k] != k) a.row(k).head(half).swap(a.row(exchange[k]).head(half));
    }
    return true;
}

inline bool BlockLu::factorize() {
    std::size_t top = 0;
    std::vector<int>& local = local_;
    local.assign(position_.size(), 0);
    for (std::size_t index = 0; index < fronts_.size(); ++index) {
        const Front& f = fronts_[index];
        const int rows = f.pivots + f.rest;
        BlockMap a(work_.data(), rows, rows);
        a.setZero();
        for (int k = slots_begin_[index]; k < slots_begin_[index + 1]; ++k) {
            const Slot& s = slots_[node(slots_of_front_[node(k)])];
            a.block(s.row, s.column, s.rows, s.columns) =
                Eigen::Map<const Dense>(values_.data() + s.value, s.rows, s.columns);
        }
        int row = 0;
        for (int k = f.first; k <= f.last; ++k) {
            local[node(k)] = row;
            row += width(k);
        }
        for (const int k : updates(f)) {
            local[node(k)] = row;
            row += width(k);
        }
        for (std::size_t c = f.children.size(); c-- > 0;) {
            const Front& child = fronts_[node(f.children[c])];
            top -= node(child.rest) * node(child.rest);
            const double* from = stack_.data() + top;
            // Row of the front for each row of the child's part.
            scatter_.clear();
            for (const int k : updates(child))
                for (int d = 0; d < width(k); ++d) scatter_.push_back(local[node(k)] + d);
            for (const int column : scatter_) {
                double* to = work_.data() + static_cast<std::ptrdiff_t>(column) * rows;
                for (std::size_t i = 0; i < scatter_.size(); ++i) to[scatter_[i]] += from[i];
                from += child.rest;
            }
        }
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
        BlockMap s(stack_.data() + top, f.rest, f.rest);
        s = a.bottomRightCorner(f.rest, f.rest);
        s.noalias() -= lower * upper;
        top += node(f.rest) * node(f.rest);
    }
    return true;
}

inline void BlockLu::solve(Eigen::Ref<Eigen::VectorXd> x) const {
    TALUS_CHECK(x.size() == size(), "one number per row");
    gathered_.resize(node(size()) + work_.size());
    Eigen::Map<Eigen::VectorXd> y(gathered_.data(), size());
    const std::vector<int>& offset = ordered_offset_;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const int w = width(static_cast<int>(k));
        y.segment(offset[k], w) = x.segment(offset_[node(order_[k])], w);
    }
    double* const rest = gathered_.data() + size();
    const auto each = [&](const Front& f, auto&& visit) {
        int r = 0;
        for (const int k : updates(f)) {
            visit(r, offset[node(k)], width(k));
            r += width(k);
        }
    };
    for (const Front& f : fronts_) {
        const double* data = factor_.data() + f.factor;
        const Eigen::Map<const Dense> pivot(data, f.pivots, f.pivots);
        const Eigen::Map<const Dense> lower(data + f.pivots * f.pivots, f.rest, f.pivots);
        auto top = y.segment(offset[node(f.first)], f.pivots);
        for (int k = 0; k < f.pivots; ++k) std::swap(top[k], top[exchange_[node(f.row + k)]]);
        pivot.triangularView<Eigen::UnitLower>().solveInPlace(top);
        if (f.rest == 0) continue;
        Eigen::Map<Eigen::VectorXd> down(rest, f.rest);
        down.noalias() = lower * top;
        each(f, [&](int r, int to, int w) { y.segment(to, w) -= down.segment(r, w); });
    }
    for (std::size_t index = fronts_.size(); index-- > 0;) {
        const Front& f = fronts_[index];
        const double* data = factor_.data() + f.factor;
        const Eigen::Map<const Dense> pivot(data, f.pivots, f.pivots);
        const Eigen::Map<const Dense> upper(data + f.pivots * (f.pivots + f.rest), f.pivots,
                                            f.rest);
        auto top = y.segment(offset[node(f.first)], f.pivots);
        if (f.rest > 0) {
            Eigen::Map<Eigen::VectorXd> down(rest, f.rest);
            each(f, [&](int r, int from, int w) { down.segment(r, w) = y.segment(from, w); });
            top.noalias() -= upper * down;
        }
        pivot.triangularView<Eigen::Upper>().solveInPlace(top);
    }
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const int w = width(static_cast<int>(k));
        x.segment(offset_[node(order_[k])], w) = y.segment(offset[k], w);
    }
}

}  // namespace talus
