// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/brute_force.hpp>
#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/column.hpp>

#include <span>
#include <vector>

namespace collision_concepts {

/// The least a broad phase may be.
struct BroadPhaseArchetype {
    void find_pairs(std::span<const talus::Aabb<3>>, talus::NoObstacles,
                    talus::Column<talus::CandidatePair>&) {}
};
/// Does not ask who is an obstacle.
struct BlindToObstacles {
    void find_pairs(std::span<const talus::Aabb<3>>, talus::Column<talus::CandidatePair>&) {}
};
/// Would return pairs anew in each step.
struct ReturnsPairs {
    talus::Column<talus::CandidatePair> find_pairs(std::span<const talus::Aabb<3>>) { return {}; }
};

static_assert(talus::BroadPhase<BroadPhaseArchetype, 3>);
static_assert(!talus::BroadPhase<BroadPhaseArchetype, 2>);
static_assert(!talus::BroadPhase<BlindToObstacles, 3>);
static_assert(!talus::BroadPhase<ReturnsPairs, 3>);
static_assert(talus::BroadPhase<talus::BruteForce<2>, 2>);
static_assert(talus::BroadPhase<talus::HierarchicalGrid<3>, 3>);
static_assert(!talus::BroadPhase<talus::HierarchicalGrid<3>, 2>);

}  // namespace collision_concepts
