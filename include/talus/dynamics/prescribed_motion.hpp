// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/spatial/pose.hpp>
#include <talus/spatial/twist.hpp>

#include <functional>
#include <utility>

namespace talus {

/// Motion of an obstacle as a function of time: the term W of [Moreau] equation (4). `pose` places
/// the shape, `twist` gives the velocity of its points. They need not belong together: a belt has a
/// constant pose and a twist that is not zero.
template <int Dim>
requires SpaceDimension<Dim>
struct PrescribedMotion {
    std::function<Pose<Dim>(double)> pose;    ///< of time [s]
    std::function<Twist<Dim>(double)> twist;  ///< world axes, of time [s]

    /// Any motion.
    PrescribedMotion(std::function<Pose<Dim>(double)> pose_,
                     std::function<Twist<Dim>(double)> twist_)
        : pose(std::move(pose_)), twist(std::move(twist_)) {}

    /// Stands still at `at`. Implicit: a pose is the motion of what does not move.
    PrescribedMotion(const Pose<Dim>& at = {}) : PrescribedMotion(belt(at, {})) {}

    /// Stands still at `at` while its surface moves as part of a rigid body of twist `surface`: an
    /// endless belt, a turntable.
    static PrescribedMotion belt(const Pose<Dim>& at, const Twist<Dim>& surface) {
        require_finite("position of the obstacle", at.position);
        return PrescribedMotion([at](double) { return at; }, [surface](double) { return surface; });
    }

    /// Moves from `start` (at time 0) with constant velocity and spin.
    static PrescribedMotion uniform(const Pose<Dim>& start, const Twist<Dim>& v) {
        require_finite("position of the obstacle", start.position);
        return {[start, v](double t) {
                    return Pose<Dim>{start.position + t * v.linear,
                                     Rotation<Dim>::exp(t * v.angular) * start.rotation};
                },
                [v](double) { return v; }};
    }

    /// Is shifted from `start` without turning: by `displacement(t)` [m], at `velocity(t)` [m/s].
    static PrescribedMotion shifted(const Pose<Dim>& start,
                                    std::function<Vector<Dim>(double)> displacement,
                                    std::function<Vector<Dim>(double)> velocity) {
        return {[start, d = std::move(displacement)](double t) {
                    return Pose<Dim>{start.position + d(t), start.rotation};
                },
                [v = std::move(velocity)](double t) {
                    return Twist<Dim>{v(t), AngularVector<Dim>::Zero()};
                }};
    }
};

}  // namespace talus
