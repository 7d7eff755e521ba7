// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "harness/case.hpp"

/// A block of half width b and half height H on the floor, rocking about its lower corners (edges).
namespace validation {

struct RockingBlock {
    double b, height;  ///< half width, half height H [m]
    double mass = 1.0;
    static constexpr double half_depth = 0.2;  ///< in space [m]

    double slenderness() const { return std::atan2(b, height); }
    double radius() const { return std::hypot(b, height); }  ///< corner to centre [m]
    /// About the centre.
    double inertia() const { return mass / 3 * radius() * radius(); }
    /// Housner: spin after over spin before when the block lands and rocks on about its other
    /// corner.
    double housner() const {
        const double s = std::sin(slenderness());
        return 1 - 1.5 * s * s;
    }

    template <int Dim>
    V<Dim> half() const {
        V<Dim> result = V<Dim>::Constant(half_depth);
        result[0] = b;
        result[Dim - 1] = height;
        return result;
    }
    /// Body 1 of a world; turns by `angle` from the first towards the last axis.
    template <int Dim>
    void add(World<Dim>& world, const V<Dim>& centre, double angle,
             const talus::Twist<Dim>& twist = {}) const {
        world.add(talus::Box<Dim>(half<Dim>()), box_inertia<Dim>(mass, half<Dim>()),
                  {centre, tilt<Dim>(angle)}, twist);
    }
};

}  // namespace validation
