// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace talus {

/// Which bodies a body can touch: each of two must be a member of a group that the other one meets.
/// The default meets all.
struct CollisionGroups {
    std::uint32_t member = 1;   ///< one bit for each group it is in
    std::uint32_t meets = ~0u;  ///< one bit for each group it can touch

    friend constexpr bool operator==(const CollisionGroups&, const CollisionGroups&) = default;
};

/// Whether bodies of these groups can touch each other.
constexpr bool may_meet(const CollisionGroups& a, const CollisionGroups& b) {
    return (a.member & b.meets) != 0 && (b.member & a.meets) != 0;
}

/// Pairs of bodies that do not touch each other, such as neighbours of a chain.
class IgnoredPairs {
  public:
    /// O(pairs), as is `erase_if`. Throws input_error for what is the name of no body, and for a
    /// body with itself.
    void insert(BodyId a, BodyId b) {
        for (const BodyId id : {a, b})
            if (id.serial < 0)
                detail::reject("body id", static_cast<double>(id.serial), "that of a body");
        if (a == b)
            detail::reject("second body id of an ignored pair", static_cast<double>(b.serial),
                           "that of another body");
        const Pair pair = ordered(a, b);
        const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
        if (at == pairs_.end() || *at != pair) pairs_.insert(at, pair);
    }
    void erase(BodyId a, BodyId b) {
        const Pair pair = ordered(a, b);
        pairs_.erase_if([&](const Pair& one) { return one == pair; });
    }
    /// Forgets the pairs of bodies for which `gone(id)` holds.
    template <class Gone>
    void erase_if(Gone&& gone) {
        pairs_.erase_if([&](const Pair& p) { return gone(p.first) || gone(p.second); });
    }
    /// O(log pairs).
    bool contains(BodyId a, BodyId b) const {
        return std::binary_search(pairs_.begin(), pairs_.end(), ordered(a, b));
    }
    bool empty() const { return pairs_.empty(); }
    /// Ascending, the smaller id first in each.
    std::span<const std::pair<BodyId, BodyId>> pairs() const { return pairs_; }

  private:
    using Pair = std::pair<BodyId, BodyId>;
    static Pair ordered(BodyId a, BodyId b) { return {std::min(a, b), std::max(a, b)}; }

    Column<Pair> pairs_;
};

}  // namespace talus
