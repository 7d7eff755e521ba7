// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace talus {

/// A point of A minus a point of B, with both remembered.
template <int Dim>
struct DifferencePoint {
    Vector<Dim> a, b;
    Vector<Dim> difference() const { return a - b; }
};

/// Nearest points of two convex sets.
template <int Dim>
struct NearestPoints {
    Vector<Dim> a, b;       ///< on A, on B
    Vector<Dim> apart;      ///< a - b
    double distance = 0.0;  ///< |apart|; zero when the sets overlap
};

namespace detail {

/// Simplex of difference points with the weights of its point nearest to the origin.
template <int Dim>
struct GjkSimplex {
    std::array<DifferencePoint<Dim>, Dim + 1> points;
    std::array<double, Dim + 1> weights{};
    std::size_t count = 0;

    Vector<Dim> w(std::size_t i) const { return points[i].difference(); }
    Vector<Dim> nearest() const {
        Vector<Dim> v = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < count; ++i) v += weights[i] * w(i);
        return v;
    }
    GjkSimplex part(std::initializer_list<std::size_t> which) const {
        GjkSimplex s;
        for (const std::size_t i : which) s.points[s.count++] = points[i];
        return s;
    }
    void set_weights(std::initializer_list<double> values) {
        std::ranges::copy(values, weights.begin());
    }
    /// Shifts weight along each side of a triangle in turn until the nearest point is at a right
    /// angle to it. In thin triangles the weights' rounding moves the point far along the triangle.
    void improve_weights() {
        Vector<Dim> v = nearest();
        for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 1}, {1, 2}, {2, 0}}) {
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            const Vector<Dim> side = w(b) - w(a);
            const double t = -v.dot(side) / side.squaredNorm();
            if (!(weights[a] > t && weights[b] > -t)) continue;
            weights[a] -= t;
            weights[b] += t;
            v += t * side;
        }
    }
};

template <int Dim>
GjkSimplex<Dim> nearest_part_of_segment(GjkSimplex<Dim> s) {
    const Vector<Dim> a = s.w(0), ab = s.w(1) - a;
    const double along = -a.dot(ab), length2 = ab.squaredNorm();
    if (along >= length2)
        s = s.part({1});
    else if (along <= 0.0)
        s = s.part({0});
    if (s.count == 1)
        s.set_weights({1.0});
    else
        s.set_weights({1.0 - along / length2, along / length2});
    return s;
}

/// By the Voronoi regions of the triangle's corners and sides [Ericson2005, section 5.1.5].
template <int Dim>
GjkSimplex<Dim> nearest_part_of_triangle(GjkSimplex<Dim> s) {
    const Vector<Dim> a = s.w(0), b = s.w(1), c = s.w(2), ab = b - a, ac = c - a;
    double va = 0.0, vb = 0.0, vc = 0.0;
    if constexpr (Dim == 2) {
        const auto cross = [](const Vector<2>& x, const Vector<2>& y) {
            return x[0] * y[1] - x[1] * y[0];
        };
        const double n = cross(ab, ac);
        va = n * cross(b, c);
        vb = n * cross(c, a);
        vc = n * cross(a, b);
    } else {
        const Vector<3> n = ab.cross(ac);
        va = n.dot(b.cross(c));
        vb = n.dot(c.cross(a));
        vc = n.dot(a.cross(b));
    }
    if (va > 0.0 && vb > 0.0 && vc > 0.0) {
        const double sum = va + vb + vc;
        s.set_weights({va / sum, vb / sum, vc / sum});
        s.improve_weights();
        return s;
    }
    // The nearest point lies on the outline: on the side where it is nearest, which stays right
    // when the triangle is so thin that the signs above are rounding.
    GjkSimplex<Dim> best = nearest_part_of_segment(s.part({0, 1}));
    for (const auto& side : {s.part({0, 2}), s.part({1, 2})}) {
        const auto candidate = nearest_part_of_segment(side);
        if (candidate.nearest().squaredNorm() < best.nearest().squaredNorm()) best = candidate;
    }
    return best;
}

/// Of the faces that have the origin on their outer side the nearest; all points if there is none.
inline GjkSimplex<3> nearest_part_of_tetrahedron(const GjkSimplex<3>& s) {
    constexpr double flat = 1e-14;
    GjkSimplex<3> best = s;
    bool outside = false;
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    for (const auto& [i, j, k, opposite] : faces) {
        const Vector<3> p = s.w(i), n = (s.w(j) - p).cross(s.w(k) - p);
        const double height = n.dot(s.w(opposite) - p);
        // A flat tetrahedron holds nothing: the sign of its height is rounding.
        const double thick = flat * n.norm() * (s.w(opposite) - p).norm();
        if (std::abs(height) > thick && -n.dot(p) * height > 0.0) continue;
        const auto candidate = nearest_part_of_triangle(s.part({i, j, k}));
        if (!outside || candidate.nearest().squaredNorm() < best.nearest().squaredNorm())
            best = candidate;
        outside = true;
    }
    return best;
}

template <int Dim>
GjkSimplex<Dim> nearest_part(GjkSimplex<Dim> s) {
    if (s.count == 1) s.set_weights({1.0});
    if (s.count == 2) return nearest_part_of_segment(s);
    if (s.count == 3) return nearest_part_of_triangle(s);
    if constexpr (Dim == 3)
        if (s.count == 4) return nearest_part_of_tetrahedron(s);
    return s;
}

/// The same for a simplex that is known not to hold the origin, and whose part without its newest
/// point, the last, has been searched.
template <int Dim>
GjkSimplex<Dim> nearest_new_part(const GjkSimplex<Dim>& s) {
    if (s.count <= Dim) return nearest_part(s);
    if constexpr (Dim == 2) {
        const auto p = nearest_part_of_segment(s.part({0, 2})),
                   q = nearest_part_of_segment(s.part({1, 2}));
        return q.nearest().squaredNorm() < p.nearest().squaredNorm() ? q : p;
    } else {
        GjkSimplex<Dim> best = nearest_part_of_triangle(s.part({0, 1, 3}));
        for (const auto& face : {s.part({0, 2, 3}), s.part({1, 2, 3})}) {
            const auto candidate = nearest_part_of_triangle(face);
            if (candidate.nearest().squaredNorm() < best.nearest().squaredNorm()) best = candidate;
        }
        return best;
    }
}

}  // namespace detail

/// Nearest points of two convex sets known by support mapping [GilbertJohnsonKeerthi1988]:
/// `support(d)` gives the DifferencePoint of A's farthest point along d and B's farthest along -d.
/// `start` is a guess at the direction from B to A, `size` [m] the scale of the sets. Ends when the
/// bound |v|^2 - v.w proves the distance to 1e-14 relative, when nothing changes any more (for
/// polytopes always: their vertices are finitely many), or after `max_iterations`, which smooth
/// shapes far more eccentric than 1:100 may need to raise. Distances below 1e-14 size count as
/// overlap.
template <int Dim, class Support>
NearestPoints<Dim> nearest_points(const Support& support, const Vector<Dim>& start, double size,
                                  int max_iterations = 100) {
    detail::GjkSimplex<Dim> simplex;
    simplex.points[0] = support(-start);
    simplex.weights[0] = 1.0;
    simplex.count = 1;
    Vector<Dim> v = simplex.w(0);
    for (int k = 0; k < max_iterations; ++k) {
        const double v2 = v.squaredNorm();
        if (!(v2 > 1e-28 * size * size)) return {};
        const DifferencePoint<Dim> next = support(-v);
        const Vector<Dim> w = next.difference();
        if (v2 - v.dot(w) <= 1e-14 * v2) break;
        detail::GjkSimplex<Dim> grown = simplex;
        grown.points[grown.count++] = next;
        // All of the set has x.v >= w.v: if that is positive, no simplex holds the origin, and that
        // need not be asked of flat ones, where the answer is rounding.
        grown = v.dot(w) > 0.0 ? detail::nearest_new_part(grown) : detail::nearest_part(grown);
        if (grown.count == Dim + 1) return {};
        const Vector<Dim> nearer = grown.nearest();
        if (!(nearer.squaredNorm() < v2)) break;
        simplex = grown;
        v = nearer;
    }
    NearestPoints<Dim> result{Vector<Dim>::Zero(), Vector<Dim>::Zero(), v, v.norm()};
    for (std::size_t i = 0; i < simplex.count; ++i) {
        result.a += simplex.weights[i] * simplex.points[i].a;
        result.b += simplex.weights[i] * simplex.points[i].b;
    }
    return result;
}

}  // namespace talus
