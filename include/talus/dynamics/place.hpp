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

[[noreturn, gnu::cold]] inline void reject_motion(std::size_t body, double t,
                                                  std::string_view what) {
    throw input_error(
        numbered("prescribed motion of body", body, joined({" at time ", text_of(t), what})));
}

/// The twist of a motion of that resolution [s].
[[noreturn, gnu::cold]] inline void reject_twist(std::size_t body, double t, double resolution) {
    if (resolution > 0.0)
        reject_motion(body, t,
                      joined({" changes too fast for its resolution of ", text_of(resolution),
                              " s, but must not: give of_pose a smaller one, or the twist"}));
    reject_motion(body, t,
                  " has a twist that is not that of its pose, but must be: give the pose alone "
                  "(of_pose), or say that the surface moves (belt, with_surface)");
}

inline bool equal_numbers(const double* x, const double* y, std::size_t count) {
    bool equal = true;
    for (std::size_t k = 0; k < count; ++k) equal = equal && x[k] == y[k];
    return equal;
}

/// How far `x` is from the segment between two points.
template <class Vec>
double distance_from_segment(const Vec& x, const Vec& from, const Vec& to) {
    const Vec along = to - from, way = x - from;
    const double square = along.squaredNorm();
    const double part = square > 0.0 ? std::clamp(along.dot(way) / square, 0.0, 1.0) : 0.0;
    return (way - part * along).norm();
}

/// Whether the twist of a motion at time t is, to a hundredth, between the differences of its pose
/// over `reach` [s] before and after: equal to both where the velocity is smooth, to one of them
/// where it jumps, and between them where it changes its sign.
template <int Dim>
bool is_between_differences(const PrescribedMotion<Dim>& motion, const Pose<Dim>& pose,
                            const Twist<Dim>& twist, double t, double reach) {
    const auto rate = [&](double side) {
        const Pose<Dim> other = motion.pose(t + side);
        return Twist<Dim>{(other.position - pose.position) / side,
                          (other.rotation * pose.rotation.inverse()).log() / side};
    };
    const Twist<Dim> before = rate(-reach), after = rate(reach);
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * (1.0 + pose.position.norm()) / reach;
    const auto agrees = [&](const auto& x, const auto& from, const auto& to) {
        // Differences of fourth order (of_pose) overshoot a jump by a sixth of what is seen of it.
        const double room = 0.01 * std::max({from.norm(), to.norm(), x.norm()}) +
                            (motion.resolution() > 0.0 ? 0.2 * (to - from).norm() : 0.0);
        return distance_from_segment(x, from, to) <= room + rounding;
    };
    return agrees(twist.linear, before.linear, after.linear) &&
           agrees(twist.angular, before.angular, after.angular);
}

/// Whether the twist of a motion at time t belongs to its pose. A twist made of differences is also
/// held to differences as wide as its own, if a step of 1000 `reach` is not shorter.
template <int Dim>
bool twist_belongs(const PrescribedMotion<Dim>& motion, const Pose<Dim>& pose,
                   const Twist<Dim>& twist, double t, double reach) {
    if (is_between_differences(motion, pose, twist, t, reach)) return true;
    const double wide = 2.0 * motion.resolution();
    return wide > reach && wide <= 1000.0 * reach &&
           is_between_differences(motion, pose, twist, t, wide);
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
    if (reach > 0.0 && !motion.surface_moves() &&
        !detail::twist_belongs(motion, pose, twist, t, reach))
        detail::reject_twist(i, t, motion.resolution());
    bodies.position[i] = pose.position;
    bodies.rotation[i] = pose.rotation;
    bodies.velocity[i] = twist.linear;
    bodies.spin[i] = pose.rotation.spin_body(twist.angular);
}

/// The state that a body was given, to notice when somebody else has changed it.
template <int Dim>
struct PlacedState {
    Vector<Dim> position;
    Rotation<Dim> rotation;
    Vector<Dim> velocity;
    AngularVector<Dim> spin;

    static PlacedState of(const Bodies<Dim>& bodies, std::size_t i) {
        return {bodies.position[i], bodies.rotation[i], bodies.velocity[i], bodies.spin[i]};
    }
    /// Number for number: a velocity of zero may be reversed.
    bool is_of(const Bodies<Dim>& bodies, std::size_t i) const {
        using detail::equal_numbers;
        constexpr std::size_t spins = Dim * (Dim - 1) / 2;
        return equal_numbers(position.data(), bodies.position[i].data(), Dim) &&
               equal_numbers(velocity.data(), bodies.velocity[i].data(), Dim) &&
               equal_numbers(spin.data(), bodies.spin[i].data(), spins) &&
               equal_numbers(rotation.matrix().data(), bodies.rotation[i].matrix().data(),
                             Dim * Dim);
    }
};

}  // namespace talus
