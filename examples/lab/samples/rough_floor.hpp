// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random.hpp>

#include <cstdint>

namespace lab {

/// A floor at height 0 with grains glued to it, up to `reach` [m] from the origin: balls on a
/// lattice of 1.1 mean diameters, shaken by a third of it, half sunk in a plane below. Up is the
/// last axis.
template <int Dim, class System, talus::RadiusLaw Law>
void add_rough_floor(System& system, const Law& radii, double reach, std::uint64_t seed) {
    using V = talus::Vector<Dim>;
    talus::Random random(seed);
    system.add_obstacle(talus::HalfSpace<Dim>(V::Unit(Dim - 1), -radii.mean()));
    const double pitch = 2.2 * radii.mean();
    const int side = static_cast<int>(reach / pitch), across = Dim == 2 ? 0 : side;
    for (int i = -side; i <= side; ++i)
        for (int j = -across; j <= across; ++j) {
            V x = V::Zero();
            x[0] = pitch * (i + random.uniform(-0.3, 0.3));
            if (Dim == 3) x[1] = pitch * (j + random.uniform(-0.3, 0.3));
            x[Dim - 1] = -0.5 * radii.mean();
            if (x.norm() < reach) system.add_obstacle(talus::Ball<Dim>(radii(random)), {{x, {}}});
        }
}

}  // namespace lab
