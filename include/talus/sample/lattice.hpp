// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>
#include <talus/sample/random.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace talus {

/// A loose, slightly disordered lattice of places for grains, filled layer by layer from the floor.
template <int Dim>
requires SpaceDimension<Dim>
struct LatticeParams {
    std::size_t count = 0;  ///< places wanted
    Vector<Dim> box_size;   ///< horizontal sides of the box [m]; the last, upward, is not read
    double largest_radius = 0.0;  ///< no grain reaches farther from its place [m]
    double looseness = 0.05;      ///< room between grains over their diameter, in [1e-3, 10]
};

/// Places at which balls of the largest radius overlap neither each other nor the walls x_i = 0,
/// x_i = box_size[i] and the floor: a cubic lattice, each place moved at random within its cell.
/// Throws input_error when a side holds no grain. Linear in the count.
template <int Dim>
std::vector<Vector<Dim>> jittered_lattice(Random& random, const LatticeParams<Dim>& params) {
    const double diameter = 2.0 * require_positive("largest radius [m]", params.largest_radius);
    require_in("looseness of the lattice", params.looseness, 1e-3, 10.0);
    const double pitch = diameter * (1.0 + params.looseness);
    std::array<std::size_t, Dim> cells{};
    Vector<Dim> cell = Vector<Dim>::Constant(pitch);
    for (int i = 0; i + 1 < Dim; ++i) {
        const double side = require_in("side of the box [m]", params.box_size[i], pitch, 1e9);
        const double fit = std::floor(side / pitch);
        require_in("grains along a side of the box", fit, 1.0, 1e6);
        cells[static_cast<std::size_t>(i)] = static_cast<std::size_t>(fit);
        cell[i] = side / fit;
    }
    std::vector<Vector<Dim>> places;
    places.reserve(params.count);
    for (std::size_t m = 0; m < params.count; ++m) {
        std::size_t rest = m;
        Vector<Dim> place;
        for (int i = 0; i < Dim; ++i) {
            const bool upward = i + 1 == Dim;
            const std::size_t wide = cells[static_cast<std::size_t>(i)];
            const std::size_t index = upward ? rest : rest % wide;
            if (!upward) rest /= wide;
            // The full room of the cell would let balls touch to rounding.
            const double room = 0.499 * (cell[i] - diameter);
            place[i] = (static_cast<double>(index) + 0.5) * cell[i] + random.uniform(-room, room);
        }
        places.push_back(place);
    }
    return places;
}

}  // namespace talus
