// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>

#include <cstddef>

namespace talus {

/// Moves all free bodies along their present velocities for a time [s]: q + duration u.
template <int Dim>
void drift(Bodies<Dim>& bodies, double duration) {
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        bodies.position[i] += duration * bodies.velocity[i];
        bodies.rotation[i] =
            (bodies.rotation[i] * Rotation<Dim>::exp(duration * bodies.spin[i])).normalized();
    }
}

}  // namespace talus
