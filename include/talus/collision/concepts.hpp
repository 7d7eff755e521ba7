// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/geometry/aabb.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

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
/// Throws input_error, naming the body, if a side is NaN. Each pair comes once, the smaller index
/// first: what is otherwise, or of two obstacles, ContactDetection refuses by name
/// (require_candidates). A pair left out, or one of boxes far apart, it cannot see.
template <class B, int Dim>
concept BroadPhase = requires(B& broad_phase, std::span<const Aabb<Dim>> boxes,
                              NoObstacles is_obstacle, Column<CandidatePair>& pairs) {
    broad_phase.find_pairs(boxes, is_obstacle, pairs);
};

/// Whether `box` encloses nothing.
template <int Dim>
bool is_empty(const Aabb<Dim>& box) {
    bool empty = false;
    for (int k = 0; k < Dim; ++k) empty = empty || box.low[k] > box.high[k];
    return empty;
}

/// Throws input_error naming the first body with a NaN in its box.
template <int Dim>
void require_no_nan(std::span<const Aabb<Dim>> boxes) {
    for (std::size_t k = 0; k < boxes.size(); ++k)
        if (boxes[k].low.hasNaN() || boxes[k].high.hasNaN())
            throw input_error(detail::numbered("bounding box of body", k,
                                               " is NaN, but must be numbers or infinite"));
}

namespace detail {

[[noreturn, gnu::cold]] inline void reject_candidate(std::span<const CandidatePair> pairs,
                                                     std::size_t k, std::size_t body_count) {
    const auto [a, b] = pairs[k];
    const auto count = static_cast<BodyIndex>(body_count);
    const bool bodies = std::min(a, b) >= 0 && std::max(a, b) < count && a != b;
    const char* const must = !bodies                               ? "two different bodies"
                             : a > b                               ? "the smaller index first"
                             : k > 0 && !(pairs[k - 1] < pairs[k]) ? "sorted, each pair once"
                                                                   : "not both obstacles";
    throw input_error(
        joined({numbered("pair", k, " of the broad phase is ("), digits_of(a), ", ", digits_of(b),
                numbered("), but must be of the bodies from 0 below", body_count, ", "), must}));
}

}  // namespace detail

/// Throws input_error naming the first pair that is none of BroadPhase: not of two different
/// bodies, of which there are as many as `is_free`, the smaller index first; not sorted, or there
/// twice; or of two obstacles. O(pairs).
inline void require_candidates(std::span<const CandidatePair> pairs,
                               std::span<const bool> is_free) {
    std::uint64_t last = 0;  // below every pair of two bodies
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto a = static_cast<std::uint32_t>(pairs[k].a);  // far too large if negative
        const auto b = static_cast<std::uint32_t>(pairs[k].b);
        const std::uint64_t key = std::uint64_t{a} << 32 | b;
        if (!(a < b && b < is_free.size() && last < key && (is_free[a] || is_free[b])))
            detail::reject_candidate(pairs, k, is_free.size());
        last = key;
    }
}

}  // namespace talus
