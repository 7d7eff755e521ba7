// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>

#include <vector>

namespace talus {

/// Ball with ball. Concentric balls, whose direction of separation is not defined, get the last
/// axis of the world.
template <int Dim>
void append_contacts(const Ball<Dim>& a, const Pose<Dim>& pose_a, const Ball<Dim>& b,
                     const Pose<Dim>& pose_b, double margin, std::vector<ContactPoint<Dim>>& out) {
    const Vector<Dim> centre_b = pose_b.point_world(b.centre());
    const Vector<Dim> apart = pose_a.point_world(a.centre()) - centre_b;
    const double reach = a.radius() + b.radius() + margin;
    const double distance2 = apart.squaredNorm();
    if (reach < 0.0 || !(distance2 <= reach * reach)) return;
    const double distance = std::sqrt(distance2);
    const Vector<Dim> normal =
        distance > 0.0 ? Vector<Dim>(apart / distance) : Vector<Dim>::Unit(Dim - 1);
    const double gap = distance - a.radius() - b.radius();
    out.push_back({centre_b + (b.radius() + 0.5 * gap) * normal, normal, gap, {}});
}

/// Ball with half-space.
template <int Dim>
void append_contacts(const Ball<Dim>& a, const Pose<Dim>& pose_a, const HalfSpace<Dim>& b,
                     const Pose<Dim>& pose_b, double margin, std::vector<ContactPoint<Dim>>& out) {
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim> centre = pose_a.point_world(a.centre());
    const double gap = wall.normal().dot(centre) - wall.offset() - a.radius();
    if (!(gap <= margin)) return;
    out.push_back({centre - (a.radius() + 0.5 * gap) * wall.normal(), wall.normal(), gap, {}});
}

/// Half-space with ball: the mirrored contacts.
template <int Dim>
void append_contacts(const HalfSpace<Dim>& a, const Pose<Dim>& pose_a, const Ball<Dim>& b,
                     const Pose<Dim>& pose_b, double margin, std::vector<ContactPoint<Dim>>& out) {
    const std::size_t first = out.size();
    append_contacts<Dim>(b, pose_b, a, pose_a, margin, out);
    mirror<Dim>(std::span(out).subspan(first));
}

/// Two half-spaces: both obstacles, no contacts.
template <int Dim>
void append_contacts(const HalfSpace<Dim>&, const Pose<Dim>&, const HalfSpace<Dim>&,
                     const Pose<Dim>&, double, std::vector<ContactPoint<Dim>>&) {}

}  // namespace talus
