// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/stepping/simulation.hpp>

#include <numbers>

namespace lab {

/// A drum about the origin: a circle in the plane, in space a tube along axis 1 with two ends.
template <int Dim>
struct RoundDrum {
    double radius;  ///< [m]
    double half;    ///< of its length, in space [m]

    /// Its wall, the body that turns, and in space its ends, which rest.
    talus::BodyIndex add_to(talus::System<Dim>& system, talus::MaterialIndex wall,
                            talus::MaterialIndex ends) const {
        using V = talus::Vector<Dim>;
        if constexpr (Dim == 2) {
            return system.add_obstacle(talus::RoundHole<2>(radius), {}, wall);
        } else {
            const auto drum =
                system.add_obstacle(talus::RoundHole<3>(radius, V::Unit(1)), {}, wall);
            for (const double side : {-1.0, 1.0})
                system.add_obstacle(talus::HalfSpace<3>(side * V::Unit(1), -half), {}, ends);
            return drum;
        }
    }
    double volume() const {  ///< [m^Dim]
        const double circle = std::numbers::pi * radius * radius;
        return Dim == 2 ? circle : circle * (2.0 * half);
    }
    /// The motion at so many turns in a second [1/s], from the axis 0 up.
    talus::Twist<Dim> turning(double turns) const {
        talus::Twist<Dim> twist;
        twist.angular[Dim == 2 ? 0 : 1] = (Dim == 2 ? 1.0 : -1.0) * 2.0 * std::numbers::pi * turns;
        return twist;
    }
};

}  // namespace lab
