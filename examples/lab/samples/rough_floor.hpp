// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/sample/vessels.hpp>

#include <cstdint>

namespace lab {

/// A floor at height 0 with grains glued to it, up to `reach` [m] from the origin.
template <int Dim, class System, talus::RadiusLaw Law>
void add_rough_floor(System& system, const Law& radii, double reach, std::uint64_t seed) {
    talus::Random random(seed);
    for (const auto& wall : talus::rough_floor<Dim>(random, radii, reach))
        system.add_obstacle(wall.shape, wall.pose);
}

}  // namespace lab
