// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>

#include <cstddef>

namespace talus {

/// Linear momentum of all free bodies, and angular momentum about the origin, in world axes.
template <int Dim>
requires SpaceDimension<Dim>
struct Momentum {
    Vector<Dim> linear = Vector<Dim>::Zero();                 ///< [N s]
    AngularVector<Dim> angular = AngularVector<Dim>::Zero();  ///< [N m s]
};

/// Total momentum of the free bodies. Bodies that do not turn contribute their orbital part alone.
template <int Dim>
Momentum<Dim> momentum(const Bodies<Dim>& bodies) {
    Momentum<Dim> total;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        const Vector<Dim> p = bodies.mass(i) * bodies.velocity[i];
        total.linear += p;
        total.angular += moment<Dim>(bodies.position[i], p);
        AngularVector<Dim> own = AngularVector<Dim>::Zero();
        for (int k = 0; k < rotation_dof<Dim>; ++k)
            if (bodies.inverse_inertia[i][k] > 0.0)
                own[k] = bodies.spin[i][k] / bodies.inverse_inertia[i][k];
        total.angular += bodies.rotation[i].spin_world(own);
    }
    return total;
}

}  // namespace talus
