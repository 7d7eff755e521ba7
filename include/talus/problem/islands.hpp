// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

namespace talus {

/// Parts of a problem that have nothing to do with each other: sets of items that grow together
/// where two of them are joined. O(items) in all but name [Tarjan1975].
class Islands {
  public:
    /// `count` items, each alone. Allocates only for more items than ever before.
    void reset(std::size_t count) {
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    [[gnu::noinline]] void join(std::size_t a, std::size_t b) {
        const std::uint32_t x = root(a), y = root(b);
        // The smaller index is the root, whatever the order of the joins.
        if (x < y)
            parent_[y] = x;
        else
            parent_[x] = y;
    }
    /// The least item of the island of item i.
    std::uint32_t root(std::size_t i) {
        auto x = static_cast<std::uint32_t>(i);
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }

  private:
    Column<std::uint32_t> parent_;
};

}  // namespace talus
