// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/half_space.hpp>

#include <vector>

namespace talus {

/// Contacts of a rounded core with a half-space: every vertex of the core that is near enough, to
/// its slack.
template <int Dim>
void append_half_space_contacts(const CoreView<Dim>& a, const Pose<Dim>& pose_a,
                                const HalfSpace<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                std::vector<ContactPoint<Dim>>& out) {
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim> up = pose_a.rotation.transpose_times(wall.normal());
    const double base = wall.normal().dot(pose_a.position) - wall.offset() - a.radius;
    if (up.dot(a.centre) + base + a.radius - a.bound > margin + a.slack) return;
    for (std::uint32_t i = 0; i < a.vertices.size(); ++i) {
        const double gap = up.dot(a.vertices[i]) + base;
        if (!(gap <= margin + a.slack)) continue;
        const Vector<Dim> x = pose_a.point_world(a.vertices[i]);
        out.push_back({x - (a.radius + 0.5 * gap) * wall.normal(), wall.normal(), gap,
                       feature_code({FeatureKind::vertex, i}, {})});
    }
}

/// Contact of a ball with a half-space: what append_half_space_contacts gives for its core of one
/// vertex, without turning a centre that is the origin.
template <int Dim>
inline void append_half_space_contact(const Ball<Dim>& a, const Pose<Dim>& pose_a,
                                      const HalfSpace<Dim>& b, const Pose<Dim>& pose_b,
                                      double margin, std::vector<ContactPoint<Dim>>& out) {
    if (!a.centre().isZero(0.0))
        return append_half_space_contacts<Dim>(a.core(), pose_a, b, pose_b, margin, out);
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim>& n = wall.normal();
    const double gap = n.dot(pose_a.position) - wall.offset() - a.radius();
    // The second is the question of append_half_space_contacts, asked there of all vertices at
    // once.
    if (!(gap <= margin) || gap + a.radius() - a.radius() > margin) return;
    out.push_back({pose_a.position - (a.radius() + 0.5 * gap) * n, n, gap, {}});
}

}  // namespace talus
