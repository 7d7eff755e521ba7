// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/sample/vessels.hpp>
#include <talus/stepping/simulation.hpp>

#include <cstddef>
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
        const auto shapes = talus::drum<Dim>(radius, 2.0 * half);
        const auto turning = system.add_obstacle(shapes[0].shape, {}, wall);
        for (std::size_t k = 1; k < shapes.size(); ++k)
            system.add_obstacle(shapes[k].shape, {}, ends);
        return turning;
    }
    double volume() const {  ///< [m^Dim]
        const double circle = std::numbers::pi * radius * radius;
        return Dim == 2 ? circle : circle * (2.0 * half);
    }
};

}  // namespace lab
