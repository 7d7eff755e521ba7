// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>
#include <talus/collision/feature_code.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/geometry/shape_view.hpp>

#include <cstdint>
#include <optional>

namespace talus {

/// Contacts of a rounded core with a half-space: every vertex of the core that is near enough, to
/// its slack.
template <int Dim>
void append_half_space_contacts(const CoreView<Dim>& a, const Pose<Dim>& pose_a,
                                const HalfSpace<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                Column<ContactPoint<Dim>>& out) {
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
                                      double margin, Column<ContactPoint<Dim>>& out) {
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

namespace detail {

/// The contact of a placed hole with the ball of radius r about x (world), if it is near enough.
template <int Dim>
void append_in_hole(const Vector<Dim>& x, double r, const RoundHole<Dim>& hole,
                    const Pose<Dim>& pose, double margin, FeatureId feature,
                    Column<ContactPoint<Dim>>& out) {
    const Vector<Dim> across = hole.across(pose.point_body(x));
    const double way = across.norm();
    const double gap = hole.radius() - r - way;
    // (At the axis, which has no nearest side, nothing touches that is smaller than the hole.)
    if (!(gap <= margin) || !(way > 0.0)) return;
    const Vector<Dim> normal = pose.rotation * Vector<Dim>(-across / way);
    out.push_back({x - (r + 0.5 * gap) * normal, normal, gap, feature});
}

}  // namespace detail

/// Contacts of a rounded core with the solid around a hole: every vertex of the core that is near
/// enough, since the hole is convex. Of a core larger than the hole those that reach out of it.
template <int Dim>
void append_hole_contacts(const CoreView<Dim>& a, const Pose<Dim>& pose_a, const RoundHole<Dim>& b,
                          const Pose<Dim>& pose_b, double margin, Column<ContactPoint<Dim>>& out) {
    const double reach = b.across(pose_b.point_body(pose_a.point_world(a.centre))).norm() + a.bound;
    if (b.radius() - reach > margin + a.slack) return;
    for (std::uint32_t i = 0; i < a.vertices.size(); ++i)
        detail::append_in_hole<Dim>(pose_a.point_world(a.vertices[i]), a.radius, b, pose_b,
                                    margin + a.slack, feature_code({FeatureKind::vertex, i}, {}),
                                    out);
}

/// The same of a convex shape that is known by its support alone: the points that are farthest out
/// on two opposite sides, found by asking for the support along the way out of the point before.
template <int Dim>
void append_hole_contact_by_support(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                    const RoundHole<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                    Column<ContactPoint<Dim>>& out) {
    const Aabb<Dim> box = a.aabb(pose_a);
    const Vector<Dim> centre = pose_b.point_body(0.5 * (box.low + box.high));
    Vector<Dim> start = b.across(centre);
    for (int k = 0; k < Dim && !(start.norm() > 0.0); ++k)  // on the axis: any way across
        start = b.across(b.centre() + Vector<Dim>::Unit(k));
    const double size = (box.high - box.low).norm();
    std::optional<Vector<Dim>> first;
    for (const double side : {1.0, -1.0}) {
        Vector<Dim> way = side * start, x;
        for (int k = 0; k < 100; ++k) {
            const Vector<Dim> outwards = pose_b.rotation * way;
            x = pose_a.point_world(a.support(pose_a.rotation.transpose_times(outwards)));
            const Vector<Dim> next = b.across(pose_b.point_body(x));
            if (!(next.norm() > 0.0)) break;
            constexpr double rounding = 1e-13;  // of directions
            const bool there = (next / next.norm() - way / way.norm()).norm() <= rounding;
            way = next;
            if (there) break;
        }
        constexpr double apart = 1e-6;  // of the size: else it is the same point
        if (first && (x - *first).norm() <= apart * size) return;
        detail::append_in_hole<Dim>(x, 0.0, b, pose_b, margin,
                                    feature_code({FeatureKind::vertex, side > 0.0 ? 0u : 1u}, {}),
                                    out);
        first = x;
    }
}

}  // namespace talus
