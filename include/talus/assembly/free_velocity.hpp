// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/forces.hpp>
#include <talus/spatial/gyroscopic.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// What the gyroscopic term alone makes of a body's spin over a step.
template <int Dim>
struct GyroscopicChange {
    AngularVector<Dim> spin;     ///< body axes [rad/s]
    bool turns_too_far = false;  ///< within the step for its momentum to be kept
};

/// Over a step of size h [s].
template <int Dim>
GyroscopicChange<Dim> gyroscopic_change(const Bodies<Dim>& bodies, std::size_t i, double h,
                                        Gyroscopic gyroscopic) {
    const AngularVector<Dim>& inverse = bodies.inverse_inertia[i];
    // About a guided axis no gyroscopic moment acts: it is across.
    if (inverse == AngularVector<Dim>::Constant(inverse[0]) || !(inverse.minCoeff() > 0.0) ||
        bodies.locked[i].rotation_count() > 0)
        return {AngularVector<Dim>::Zero()};
    const AngularVector<Dim> moments = bodies.inertia(i);
    if (gyroscopic == Gyroscopic::explicit_term)
        return {h * inverse.cwiseProduct(gyroscopic_torque<Dim>(bodies.spin[i], moments))};
    const TorqueFreeSpin<Dim> end = torque_free_spin<Dim>(bodies.spin[i], moments, h);
    return {end.spin - bodies.spin[i], end.in_parts};
}

/// The velocity the step would end with without contact impulses, first line of [Moreau] (9):
/// u_free = u_begin + h A^-1 F(t_mid, q_mid, u_begin), as world-axis twist of body i, for gravity
/// [m/s^2], an applied wrench and the gyroscopic change of spin (body axes). `bodies` holds q_mid
/// and u_begin. Obstacles keep their twist.
template <int Dim>
Twist<Dim> free_velocity(const Bodies<Dim>& bodies, std::size_t i, double h,
                         const Vector<Dim>& gravity, const Wrench<Dim>& applied,
                         const AngularVector<Dim>& gyroscopic) {
    Twist<Dim> free = bodies.twist(i);
    if (bodies.is_obstacle(i)) return free;
    if (const LockedAxes<Dim>& locked = bodies.locked[i]; locked.any()) {
        free.linear = locked.free_part(
            Vector<Dim>(free.linear + h * (gravity + bodies.inverse_mass[i] * applied.force)));
        const AngularMatrix<Dim> mobility = free_inverse_inertia_world(bodies, i);
        free.angular = locked.free_turn(
            AngularVector<Dim>(free.angular + bodies.rotation[i].spin_world(gyroscopic) +
                               h * (mobility * applied.torque)));
        return free;
    }
    const Rotation<Dim>& rotation = bodies.rotation[i];
    const AngularVector<Dim> torque = rotation.spin_body(applied.torque);
    free.linear += h * (gravity + bodies.inverse_mass[i] * applied.force);
    free.angular +=
        rotation.spin_world(gyroscopic + h * bodies.inverse_inertia[i].cwiseProduct(torque));
    return free;
}

}  // namespace talus
