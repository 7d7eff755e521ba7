// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/feed/inlet.hpp>
#include <talus/sample/lattice.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

namespace lab {

/// Grains in a loose pack, at rest, which then falls: places of a lattice, layer by layer from the
/// height `low[Dim - 1]`, between the walls `low` and `high` across, as far as `inside(place)`
/// holds. No grain reaches farther from its place than `largest` [m]. Throws input_error if there
/// is no room for `count` below the height `high[Dim - 1]`.
template <int Dim, class System>
void scatter(System& system, const talus::ShapeSource<Dim>& shape, double largest,
             std::size_t count, const talus::Vector<Dim>& low, const talus::Vector<Dim>& high,
             std::uint64_t seed,
             const std::function<bool(const talus::Vector<Dim>&)>& inside = {}) {
    talus::Random random(seed), shapes(~seed);
    // Without a condition every place counts; with one there are more places than that.
    for (std::size_t wanted = count, first = 0;; first = wanted, wanted *= 2) {
        talus::Random again = random;
        const auto places = talus::jittered_lattice<Dim>(
            again, {.count = wanted, .box_size = high - low, .largest_radius = largest});
        for (std::size_t k = first; k < places.size(); ++k) {
            const talus::Vector<Dim> x = low + places[k];
            talus::require_in("height of the grains [m]", x[Dim - 1] + largest, low[Dim - 1],
                              high[Dim - 1]);
            if (inside && !inside(x)) continue;
            system.add(shape(shapes), 2600.0, {x, talus::random_rotation<Dim>(shapes)});
            if (--count == 0) return;
        }
    }
}

}  // namespace lab
