// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/stepping/system.hpp>

#include <cstddef>

namespace lab {

/// From now on an obstacle moves with constant velocity and spin (world axes) from where it is; the
/// motion is one that a checkpoint can hold.
template <int Dim, class System>
void move_on(System& system, talus::BodyIndex body, const talus::Twist<Dim>& twist) {
    const double t = system.time();
    const auto now = system.bodies.pose(static_cast<std::size_t>(body));
    const talus::Pose<Dim> start{
        now.position - t * twist.linear,
        talus::Rotation<Dim>::exp(talus::AngularVector<Dim>(-t * twist.angular)) * now.rotation};
    for (auto& obstacle : system.obstacles)
        if (obstacle.body == body)
            obstacle.motion = talus::PrescribedMotion<Dim>::uniform(start, twist);
}

}  // namespace lab
