// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "harness/case.hpp"

namespace validation {

/// Balls of radius 4 to 6 mm in a box open at the top, let fall from a loose jittered lattice:
/// `across` per horizontal axis. Bodies 0 .. walls - 1 are floor and walls.
template <int Dim>
struct Deposit {
    int count;
    int across;

    static constexpr double low = 0.004, high = 0.006, mean = 0.005;
    static constexpr double pitch = 2.2 * high, density = 2600.0;
    static constexpr std::size_t walls = 2 * (Dim - 1) + 1;

    double width() const { return pitch * across; }
    World<Dim> make(Trial<Dim>& trial, const WorldParams<Dim>& params,
                    std::uint64_t realisation) const {
        auto world = trial.world(params);
        world.add_floor();
        for (int axis = 0; axis < Dim - 1; ++axis) {
            world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(axis));
            world.add_plane(width() * V<Dim>::Unit(axis), -V<Dim>::Unit(axis));
        }
        auto rng = trial.rng(realisation);
        std::uniform_real_distribution<double> radius(low, high), jitter(-0.04 * mean, 0.04 * mean);
        const int per_layer = Dim == 2 ? across : across * across;
        for (int k = 0; k < count; ++k) {
            V<Dim> x;
            x[0] = (k % across + 0.5) * pitch;
            x[1] = (k / across % across + 0.5) * pitch;
            x[Dim - 1] = (k / per_layer + 0.5) * pitch;
            for (int d = 0; d < Dim; ++d) x[d] += jitter(rng);
            const double r = radius(rng);
            const double volume = Dim == 2 ? pi * r * r : 4.0 / 3 * pi * r * r * r;
            world.add(talus::Ball<Dim>{r}, round_inertia<Dim>(density * volume, r), {x, {}});
        }
        return world;
    }
};

}  // namespace validation
