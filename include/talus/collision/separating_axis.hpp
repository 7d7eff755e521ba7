// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/core_pair.hpp>

#include <array>
#include <limits>

namespace talus {

/// A direction and how far two cores are apart along it:
/// separation(n) = min over A of n.x - max over B of n.x, negative when they overlap there.
template <int Dim>
struct SeparatingAxis {
    Vector<Dim> normal = Vector<Dim>::Zero();  ///< unit, from B towards A, in the frame of A
    double separation = -std::numeric_limits<double>::infinity();  ///< [m]
    Vector<Dim> point_a = Vector<Dim>::Zero();  ///< on A, where the separation is attained [m]
    Vector<Dim> point_b = Vector<Dim>::Zero();  ///< on B, likewise [m]
};

namespace detail {

/// Keeps `axis` unless the new separation is better by the tolerance of preference [m].
template <int Dim>
bool improves(const SeparatingAxis<Dim>& axis, double separation, double preference) {
    return separation > axis.separation + preference ||
           axis.separation == -std::numeric_limits<double>::infinity();
}

/// Tries the normals of A's faces; `sign` is +1 if A is A, -1 if the two are exchanged. The axis is
/// given in the frame of p.a. Returns false as soon as the cores are more than `limit` apart.
template <int Dim>
bool try_faces(const CorePair<Dim>& p, double limit, SeparatingAxis<Dim>& axis) {
    for (std::size_t f = 0; f < p.a.face_count(); ++f) {
        const Vector<Dim>& m = p.a.normals[f];
        const Vector<Dim> down = p.direction_in_b(-m);
        const Vector<Dim>& lowest = p.b.vertices[support_index(p.b, down)];
        const double s = m.dot(p.shift) - down.dot(lowest) - p.a.offsets[f];
        if (s > limit) return false;
        if (improves(axis, s, p.preference())) {
            const Vector<Dim> b = p.in_a(lowest);
            axis = {-m, s, b - s * m, b};
        }
    }
    return true;
}

/// An edge in the frame of A, with the normals of the faces beside it.
struct PlacedEdge {
    Vector<3> tail, direction, left, right;
    bool bare;  ///< of a segment: no faces
};

inline PlacedEdge placed_edge(const CoreView<3>& core, const CoreEdge& e) {
    const Vector<3> tail = core.vertices[e.tail];
    PlacedEdge result{tail, core.vertices[e.head] - tail, Vector<3>::Zero(), Vector<3>::Zero(),
                      e.left == CoreEdge::none};
    if (!result.bare) result.left = core.normals[e.left], result.right = core.normals[e.right];
    return result;
}

/// Whether the two edges span a face of the Minkowski difference: their arcs on the Gauss map, of A
/// and of -B, cross [Gregorius2013]. The arc of a bare edge is the whole circle across it.
inline bool arcs_cross(const PlacedEdge& a, const PlacedEdge& b) {
    const double c = -b.left.dot(a.direction), d = -b.right.dot(a.direction);
    if (!b.bare && c * d >= 0.0) return false;
    const double e = a.left.dot(b.direction), f = a.right.dot(b.direction);
    if (!a.bare && e * f >= 0.0) return false;
    return a.bare || b.bare || c * f > 0.0;
}

/// Unit normal of both edges from B to A; zero if they are parallel within 1e-5 rad, when faces do
/// as well.
inline Vector<3> edge_normal(const PlacedEdge& a, const PlacedEdge& b, const Vector<3>& apart) {
    const Vector<3> n = a.direction.cross(b.direction);
    const double n2 = n.squaredNorm();
    if (!(n2 > 1e-10 * a.direction.squaredNorm() * b.direction.squaredNorm()))
        return Vector<3>::Zero();
    const double side = !b.bare   ? n.dot(b.left + b.right)
                        : !a.bare ? -n.dot(a.left + a.right)
                                  : n.dot(apart);
    return (side < 0.0 ? -1.0 : 1.0) / std::sqrt(n2) * n;
}

/// Points of two lines where they are nearest.
inline void set_nearest_points_of_lines(const PlacedEdge& a, const PlacedEdge& b,
                                        SeparatingAxis<3>& axis) {
    const Vector<3> across_b = b.direction.cross(axis.normal);
    const double t = (b.tail - a.tail).dot(across_b) / a.direction.dot(across_b);
    axis.point_a = a.tail + t * a.direction;
    axis.point_b = axis.point_a - axis.separation * axis.normal;
}

/// Whether a direction at this edge can beat `least`: n.toward for n on the edge's arc, which is at
/// most the larger of the values at the arc's ends over the cosine of half its angle.
inline bool can_reach(const CoreView<3>& core, const CoreEdge& e, const Vector<3>& toward,
                      double least) {
    if (e.left == CoreEdge::none || least <= 0.0) return true;
    const Vector<3>&l = core.normals[e.left], &r = core.normals[e.right];
    const double most = std::max(toward.dot(l), toward.dot(r));
    return most > 0.0 && 2.0 * most >= least * (l + r).norm();
}

/// Whether nothing of A is below, nothing of B above the planes through the two edges across `n`,
/// to the tolerance of preference. Edges of flat faces answer it by their arcs alone.
inline bool supports(const CorePair<3>& p, const Vector<3>& n, double separation) {
    return p.slack == 0.0 || n.dot(p.support(-n).difference()) >= separation - p.preference();
}

inline bool try_edge_pair(const CorePair<3>& p, const PlacedEdge& a, const PlacedEdge& b,
                          const Vector<3>& apart, double limit, SeparatingAxis<3>& axis) {
    if (!arcs_cross(a, b)) return true;
    const Vector<3> n = edge_normal(a, b, apart);
    if (n.isZero(0.0)) return true;
    const double s = n.dot(a.tail - b.tail);
    const bool better = improves(axis, s, p.preference());
    if ((!(s > limit) && !better) || !supports(p, n, s)) return true;
    if (s > limit + p.slack) return false;
    if (better) {
        axis.normal = n;
        axis.separation = s;
        set_nearest_points_of_lines(a, b, axis);
    }
    return true;
}

/// Tries the pairs of edges. A ball inside each core makes separation(n) at most
/// n.(centre A - centre B) minus both radii: edges that cannot beat the axis so far are left out.
inline bool try_edges(const CorePair<3>& p, double limit, SeparatingAxis<3>& axis) {
    constexpr std::size_t batch = 32;
    const Vector<3> apart = p.a.centre - p.in_a(p.b.centre);
    const Vector<3> apart_b = p.direction_in_b(apart);
    const double least = axis.separation + p.a.inner + p.b.inner;
    std::array<PlacedEdge, batch> edges;
    for (std::size_t next = 0; next < p.a.edges.size();) {
        std::size_t count = 0;
        for (; next < p.a.edges.size() && count < batch; ++next)
            if (can_reach(p.a, p.a.edges[next], -apart, least))
                edges[count++] = placed_edge(p.a, p.a.edges[next]);
        for (const CoreEdge& e : p.b.edges) {
            if (!can_reach(p.b, e, apart_b, least)) continue;
            PlacedEdge b = placed_edge(p.b, e);
            b = {p.in_a(b.tail), p.rotation * b.direction, p.rotation * b.left,
                 p.rotation * b.right, b.bare};
            for (std::size_t i = 0; i < count; ++i)
                if (!try_edge_pair(p, edges[i], b, apart, limit, axis)) return false;
        }
    }
    return true;
}

/// For cores without faces and with parallel edges or none, on top of each other: any direction
/// across A's edge, or across B's, or the last axis.
template <int Dim>
Vector<Dim> any_axis(const CorePair<Dim>& p) {
    if constexpr (Dim == 3) {
        if (!p.a.edges.empty()) return placed_edge(p.a, p.a.edges[0]).direction.unitOrthogonal();
        if (!p.b.edges.empty())
            return p.rotation * placed_edge(p.b, p.b.edges[0]).direction.unitOrthogonal();
    }
    return Vector<Dim>::Unit(Dim - 1);
}

}  // namespace detail

/// The axis of largest separation among the normals of the faces of A, of B and, in space, of pairs
/// of edges that can carry it: for overlapping cores the shortest way apart. Returns false, with
/// the axis undefined, when the cores are more than `limit` [m] apart along one of them.
/// O(faces * vertices + edges^2).
template <int Dim>
bool find_separating_axis(const CorePair<Dim>& p, double limit, SeparatingAxis<Dim>& axis) {
    axis = {};
    if (!detail::try_faces(p, limit, axis)) return false;
    SeparatingAxis<Dim> of_b;
    const CorePair<Dim> q = p.exchanged();
    if (!detail::try_faces(q, limit, of_b)) return false;
    if (q.a.face_count() > 0 && detail::improves(axis, of_b.separation, p.preference()))
        axis = {-(p.rotation * of_b.normal), of_b.separation, p.in_a(of_b.point_b),
                p.in_a(of_b.point_a)};
    if constexpr (Dim == 3)
        if (!detail::try_edges(p, limit, axis)) return false;
    if (axis.normal.isZero(0.0)) {
        axis.normal = detail::any_axis(p);
        const DifferencePoint<Dim> lowest = p.support(-axis.normal);
        axis.point_a = lowest.a;
        axis.separation = axis.normal.dot(lowest.difference());
        axis.point_b = lowest.a - axis.separation * axis.normal;
    }
    return true;
}

}  // namespace talus
