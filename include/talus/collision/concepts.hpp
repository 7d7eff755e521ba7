// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/geometry/aabb.hpp>

#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// Two bodies whose boxes overlap (touching included), a < b: they may touch.
struct CandidatePair {
    BodyIndex a = 0;
    BodyIndex b = 0;
    friend constexpr auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

/// The question that a broad phase is asked about each body: is it an obstacle? Two obstacles never
/// make a pair.
struct NoObstacles {
    constexpr bool operator()(BodyIndex) const noexcept { return false; }
};

/// Finds the candidate pairs of the placed boxes of all bodies, box k being that of body k: exactly
/// those with overlapping boxes of which not both are obstacles, sorted (by a, then b), replacing
/// what `pairs` held. Boxes may be unbounded; empty ones (low > high somewhere) overlap nothing.
/// Throws input_error, naming the body, if a side is NaN.
template <class B, int Dim>
concept BroadPhase = requires(B& broad_phase, std::span<const Aabb<Dim>> boxes,
                              NoObstacles is_obstacle, std::vector<CandidatePair>& pairs) {
    broad_phase.find_pairs(boxes, is_obstacle, pairs);
};

/// Whether `box` encloses nothing.
template <int Dim>
bool is_empty(const Aabb<Dim>& box) {
    return (box.low.array() > box.high.array()).any();
}

/// Throws input_error naming the first body with a NaN in its box.
template <int Dim>
void require_no_nan(std::span<const Aabb<Dim>> boxes) {
    for (std::size_t k = 0; k < boxes.size(); ++k)
        if (boxes[k].low.hasNaN() || boxes[k].high.hasNaN())
            throw input_error(detail::numbered("bounding box of body", k,
                                               " is NaN, but must be numbers or infinite"));
}

}  // namespace talus
