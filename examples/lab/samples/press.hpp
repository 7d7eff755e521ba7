// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/servo.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/sample/lattice.hpp>
#include <talus/stepping/simulation.hpp>

#include <array>
#include <cmath>
#include <cstddef>

#include "grains.hpp"

namespace lab {

/// A box of walls for samples that are pressed: along each axis a wall at 0 and, opposite, either a
/// lid, which moves along the axis alone under a pressure, or a pair of jaws that move as told.
template <int Dim>
class PressedBox {
  public:
    using V = talus::Vector<Dim>;

    /// Fills a box, loosely: `count` grains on a lattice, turned at random. The system has no walls
    /// yet; theirs is the material `walls`.
    template <talus::RadiusLaw Law>
    PressedBox(talus::System<Dim>& system, std::size_t count, const Law& radii, bool angular,
               talus::MaterialIndex walls, std::uint64_t seed)
        : walls_(walls) {
        talus::Random random(seed);
        const double pitch = 2.1 * radii.high_end();
        const double along = std::ceil(std::pow(static_cast<double>(count), 1.0 / Dim));
        size_ = V::Constant(1.001 * pitch * along);
        size_[Dim - 1] = pitch * std::ceil(static_cast<double>(count) / std::pow(along, Dim - 1));
        const auto shape = lab::grains<Dim>(angular, radii);
        for (const V& place : talus::jittered_lattice<Dim>(
                 random, {.count = count, .box_size = size_, .largest_radius = radii.high_end()})) {
            const talus::AnyShape<Dim> grain = shape(random);
            system.add(grain, density, {place, talus::random_rotation<Dim>(random)});
            mass_ += system.bodies.mass(system.bodies.count() - 1);
        }
        grains_ = count;
    }

    /// Two walls across an axis that rest until `begin` [s] and then approach each other, each at
    /// `speed` [m/s], which they reach within `soft` [s].
    void add_jaws(talus::System<Dim>& system, int axis, double begin, double soft, double speed) {
        for (const int side : {0, 1}) {
            const V inwards = (side == 0 ? 1.0 : -1.0) * V::Unit(axis);
            const V start = side == 0 ? V(V::Zero()) : V(size_[axis] * V::Unit(axis));
            ends_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] =
                system.add_obstacle(talus::HalfSpace<Dim>(inwards, 0.0),
                                    talus::PrescribedMotion<Dim>::of_accelerations(
                                        {start, {}}, {begin, begin + 0.5 * soft, begin + soft},
                                        {V::Zero(), V(2.0 * speed / soft * inwards), V::Zero()}),
                                    walls_);
        }
    }
    /// A wall at 0 and a lid opposite, which presses by `pressure` [N/m^(Dim-1)] on what its area
    /// is, at no more than `top_speed` [m/s]. It has the mass of a layer of grains or so.
    void add_lid(talus::System<Dim>& system, int axis, double pressure, double top_speed) {
        const V normal = V::Unit(axis);
        const double mass = 0.1 * mass_;
        const auto lid =
            system.add(talus::HalfSpace<Dim>(-normal, 0.0),
                       talus::Inertia<Dim>{mass, talus::AngularVector<Dim>::Constant(mass)},
                       {V(size_[axis] * normal), {}}, {}, walls_);
        system.bodies.lock(lid, talus::LockedAxes<Dim>::all_but_translation(axis));
        const auto wall = system.add_obstacle(talus::HalfSpace<Dim>(normal, 0.0), {}, walls_);
        ends_[static_cast<std::size_t>(axis)] = {wall, lid};
        system.forces.push_back(talus::servo<Dim>(
            system.bodies.id[lid],
            {.direction = -normal,
             .force =
                 [this, axis, pressure](double, const talus::Bodies<Dim>& bodies) {
                     return pressure * area(bodies, axis);
                 },
             .damping = 20.0,
             .top_speed = top_speed}));
    }
    /// Moves all that is free apart, by a share of its distance from the origin, and stops it: it
    /// presses together again, by next to nothing.
    void loosen(talus::System<Dim>& system, double share) const {
        for (std::size_t i = 0; i < system.bodies.count(); ++i) {
            if (system.bodies.is_obstacle(i)) continue;
            system.bodies.position[i] *= 1.0 + share;
            system.bodies.velocity[i].setZero();
        }
    }
    // Forces refer to it.
    PressedBox(const PressedBox&) = delete;
    PressedBox& operator=(const PressedBox&) = delete;

    std::size_t grains() const { return grains_; }
    /// Bodies of the wall at 0 and the one opposite.
    const std::array<talus::BodyIndex, 2>& ends(int axis) const {
        return ends_[static_cast<std::size_t>(axis)];
    }
    double extent(const talus::Bodies<Dim>& bodies, int axis) const {
        return bodies.position[ends(axis)[1]][axis] - bodies.position[ends(axis)[0]][axis];
    }
    /// Of the walls across an axis [m^(Dim-1)].
    double area(const talus::Bodies<Dim>& bodies, int across) const {
        double product = 1.0;
        for (int axis = 0; axis < Dim; ++axis)
            if (axis != across) product *= extent(bodies, axis);
        return product;
    }
    double volume(const talus::Bodies<Dim>& bodies) const {
        return area(bodies, 0) * extent(bodies, 0);
    }
    V middle(const talus::Bodies<Dim>& bodies) const {
        V x;
        for (int axis = 0; axis < Dim; ++axis)
            x[axis] =
                0.5 * (bodies.position[ends(axis)[0]][axis] + bodies.position[ends(axis)[1]][axis]);
        return x;
    }
    /// Solid part of the volume.
    double solid_fraction(const talus::Bodies<Dim>& bodies) const {
        return mass_ / density / volume(bodies);
    }
    /// At the beginning [m].
    const V& size() const { return size_; }

    static constexpr double density = 2600.0;  ///< of the grains [kg/m^Dim]

  private:
    talus::MaterialIndex walls_;
    V size_;
    std::size_t grains_ = 0;
    double mass_ = 0.0;
    std::array<std::array<talus::BodyIndex, 2>, Dim> ends_{};
};

}  // namespace lab
