// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/instantiate.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#if TALUS_BODIES
#include <talus/linear/elimination_tree.hpp>
#include <talus/linear/nested_dissection.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#endif

namespace talus {

/// What a multifrontal factorisation [DuffReid1983] needs to know of a pattern of blocks, before
/// any values: the order of the nodes, the fronts, and where each block lies in memory and in its
/// front.
///
/// A *node* is a row and column of blocks, its *position* the place in the order. A front
/// eliminates the positions `first` to `last` and updates those of `updates(front)`.
class FrontalPlan {
  public:
    /// How nodes are ordered.
    enum class Ordering {
        better,             ///< minimum degree or, where it is worth trying, nested dissection
        minimum_degree,     ///< approximately [AmestoyDavisDuff1996]; fast
        nested_dissection,  ///< [George1973]; less fill in large packings in space
    };
    struct Slot {
        std::ptrdiff_t value;  ///< first number of the block
        int rows, columns;
        int front;
        int row, column;  ///< where it goes in the front
    };
    struct Front {
        int first, last;        ///< pivots, as positions
        int update_begin;       ///< in the list that `updates` reads
        int pivots, rest;       ///< rows of the pivot block, and of the others
        std::ptrdiff_t factor;  ///< first number of the factors: pivot block, L below it, U beside
        int row;                ///< first of its pivot rows, counted over all fronts
        std::vector<int> children;
    };

    /// For nodes of the given sizes; `edges` are the off-diagonal blocks, each in one direction or
    /// both, repeated or not.
    void analyze(std::span<const int> node_size, std::span<const std::pair<int, int>> edges,
                 Ordering ordering = Ordering::better);

    int size() const { return offset_.empty() ? 0 : offset_.back(); }  ///< rows
    int node_count() const { return static_cast<int>(order_.size()); }
    /// Multiplications of one factorisation.
    double operations() const {
        double sum = 0.0;
        for (const Front& f : fronts_) {
            const double p = f.pivots, r = f.rest;
            sum += p * (p * p / 3.0 + r * (p + r));
        }
        return sum;
    }
    /// Number of block (i, j), which must be on the diagonal or among the edges.
    int slot(int i, int j) const {
        const auto begin = neighbour_.begin() + row_begin_[node(i)];
        const auto end = neighbour_.begin() + row_begin_[node(i) + 1];
        const auto found = std::lower_bound(begin, end, j);
        TALUS_CHECK(found != end && *found == j, "the block must be in the pattern");
        return static_cast<int>(found - neighbour_.begin());
    }
    const Slot& slot(int index) const { return slots_[node(index)]; }
    /// The fronts, children come just before their parent.
    std::span<const Front> fronts() const { return fronts_; }
    /// Slots whose values enter at a front.
    std::span<const int> slots_of(std::size_t front) const {
        return std::span(slots_of_front_)
            .subspan(node(slots_begin_[front]),
                     node(slots_begin_[front + 1] - slots_begin_[front]));
    }
    /// Positions that a front updates, ascending.
    std::span<const int> updates(const Front& f) const {
        const std::size_t front = static_cast<std::size_t>(&f - fronts_.data());
        const int end = front + 1 < fronts_.size() ? fronts_[front + 1].update_begin
                                                   : static_cast<int>(update_.size());
        return std::span(update_).subspan(node(f.update_begin), node(end - f.update_begin));
    }
    /// Rows of the node at a position.
    int width(int position) const {
        const int i = order_[node(position)];
        return offset_[node(i) + 1] - offset_[node(i)];
    }
    int given_row(int position) const { return offset_[node(order_[node(position)])]; }
    int ordered_row(int position) const { return ordered_offset_[node(position)]; }

    std::size_t value_count() const { return value_count_; }      ///< numbers in all blocks
    std::size_t factor_size() const { return factor_size_; }      ///< numbers in the factors
    std::size_t pivot_rows() const { return pivot_rows_; }        ///< of all fronts
    std::size_t largest_front() const { return largest_front_; }  ///< numbers in a front
    /// Numbers in all updates that wait for their parent at one time.
    std::size_t deepest_stack() const { return deepest_stack_; }

  private:
    static std::size_t node(int i) { return static_cast<std::size_t>(i); }
    std::vector<int> minimum_degree_order(int n) const;
    void order_nodes(std::span<const int> node_size, Ordering ordering);
    std::vector<std::vector<int>> column_structures(int n, std::vector<int>& parent) const;
    void make_fronts(const std::vector<std::vector<int>>& below, const std::vector<int>& parent);
    void place_blocks();

    std::vector<int> ordered_offset_;    ///< first row of each position
    std::vector<int> offset_;            ///< first row of each node
    std::vector<int> row_begin_;         ///< of each node in neighbour_
    std::vector<int> neighbour_;         ///< of each node, ascending, itself included
    std::vector<int> order_, position_;  ///< node at each position, and back
    std::vector<Slot> slots_;            ///< one per entry of neighbour_
    std::vector<int> slots_of_front_, slots_begin_;
    std::vector<Front> fronts_;
    std::vector<int> update_;  ///< positions
    std::size_t value_count_ = 0, factor_size_ = 0, pivot_rows_ = 0;
    std::size_t largest_front_ = 0, deepest_stack_ = 0;
};

#if TALUS_BODIES

TALUS_FUNCTION void FrontalPlan::analyze(std::span<const int> node_size,
                                         std::span<const std::pair<int, int>> edges,
                                         Ordering ordering) {
    // The pattern, symmetric and with its diagonal, sorted by rows.
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
    order_nodes(node_size, ordering);
    std::vector<int> parent;
    const auto below = column_structures(n, parent);
    make_fronts(below, parent);
    place_blocks();
}

/// Minimum degree on the graph of nodes.
TALUS_FUNCTION std::vector<int> FrontalPlan::minimum_degree_order(int n) const {
    // On nodes, not rows: a node's rows have the same structure, and the graph is 2 to 6 times
    // smaller. Sizes are nearly equal, so that leaving them out costs little.
    Eigen::SparseMatrix<double> pattern(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i)
        for (int k = row_begin_[node(i)]; k < row_begin_[node(i) + 1]; ++k)
            entries.emplace_back(i, neighbour_[node(k)], 1.0);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    return {permutation.indices().data(), permutation.indices().data() + n};
}

/// The order asked for, then a postorder of the elimination tree, so that the children of a front
/// come just before it.
TALUS_FUNCTION void FrontalPlan::order_nodes(std::span<const int> node_size, Ordering ordering) {
    const int n = static_cast<int>(node_size.size());
    std::vector<int> order;
    EliminationTree tree;
    const auto keep_better = [&](std::vector<int> other) {
        EliminationTree grown = elimination_tree(row_begin_, neighbour_, node_size, other);
        if (!order.empty() && tree.operations <= grown.operations) return;
        order = std::move(other);
        tree = std::move(grown);
    };
    if (ordering != Ordering::nested_dissection) keep_better(minimum_degree_order(n));
    // An attempt at nested dissection takes some 2 us per edge, the time of 2e4 operations.
    // Measured in space, it saves 60 % of 8e6 operations per edge (2e4 bodies), 30 to 40 % of 1e6
    // (4e3 bodies), hardly any of 1e5 (1e3 bodies); in the plane, with 1e4 operations per edge,
    // nothing worth its time. So attempts get a tenth of what the factorisation takes, four at
    // most.
    NestedDissectionParams params;
    const double per_edge = tree.operations / static_cast<double>(neighbour_.size() / 2 + 1);
    if (ordering == Ordering::better)
        params.attempts = static_cast<int>(std::min(per_edge / 2e5 + 0.5, 4.0));
    if (ordering != Ordering::minimum_degree && params.attempts > 0)
        keep_better(nested_dissection(row_begin_, neighbour_, node_size, params));
    order_.clear();
    for (const int k : tree.postorder()) order_.push_back(order[node(k)]);
    position_.assign(node(n), 0);
    for (int k = 0; k < n; ++k) position_[node(order_[node(k)])] = k;
}

/// Positions below the diagonal in each column of the factor, ascending.
TALUS_FUNCTION std::vector<std::vector<int>> FrontalPlan::column_structures(
    int n, std::vector<int>& parent) const {
    // The structure of a column is that of the matrix and of its children in the tree, without
    // the column itself [Liu1990]: the union is taken with a mark per position.
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
TALUS_FUNCTION void FrontalPlan::make_fronts(const std::vector<std::vector<int>>& below,
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
            // The child's columns get the rows of the parent that they lack: numbers that are zero.
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
    // Fronts and their updates, one after the other in memory.
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
        // The parent is the front of the first position that a front changes.
        const auto update = updates(fronts_[f]);
        if (!update.empty())
            fronts_[node(front_of[node(update.front())])].children.push_back(static_cast<int>(f));
    }
    factor_size_ = static_cast<std::size_t>(factor);
    pivot_rows_ = node(rows);
    // A block enters at the front that eliminates the earlier one of its two positions.
    slots_.assign(neighbour_.size(), {});
    for (std::size_t i = 0; i + 1 < row_begin_.size(); ++i)
        for (int e = row_begin_[i]; e < row_begin_[i + 1]; ++e)
            slots_[node(e)].front =
                front_of[node(std::min(position_[i], position_[node(neighbour_[node(e)])]))];
}

/// Fixes where each block lies in memory and in its front, and the sizes of the work arrays.
TALUS_FUNCTION void FrontalPlan::place_blocks() {
    std::ptrdiff_t values = 0;
    // Slots sorted by front, by counting; and, front by front, where each lies in it.
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
    value_count_ = static_cast<std::size_t>(values);
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
        // As factorize will push and pop them.
        for (const int child : front.children) stack -= square(fronts_[node(child)].rest);
        stack += square(front.rest);
        deepest = std::max(deepest, stack);
    }
    largest_front_ = largest;
    deepest_stack_ = deepest;
    ordered_offset_.clear();
    int first = 0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
        ordered_offset_.push_back(first);
        first += width(static_cast<int>(k));
    }
}

#endif

}  // namespace talus
