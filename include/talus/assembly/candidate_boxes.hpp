// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/concepts.hpp>
#include <talus/core/column.hpp>
#include <talus/dynamics/bodies.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// The widened boxes that candidates were found with, and where the bodies were then.
template <int Dim>
requires SpaceDimension<Dim>
struct CandidateBoxes {
    Column<Aabb<Dim>> box;
    Column<Vector<Dim>> position;
    Column<Rotation<Dim>> rotation;
    Column<double> room;  ///< widening of each box [m]
    Column<bool> free;    ///< no obstacle; two obstacles are no pair

    /// Whether some body may have left its box since: by its motion, with the `reach` that it needs
    /// now. Such candidates are no longer all.
    bool left(const Bodies<Dim>& bodies, std::span<const double> radius,
              std::span<const double> reach) const {
        if (box.size() != reach.size()) return true;
        for (std::size_t i = 0; i < reach.size(); ++i) {
            if (free[i] == bodies.is_obstacle(i)) return true;
            const double turn = bodies.rotation[i].distance(rotation[i]);
            const double way =
                (bodies.position[i] - position[i]).norm() + (turn > 0.0 ? turn * radius[i] : 0.0);
            if (!(way + reach[i] <= room[i])) return true;
        }
        return false;
    }
};

/// A broad phase of which the type is forgotten. Lives no longer than that.
template <int Dim>
requires SpaceDimension<Dim>
struct PairSearch {
    void* broad;
    void (*find)(void* broad, std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free,
                 Column<CandidatePair>& pairs);

    template <BroadPhase<Dim> Broad>
    explicit PairSearch(Broad& search)
        : broad(&search),
          find([](void* by, std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free,
                  Column<CandidatePair>& pairs) {
              static_cast<Broad*>(by)->find_pairs(
                  boxes, [&](BodyIndex i) { return !is_free[static_cast<std::size_t>(i)]; }, pairs);
              require_candidates(pairs, is_free);
          }) {}

    /// Replaces `pairs` by those of boxes that overlap, of which one at least is free. Throws
    /// input_error naming one that is no pair.
    void operator()(std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free,
                    Column<CandidatePair>& pairs) const {
        find(broad, boxes, is_free, pairs);
    }
};

}  // namespace talus
