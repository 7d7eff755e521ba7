// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/feed/place.hpp>
#include <talus/stepping/simulation.hpp>

#include <cstdint>
#include <numbers>

#include "scatter.hpp"

namespace lab {

/// An upright silo without a floor about the last axis, and round grains for it: two plates in the
/// plane, a tube in space.
template <int Dim>
struct Vessel {
    double width;     ///< distance of the plates, or diameter [m]
    double diameter;  ///< mean, of grains; they differ by a fifth of it [m]

    double area() const { return Dim == 2 ? width : 0.25 * std::numbers::pi * width * width; }
    /// About as many grains as fill it up to a height [m].
    double grains(double height) const {
        constexpr double solid = Dim == 2 ? 0.82 : 0.6, unit = std::numbers::pi / (2.0 * Dim);
        return height * area() * solid / (unit * std::pow(diameter, Dim));
    }
    double largest_radius() const { return 0.6 * diameter; }
    talus::UniformRadii radii() const { return {0.4 * diameter, largest_radius()}; }

    /// The wall, one or two obstacles.
    void add_wall(talus::System<Dim>& system, talus::MaterialIndex material = 0) const {
        using V = talus::Vector<Dim>;
        if constexpr (Dim == 2)
            for (const double side : {-1.0, 1.0})
                system.add_obstacle(talus::HalfSpace<2>(side * V::Unit(0), -0.5 * width), {},
                                    material);
        else
            system.add_obstacle(talus::RoundHole<3>(0.5 * width, V::Unit(2)), {}, material);
    }
    /// Loose grains from the height `low` on [m], which then fall.
    void scatter(talus::System<Dim>& system, double count, double low, std::uint64_t seed) const {
        using V = talus::Vector<Dim>;
        V corner = V::Constant(0.5 * width);
        corner[Dim - 1] = -low;
        const double room = 0.5 * width - largest_radius();
        lab::scatter<Dim>(system, talus::balls<Dim>(radii()), largest_radius(),
                          static_cast<std::size_t>(count), -corner,
                          V(corner + 1e6 * V::Unit(Dim - 1)), seed, [room](V x) {
                              x[Dim - 1] = 0.0;
                              return x.norm() < room;
                          });
    }
    /// Anywhere at a height [m], for an inlet.
    talus::Place<Dim> at_height(double height) const {
        const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
        return talus::in_disc<Dim>(talus::Vector<Dim>(height * up), 0.5 * width - largest_radius(),
                                   up);
    }
};

}  // namespace lab
