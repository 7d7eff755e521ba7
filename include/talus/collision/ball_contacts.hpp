// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/ball.hpp>

namespace talus {

/// Contact of ball with ball. Concentric balls, which have no direction of separation, get the last
/// axis of the world. Declared inline since the call would cost a third of the work.
template <int Dim>
inline void append_ball_contact(const Ball<Dim>& a, const Pose<Dim>& pose_a, const Ball<Dim>& b,
                                const Pose<Dim>& pose_b, double margin,
                                Column<ContactPoint<Dim>>& out) {
    const Vector<Dim> centre_b = b.centre_world(pose_b);
    const Vector<Dim> apart = a.centre_world(pose_a) - centre_b;
    const double reach = a.radius() + b.radius() + margin;
    const double distance2 = apart.squaredNorm();
    if (reach < 0.0 || !(distance2 <= reach * reach)) return;
    const double distance = std::sqrt(distance2);
    const Vector<Dim> normal =
        distance > 0.0 ? Vector<Dim>(apart / distance) : Vector<Dim>::Unit(Dim - 1);
    const double gap = distance - a.radius() - b.radius();
    out.push_back({centre_b + (b.radius() + 0.5 * gap) * normal, normal, gap, {}});
}

}  // namespace talus
