// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/feed/place.hpp>
#include <talus/sample/vessels.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstddef>
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
        for (const auto& wall : talus::tube<Dim>(width))
            system.add_obstacle(wall.shape, wall.pose, material);
    }
    /// A floor of planks around an opening: two in the plane, in space 16, whose ends are tangents
    /// of a circle. The first obstacles of all.
    static constexpr std::size_t planks = Dim == 2 ? 2 : 16;
    void add_planks(talus::System<Dim>& system) const {
        talus::Vector<Dim> half = talus::Vector<Dim>::Constant(0.6 * width);
        half[Dim - 1] = diameter;
        for (std::size_t k = 0; k < planks; ++k)
            system.add_obstacle(talus::Box<Dim>(half), plank_at(k, 0.0));
    }
    /// The opening becomes that wide [m], at once.
    void open(talus::System<Dim>& system, double opening) const {
        for (std::size_t k = 0; k < planks; ++k) system.obstacles[k].motion = plank_at(k, opening);
    }
    talus::Pose<Dim> plank_at(std::size_t k, double opening) const {
        talus::AngularVector<Dim> turn = talus::AngularVector<Dim>::Zero();
        turn[Dim == 2 ? 0 : 2] = 2.0 * std::numbers::pi * static_cast<double>(k) / planks;
        const auto rotation = talus::Rotation<Dim>::exp(turn);
        talus::Vector<Dim> middle = talus::Vector<Dim>::Zero();
        middle[0] = 0.5 * opening + 0.6 * width;
        middle = rotation * middle;
        middle[Dim - 1] = -diameter;
        return {middle, rotation};
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
    /// Anywhere between two heights [m], for an inlet.
    talus::Place<Dim> between(double low, double high) const {
        const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
        const auto across =
            talus::in_disc<Dim>(talus::Vector<Dim>::Zero(), 0.5 * width - largest_radius(), up);
        return [=](talus::Random& random) {
            const talus::Vector<Dim> x = across(random);
            return talus::Vector<Dim>(x + random.uniform(low, high) * up);
        };
    }
};

}  // namespace lab
