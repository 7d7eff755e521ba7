// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// What the elimination of the nodes of a graph, one after the other, leads to [Liu1990]: a node's
/// *parent* is the first one that its elimination changes. A *position* is a place in the order.
struct EliminationTree {
    std::vector<int> parent;      ///< position of the parent of each position; -1 for roots
    std::vector<int> own, below;  ///< rows of each position, and of those it changes
    double operations = 0.0;      ///< multiplications of an LU factorisation

    /// Positions such that the children of each, and all under them, come just before it.
    std::vector<int> postorder() const;
};

/// For the graph given by rows (`row_begin`, `neighbour`, loops allowed), its nodes of `node_size`
/// rows eliminated in `order`, a permutation. Takes as long as the factor has blocks.
inline EliminationTree elimination_tree(std::span<const int> row_begin,
                                        std::span<const int> neighbour,
                                        std::span<const int> node_size,
                                        std::span<const int> order) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    const int n = static_cast<int>(order.size());
    EliminationTree tree;
    tree.parent.assign(at(n), -1);
    tree.own.assign(at(n), 0);
    tree.below.assign(at(n), 0);
    std::vector<int> position(at(n), 0), reached(at(n), -1);
    for (int k = 0; k < n; ++k) position[at(order[at(k)])] = k;
    for (int k = 0; k < n; ++k) {
        const std::size_t i = at(order[at(k)]);
        tree.own[at(k)] = node_size[i];
        // Row k of the factor: from each neighbour up the tree as far as it is built.
        reached[at(k)] = k;
        for (int e = row_begin[i]; e < row_begin[i + 1]; ++e)
            for (int j = position[at(neighbour[at(e)])]; j < k && reached[at(j)] != k;
                 j = tree.parent[at(j)]) {
                reached[at(j)] = k;
                tree.below[at(j)] += node_size[i];
                if (tree.parent[at(j)] < 0) tree.parent[at(j)] = k;
            }
    }
    // p pivots with r rows below: a dense LU of p x p, two triangular solves and a product.
    for (std::size_t k = 0; k < at(n); ++k) {
        const double p = tree.own[k], r = tree.below[k];
        tree.operations += p * (p * p / 3.0 + r * (p + r));
    }
    return tree;
}

inline std::vector<int> EliminationTree::postorder() const {
    // Without recursion: chains of a thousand nodes are usual.
    std::vector<std::vector<int>> children(parent.size());
    std::vector<int> stack, visited;
    for (std::size_t k = 0; k < parent.size(); ++k)
        (parent[k] >= 0 ? children[static_cast<std::size_t>(parent[k])] : stack)
            .push_back(static_cast<int>(k));
    // Parents before children, then the other way round.
    while (!stack.empty()) {
        const int k = stack.back();
        stack.pop_back();
        visited.push_back(k);
        for (const int child : children[static_cast<std::size_t>(k)]) stack.push_back(child);
    }
    return {visited.rbegin(), visited.rend()};
}

}  // namespace talus
