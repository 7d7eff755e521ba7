// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/prescribed_motion.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace talus {

namespace detail {

[[noreturn]] inline void reject_motion(std::size_t body, double t, std::string_view what) {
    throw input_error(
        numbered("prescribed motion of body", body, " at time " + text_of(t) + std::string(what)));
}

/// Whether the twist of a motion at time t belongs to its pose, by differences over `reach` [s]: of
/// one side at least, as a motion may change its velocity at t.
template <int Dim>
bool twist_belongs(const PrescribedMotion<Dim>& motion, const Pose<Dim>& pose,
                   const Twist<Dim>& twist, double t, double reach) {
    constexpr double share = 0.01;  // of the faster one
    const auto agrees = [&](double side) {
        const Pose<Dim> other = motion.pose(t + side);
        const Vector<Dim> linear = (other.position - pose.position) / side;
        const AngularVector<Dim> angular = (other.rotation * pose.rotation.inverse()).log() / side;
        const double rounding =
            16.0 * std::numeric_limits<double>::epsilon() * (1.0 + pose.position.norm()) / reach;
        return (linear - twist.linear).norm() <=
                   share * std::max(linear.norm(), twist.linear.norm()) + rounding &&
               (angular - twist.angular).norm() <=
                   share * std::max(angular.norm(), twist.angular.norm()) + rounding;
    };
    return agrees(reach) || agrees(-reach);
}

}  // namespace detail

/// Puts body i where its prescribed motion has it at time t [s]. Throws input_error if that is not
/// finite, and where `reach` [s] is given, if pose and twist do not belong together by differences
/// over it.
template <int Dim>
void place(Bodies<Dim>& bodies, std::size_t i, const PrescribedMotion<Dim>& motion, double t,
           double reach = 0.0) {
    const Pose<Dim> pose = motion.pose(t);
    const Twist<Dim> twist = motion.twist(t);
    if (!pose.position.allFinite() || !pose.rotation.matrix().allFinite() ||
        !twist.linear.allFinite() || !twist.angular.allFinite())
        detail::reject_motion(i, t, " is not finite, but must be");
    if (reach > 0.0 && !motion.surface_moves &&
        !detail::twist_belongs(motion, pose, twist, t, reach))
        detail::reject_motion(
            i, t,
            " has a twist that is not that of its pose, but must be: give the pose "
            "alone (of_pose), or say that the surface moves (belt, with_surface)");
    bodies.position[i] = pose.position;
    bodies.rotation[i] = pose.rotation;
    bodies.velocity[i] = twist.linear;
    bodies.spin[i] = pose.rotation.spin_body(twist.angular);
}

}  // namespace talus
