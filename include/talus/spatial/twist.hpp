// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/input.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace talus {

/// Velocity of a rigid body, in world axes: of its centre, and its spin.
///
/// `{v}` is the twist of a body that does not turn.
template <int Dim>
requires SpaceDimension<Dim>
struct Twist {
    Vector<Dim> linear = Vector<Dim>::Zero();                 ///< of the centre [m/s]
    AngularVector<Dim> angular = AngularVector<Dim>::Zero();  ///< world axes [rad/s]

    /// Velocity of the body's point at `arm` from the centre [m/s].
    Vector<Dim> at(const Vector<Dim>& arm) const { return linear + cross<Dim>(angular, arm); }
};

/// Throws input_error naming `item` and its number k, unless the twist is finite.
template <int Dim>
void require_finite_twist(std::string_view item, std::size_t k, const Twist<Dim>& v) {
    if (v.linear.allFinite() && v.angular.allFinite()) return;
    const std::string name = detail::numbered(item, k);
    require_finite(name, v.linear);
    require_finite(name + ", its spin", v.angular);
}

/// Dual of a twist: force through the centre and moment about it, in world axes. The same type
/// holds an impulse [N s] and its moment [N m s] where the name says `wrench_impulse`.
template <int Dim>
requires SpaceDimension<Dim>
struct Wrench {
    Vector<Dim> force = Vector<Dim>::Zero();                 ///< [N]
    AngularVector<Dim> torque = AngularVector<Dim>::Zero();  ///< about the centre [N m]

    /// The wrench of `force` acting at `arm` from the centre.
    static Wrench at(const Vector<Dim>& arm, const Vector<Dim>& force) {
        return {force, moment<Dim>(arm, force)};
    }
    Wrench& operator+=(const Wrench& o) {
        force += o.force;
        torque += o.torque;
        return *this;
    }
};

/// Power of a wrench on a twist [W].
template <int Dim>
double power(const Wrench<Dim>& w, const Twist<Dim>& v) {
    return w.force.dot(v.linear) + w.torque.dot(v.angular);
}

}  // namespace talus
