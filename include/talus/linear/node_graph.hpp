// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// An undirected graph with weights on nodes and edges, by rows: what orderings work on.
/// Each edge is in the rows of both its ends; no loops.
struct NodeGraph {
    std::vector<int> row_begin{0};  ///< of each node in `neighbour`, and the end
    std::vector<int> neighbour, edge_weight;
    std::vector<int> node_weight;  ///< positive

    int node_count() const { return static_cast<int>(node_weight.size()); }
    int row(int i) const { return row_begin[static_cast<std::size_t>(i)]; }
    int degree(int i) const { return row(i + 1) - row(i); }
    std::span<const int> neighbours(int i) const {
        return std::span(neighbour).subspan(static_cast<std::size_t>(row(i)),
                                            static_cast<std::size_t>(degree(i)));
    }
    std::span<const int> edge_weights(int i) const {
        return std::span(edge_weight)
            .subspan(static_cast<std::size_t>(row(i)), static_cast<std::size_t>(degree(i)));
    }
    int weight(int i) const { return node_weight[static_cast<std::size_t>(i)]; }
    std::int64_t total_weight() const {
        return std::accumulate(node_weight.begin(), node_weight.end(), std::int64_t{0});
    }
    /// Ends the row of one more node, whose neighbours were appended.
    void close_row(int weight) {
        node_weight.push_back(weight);
        row_begin.push_back(static_cast<int>(neighbour.size()));
    }
};

/// The graph on some nodes, ascending or not, and the edges among them. `place` has an entry per
/// node of the whole graph, all -1 before and after.
inline NodeGraph subgraph(const NodeGraph& whole, std::span<const int> nodes,
                          std::vector<int>& place) {
    NodeGraph part;
    part.row_begin.reserve(nodes.size() + 1);
    part.node_weight.reserve(nodes.size());
    // Edges to nodes elsewhere are left out.
    for (std::size_t k = 0; k < nodes.size(); ++k)
        place[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
    for (const int i : nodes) {
        const auto adjacent = whole.neighbours(i), weight = whole.edge_weights(i);
        for (std::size_t e = 0; e < adjacent.size(); ++e)
            if (const int j = place[static_cast<std::size_t>(adjacent[e])]; j >= 0) {
                part.neighbour.push_back(j);
                part.edge_weight.push_back(weight[e]);
            }
        part.close_row(whole.weight(i));
    }
    for (const int i : nodes) place[static_cast<std::size_t>(i)] = -1;
    return part;
}

/// A permutation of 0 to n - 1 without pattern, the same whenever asked for.
inline std::vector<int> scattered_order(int n, std::uint64_t seed) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    std::uint64_t state = seed;
    for (std::size_t k = order.size(); k > 1; --k) {
        // Knuth's linear congruences; the high bits are the good ones.
        state = state * 6364136223846793005u + 1442695040888963407u;
        std::swap(order[k - 1], order[static_cast<std::size_t>((state >> 33) % k)]);
    }
    return order;
}

/// A coarser graph: nodes joined in pairs by heavy edges [KarypisKumar1998], those left alone with
/// another one that hangs on the same neighbour.
struct CoarseGraph {
    NodeGraph graph;
    std::vector<int> coarse;  ///< node of `graph` that each node went into
};

/// Joins no nodes to more than `heaviest`. `seed` is for the order of visits.
inline CoarseGraph coarsened(const NodeGraph& fine, std::int64_t heaviest, std::uint64_t seed) {
    const int n = fine.node_count();
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    // `alone[h]`: a node without a mate whose heaviest neighbour is h.
    std::vector<int> mate(at(n), -1), alone(at(n), -1);
    const auto join = [&](int i, int j) {
        mate[at(i)] = j;
        mate[at(j)] = i;
    };
    // Nodes of few neighbours first: they have the least choice.
    std::vector<int> order = scattered_order(n, seed);
    std::vector<int> start(65, 0), visits(at(n));
    const auto key = [&](int i) { return at(std::min(fine.degree(i), 63)); };
    for (const int i : order) ++start[key(i) + 1];
    for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
    for (const int i : order) visits[at(start[key(i)]++)] = i;

    int lonely = -1;  // without neighbours, unpaired
    for (const int i : visits) {
        if (mate[at(i)] >= 0) continue;
        const auto adjacent = fine.neighbours(i), weight = fine.edge_weights(i);
        // The free neighbour of the heaviest edge, so that what is hidden in coarse nodes is what a
        // separator would not cut.
        int best = -1, heavy = 0, hub = -1, hub_weight = 0;
        for (std::size_t e = 0; e < adjacent.size(); ++e) {
            const int j = adjacent[e];
            if (weight[e] > hub_weight) {
                hub = j;
                hub_weight = weight[e];
            }
            if (mate[at(j)] >= 0 || fine.weight(i) + fine.weight(j) > heaviest) continue;
            if (weight[e] > heavy) {
                best = j;
                heavy = weight[e];
            }
        }
        if (best >= 0) {
            join(i, best);
            continue;
        }
        // Leaves of a star: their hub takes one of them only, and without this the graph would
        // hardly shrink.
        int& waiting = hub >= 0 ? alone[at(hub)] : lonely;
        if (waiting >= 0 && mate[at(waiting)] < 0 &&
            fine.weight(i) + fine.weight(waiting) <= heaviest) {
            join(i, waiting);
            waiting = -1;
        } else {
            waiting = i;
        }
    }
    CoarseGraph result;
    result.coarse.assign(at(n), -1);
    std::vector<int> first;  // of the nodes joined
    for (int i = 0; i < n; ++i) {
        if (result.coarse[at(i)] >= 0) continue;
        result.coarse[at(i)] = static_cast<int>(first.size());
        if (mate[at(i)] >= 0) result.coarse[at(mate[at(i)])] = static_cast<int>(first.size());
        first.push_back(i);
    }
    NodeGraph& coarse = result.graph;
    coarse.row_begin.reserve(first.size() + 1);
    coarse.node_weight.reserve(first.size());
    coarse.neighbour.reserve(fine.neighbour.size());
    coarse.edge_weight.reserve(fine.neighbour.size());
    // Edges between the same coarse nodes add up; `entry` finds the one there is, and is never
    // reset, as entries of earlier rows are before `begin`.
    std::vector<int> entry(first.size(), -1);
    for (std::size_t k = 0; k < first.size(); ++k) {
        const int begin = static_cast<int>(coarse.neighbour.size());
        const auto take = [&](int i) {
            const auto adjacent = fine.neighbours(i), weight = fine.edge_weights(i);
            for (std::size_t e = 0; e < adjacent.size(); ++e) {
                const int j = result.coarse[at(adjacent[e])];
                if (at(j) == k) continue;
                int& seen = entry[at(j)];
                if (seen >= begin) {
                    coarse.edge_weight[at(seen)] += weight[e];
                } else {
                    seen = static_cast<int>(coarse.neighbour.size());
                    coarse.neighbour.push_back(j);
                    coarse.edge_weight.push_back(weight[e]);
                }
            }
        };
        const int i = first[k], j = mate[at(i)];
        take(i);
        if (j >= 0) take(j);
        coarse.close_row(fine.weight(i) + (j >= 0 ? fine.weight(j) : 0));
    }
    return result;
}

}  // namespace talus
