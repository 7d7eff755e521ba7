// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/concepts.hpp>
#include <talus/core/column.hpp>
#include <talus/core/model.hpp>

#include <concepts>

namespace talus {

/// Broad phase that looks at every pair: O(n^2). The oracle of the others, and the fastest below
/// some ten bodies.
template <int Dim>
requires SpaceDimension<Dim>
class BruteForce {
  public:
    template <std::predicate<BodyIndex> IsObstacle>
    void find_pairs(std::span<const Aabb<Dim>> boxes, const IsObstacle& is_obstacle,
                    Column<CandidatePair>& pairs) const {
        require_no_nan(boxes);
        pairs.clear();
        const auto n = static_cast<BodyIndex>(boxes.size());
        for (BodyIndex a = 0; a < n; ++a) {
            const Aabb<Dim>& box = boxes[static_cast<std::size_t>(a)];
            if (is_empty(box)) continue;
            const bool obstacle = is_obstacle(a);
            for (BodyIndex b = a + 1; b < n; ++b) {
                const Aabb<Dim>& other = boxes[static_cast<std::size_t>(b)];
                if (box.overlaps(other) && !is_empty(other) && !(obstacle && is_obstacle(b)))
                    pairs.push_back({a, b});
            }
        }
    }
};
TALUS_MODEL(BroadPhase<BruteForce<2>, 2>);
TALUS_MODEL(BroadPhase<BruteForce<3>, 3>);

}  // namespace talus
