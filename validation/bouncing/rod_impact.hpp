// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "harness/case.hpp"

/// A straight body that strikes the floor with one end, in one step without any force.
namespace validation {

/// Before the impact the body moves without turning, so its velocity is that of the end, too.
template <int Dim>
struct RodImpact {
    talus::Inertia<Dim> inertia;
    double length;                  ///< [m]
    talus::Rotation<Dim> rotation;  ///< body axes, the first along the rod, to world axes
    V<Dim> velocity;                ///< [m/s]

    /// From the mass centre to the end that strikes.
    V<Dim> arm() const {
        const V<Dim> half = rotation * Rod<Dim>{length}.end(1.0);
        return half[Dim - 1] < 0.0 ? half : V<Dim>(-half);
    }
    /// Change of the end's velocity by an impulse on it: the Delassus matrix, in world axes [1/kg].
    talus::Matrix<Dim> w() const {
        const V<Dim> a = arm();
        talus::Matrix<Dim> result = talus::Matrix<Dim>::Identity() / inertia.mass;
        if constexpr (Dim == 2) {
            const V<2> turned(-a[1], a[0]);
            result += turned * turned.transpose() / inertia.principal[0];
        } else {
            const talus::Matrix<3> axes = rotation.matrix();
            for (int k = 0; k < 3; ++k) {
                const V<3> moment = axes.transpose() * a.cross(V<3>::Unit(k));
                const V<3> spin = axes * moment.cwiseQuotient(inertia.principal);
                result.col(k) += spin.cross(a);
            }
        }
        return result;
    }
    double energy() const { return 0.5 * inertia.mass * velocity.squaredNorm(); }

    /// A world in which the next step is the impact: the end touches at the midpoint.
    World<Dim> world(Trial<Dim>& trial, const Law<Dim>& contact) const {
        constexpr double h = 1e-3;
        auto result = trial.world({.h = h, .contact = contact, .gravity = V<Dim>::Zero()});
        result.add_floor();
        result.add(Rod<Dim>{length}, inertia, {-arm() - 0.5 * h * velocity, rotation}, {velocity});
        return result;
    }
};

}  // namespace validation
