// SPDX-License-Identifier: BSL-1.0
// Small heaps of balls in a box, for tests of whole runs.
#pragma once

#include <cstring>
#include <vector>

#include "common/random.hpp"
#include "experiment.hpp"

namespace experiment {

/// State of all bodies, number by number.
template <int Dim>
std::vector<double> everything(const talus::Bodies<Dim>& bodies) {
    std::vector<double> all;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        for (const double x : bodies.position[i]) all.push_back(x);
        const talus::Matrix<Dim> axes = bodies.rotation[i].matrix();
        for (int k = 0; k < Dim * Dim; ++k) all.push_back(axes.data()[k]);
        for (const double x : bodies.velocity[i]) all.push_back(x);
        for (const double x : bodies.spin[i]) all.push_back(x);
    }
    return all;
}
inline bool equal_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), 8 * a.size()) == 0;
}

/// With correction of positions.
template <int Dim>
struct Corrected : talus::SimulationTypes<Dim> {
    using GapCorrection = talus::GapCorrection<Dim>;
};

/// Balls of radius 0.04 to 0.06 on a loose jittered lattice, `wide` per horizontal axis and `high`
/// layers, in a box with friction everywhere. The box is made of half-spaces.
template <int Dim, class Types = talus::SimulationTypes<Dim>>
talus::Simulation<Dim, Types> heap(int wide, int high, const talus::DefaultLaw<Dim>& contact_law,
                                   double h, talus::SimulationParams params = {},
                                   double size = 1.0) {
    params.h = h;
    talus::Simulation<Dim, Types> sim(contact_law, params);
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    const double pitch = 0.13, width = pitch * wide;
    system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    for (int axis = 0; axis < Dim - 1; ++axis) {
        system.add_obstacle(talus::HalfSpace<Dim>{V<Dim>::Unit(axis), 0.0});
        system.add_obstacle(talus::HalfSpace<Dim>{-V<Dim>::Unit(axis), -size * width});
    }
    std::mt19937 rng(7);
    const int per_layer = Dim == 2 ? wide : wide * wide;
    for (int k = 0; k < per_layer * high; ++k) {
        V<Dim> x;
        x[0] = (k % wide + 0.5) * pitch;
        x[1] = ((k / wide) % wide + 0.5) * pitch;
        x[Dim - 1] = (k / per_layer + 0.5) * pitch;
        x += random_input::vector<V<Dim>>(rng, 0.004);
        const double r = random_input::uniform(rng, 0.04, 0.06);
        system.add(talus::Ball<Dim>{size * r}, 2600.0, {size * x, {}});
    }
    return sim;
}

}  // namespace experiment
