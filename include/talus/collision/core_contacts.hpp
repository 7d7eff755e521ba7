// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/edge_contacts.hpp>
#include <talus/collision/face_contacts.hpp>
#include <talus/collision/gjk.hpp>
#include <talus/core/column.hpp>
#include <talus/core/instantiate.hpp>

namespace talus {

namespace detail {

/// Refines `axis` to the direction of the nearest points if the cores are clearly apart. Returns
/// whether they are.
template <int Dim>
bool find_nearest_points(const CorePair<Dim>& p, const Vector<Dim>& start,
                         SeparatingAxis<Dim>& axis) {
    const auto near =
        nearest_points<Dim>([&](const Vector<Dim>& d) { return p.support(d); }, start, p.size);
    // Closer than this the direction is rounding, and a face or a pair of edges is as good.
    if (!(near.distance > 1e-8 * p.size)) return false;
    axis = {near.apart / near.distance, near.distance, near.a, near.b};
    return true;
}

/// Replaces `axis` by the normal of a face that separates as well to the slack: the direction of
/// nearest points of uneven faces is that of their unevenness.
template <int Dim>
void prefer_face(const CorePair<Dim>& p, double limit, SeparatingAxis<Dim>& axis) {
    SeparatingAxis<Dim> of_a, of_b;
    const CorePair<Dim> q = p.exchanged();
    if (!try_faces(p, limit, of_a) || !try_faces(q, limit, of_b)) return;
    const bool is_b = improves(of_a, of_b.separation, p.preference()) && q.a.face_count() > 0;
    if (std::max(of_a.separation, of_b.separation) < axis.separation - p.slack) return;
    if (is_b)
        axis = {-(p.rotation * of_b.normal), of_b.separation, p.in_a(of_b.point_b),
                p.in_a(of_b.point_a)};
    else
        axis = of_a;
}

/// The best axis; false if the cores are farther apart than `limit`. Rounded cores are mostly
/// apart, sharp ones in contact mostly overlap: each begins with the question likely to be last.
template <int Dim>
bool find_axis(const CorePair<Dim>& p, double limit, SeparatingAxis<Dim>& axis) {
    const Vector<Dim> apart = p.a.centre - p.in_a(p.b.centre);
    const double reach = p.a.bound + p.b.bound + limit - p.rounding();
    if (!(apart.squaredNorm() <= reach * reach) || reach < 0.0) return false;
    if (p.rounding() > 0.0) {
        if (!find_nearest_points<Dim>(
                p, apart.isZero(0.0) ? Vector<Dim>(Vector<Dim>::Unit(0)) : apart, axis))
            return find_separating_axis(p, limit, axis);
    } else {
        if (!find_separating_axis(p, limit, axis)) return false;
        if (!(axis.separation > 0.0)) return axis.separation <= limit;
        find_nearest_points<Dim>(p, Vector<Dim>(axis.normal), axis);
    }
    if (!(axis.separation <= limit)) return false;
    if (p.slack > 0.0) prefer_face(p, limit, axis);
    return true;
}

/// Contacts on the face of A that is most nearly across `axis`, if one is, and if what touches it
/// attains the separation: along the face's normal, turned by an angle t from the axis, the same
/// two places are separation / cos t apart.
template <int Dim>
bool add_face_contacts(const CorePair<Dim>& p, const Vector<Dim>& axis, double separation,
                       double limit, const ContactSink<Dim>& sink) {
    const double angle = p.rounding() > 0.0 ? NarrowPhaseTolerance::alignment_rounded
                                            : NarrowPhaseTolerance::alignment;
    double cosine = 1.0 - 0.5 * angle * angle;
    std::size_t face = p.a.face_count();
    for (std::size_t f = 0; f < p.a.face_count(); ++f) {
        const double c = -axis.dot(p.a.normals[f]);
        if (c >= cosine) cosine = c, face = f;
    }
    if (face == p.a.face_count()) return false;
    const double least_gap = FaceContacts<Dim>(p, face, limit, sink).add();
    if (std::abs(least_gap * cosine - separation) <= p.preference()) return true;
    sink.out.resize(sink.first, ContactPoint<Dim>{});
    return false;
}

}  // namespace detail

/// Contacts of two rounded cores: the best axis; then, in this order of preference, the contacts on
/// a face of A across it, on a face of B, or of edges and vertices. Cores of rounded coordinates
/// touch already when they are nearer than their slack, so that faces put on each other do so all
/// over.
template <int Dim>
void append_core_contacts(const CoreView<Dim>& a, const Pose<Dim>& pose_a, const CoreView<Dim>& b,
                          const Pose<Dim>& pose_b, double margin, Column<ContactPoint<Dim>>& out) {
    const CorePair<Dim> p(a, pose_a, b, pose_b);
    const double limit = margin + p.rounding() + p.slack;
    SeparatingAxis<Dim> axis;
    if (!detail::find_axis(p, limit, axis)) return;
    const ContactSink<Dim> sink{out, out.size(), pose_a};
    if (detail::add_face_contacts<Dim>(p, axis.normal, axis.separation, limit, sink)) return;
    const CorePair<Dim> q = p.exchanged();
    const ContactSink<Dim> exchanged{out, sink.first, pose_b, true};
    const Vector<Dim> axis_in_b = -p.direction_in_b(axis.normal);
    if (detail::add_face_contacts<Dim>(q, axis_in_b, axis.separation, limit, exchanged)) return;
    EdgeContacts<Dim>(p, axis, limit, sink).add();
}

}  // namespace talus

TALUS_IN_PLANE(void talus::append_core_contacts<2>(const talus::CoreView<2>&, const talus::Pose<2>&,
                                                   const talus::CoreView<2>&, const talus::Pose<2>&,
                                                   double, talus::Column<talus::ContactPoint<2>>&))
TALUS_IN_SPACE(void talus::append_core_contacts<3>(const talus::CoreView<3>&, const talus::Pose<3>&,
                                                   const talus::CoreView<3>&, const talus::Pose<3>&,
                                                   double, talus::Column<talus::ContactPoint<3>>&))
