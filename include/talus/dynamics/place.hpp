// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/prescribed_motion.hpp>

#include <cstddef>
#include <string>

namespace talus {

/// Puts body i where its prescribed motion has it at time t [s]. Throws input_error if that is not
/// finite.
template <int Dim>
void place(Bodies<Dim>& bodies, std::size_t i, const PrescribedMotion<Dim>& motion, double t) {
    const Pose<Dim> pose = motion.pose(t);
    const Twist<Dim> twist = motion.twist(t);
    if (!pose.position.allFinite() || !twist.linear.allFinite() || !twist.angular.allFinite())
        throw input_error("prescribed motion of body " + std::to_string(i) + " at time " +
                          detail::text_of(t) + " is not finite, but must be");
    bodies.position[i] = pose.position;
    bodies.rotation[i] = pose.rotation;
    bodies.velocity[i] = twist.linear;
    bodies.spin[i] = pose.rotation.spin_body(twist.angular);
}

}  // namespace talus
