// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/half_space.hpp>

#include <vector>

namespace talus {

/// Contacts of a rounded core with a half-space: every vertex of the core that is near enough.
template <int Dim>
void append_half_space_contacts(const CoreView<Dim>& a, const Pose<Dim>& pose_a,
                                const HalfSpace<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                std::vector<ContactPoint<Dim>>& out) {
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim> up = pose_a.rotation.transpose_times(wall.normal());
    const double base = wall.normal().dot(pose_a.position) - wall.offset() - a.radius;
    if (up.dot(a.centre) + base + a.radius - a.bound > margin) return;
    for (std::uint32_t i = 0; i < a.vertices.size(); ++i) {
        const double gap = up.dot(a.vertices[i]) + base;
        if (!(gap <= margin)) continue;
        const Vector<Dim> x = pose_a.point_world(a.vertices[i]);
        out.push_back({x - (a.radius + 0.5 * gap) * wall.normal(), wall.normal(), gap,
                       feature_code({FeatureKind::vertex, i}, {})});
    }
}

}  // namespace talus
