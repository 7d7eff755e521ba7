// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <cstddef>

namespace talus {

/// sum m c c^T over the free bodies, with c the velocity of a body against that of the cell where
/// it is, less the mean of all: momentum that motion carries along, volume times the stress that it
/// adds, with the other sign [J]. The same whichever image is the body.
template <int Dim>
Matrix<Dim> kinetic_moment(const Bodies<Dim>& bodies, const PeriodicCell<Dim>& cell) {
    double mass = 0.0;
    Vector<Dim> mean = Vector<Dim>::Zero();
    const auto own = [&](std::size_t i) {
        return Vector<Dim>(bodies.velocity[i] - cell.velocity_at(bodies.position[i]));
    };
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        mass += bodies.mass(i);
        mean += bodies.mass(i) * own(i);
    }
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    if (!(mass > 0.0)) return sum;
    mean /= mass;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        const Vector<Dim> c = own(i) - mean;
        sum += bodies.mass(i) * (c * c.transpose());
    }
    return sum;
}

}  // namespace talus
