// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace talus::detail {

// All here is of space: templates of one dimension, so that what no program calls is not compiled.

template <int Dim>
struct Plane {
    Vector<Dim> normal = Vector<Dim>::Zero();
    double offset = 0.0;
    double height(const Vector<Dim>& x) const { return normal.dot(x) - offset; }
};

/// The plane that ConvexCore gives a loop: along the sum of its triangles, through the mean corner.
template <int Dim>
Plane<Dim> plane_of(std::span<const Vector<Dim>> points, std::span<const std::uint32_t> loop) {
    Plane<Dim> plane;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
        plane.normal +=
            (points[loop[k]] - points[loop[0]]).cross(points[loop[k + 1]] - points[loop[0]]);
    plane.normal.normalize();
    for (const std::uint32_t v : loop) plane.offset += plane.normal.dot(points[v]);
    plane.offset /= static_cast<double>(loop.size());
    return plane;
}

/// Convex hull in space as triangles, counter-clockwise seen from outside: quickhull
/// [BarberDobkinHuhdanpaa1996] with exact decisions. The points are put on a grid of 2^-40 of their
/// extent, where the volume of a tetrahedron is a whole number of 128 bits; so the surface is
/// always closed and its corners are exactly the extreme points of the grid's. Each new corner
/// replaces the triangles that it sees or lies in the plane of, which makes no triangle flat.
/// O(n log n) for most inputs.
template <int Dim>
requires(Dim == 3) class TriangleHull {
  public:
    using Corners = std::array<std::uint32_t, 3>;
    /// Neighbour k lies across the side from corner k to corner k + 1.
    struct Triangle {
        Corners corners, neighbours;
    };

    /// Throws input_error when all points lie on a line or in a plane, to `flat` [m].
    TriangleHull(std::span<const Vector<Dim>> points, double flat) {
        put_on_grid(points);
        start(points, flat);
        for (std::uint32_t t = 0; t < all_.size(); ++t)
            while (all_[t].alive && !all_[t].above.empty()) add(farthest_above(t));
        collect();
    }

    const std::vector<Triangle>& triangles() const { return triangles_; }
    double height() const { return height_; }  ///< of the first, widest tetrahedron [m]

  private:
    __extension__ using Wide = __int128;
    using GridPoint = std::array<std::int64_t, 3>;
    static constexpr int bits = 40;

    struct Piece : Triangle {
        std::vector<std::uint32_t> above;  ///< points that see it and are not yet done
        bool alive = true, seen = false;
    };

    void put_on_grid(std::span<const Vector<Dim>> points) {
        Vector<Dim> low = points[0], high = points[0];
        for (const auto& p : points) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        double extent = 0.0;
        for (int k = 0; k < 3; ++k) extent = std::max(extent, high[k] - low[k]);
        const int exponent = extent > 0.0 ? bits - 1 - std::ilogb(extent) : 0;
        for (const auto& p : points) {
            GridPoint& g = grid_.emplace_back();
            for (int k = 0; k < 3; ++k)
                g[static_cast<std::size_t>(k)] = std::llround(std::ldexp(p[k] - low[k], exponent));
        }
    }

    /// Six times the volume of triangle and point, positive above: below 6 * 2^120.
    Wide volume(const Corners& t, std::uint32_t point) const {
        const GridPoint &o = grid_[point], &p = grid_[t[0]], &q = grid_[t[1]], &r = grid_[t[2]];
        std::array<Wide, 3> a, b, c;
        for (std::size_t k = 0; k < 3; ++k)
            a[k] = p[k] - o[k], b[k] = q[k] - o[k], c[k] = r[k] - o[k];
        return a[0] * (b[2] * c[1] - b[1] * c[2]) + a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[1] * c[0] - b[0] * c[1]);
    }

    /// Four points far apart; the first triangles and what lies above them.
    void start(std::span<const Vector<Dim>> points, double flat) {
        const auto farthest = [&](auto measure) {
            std::uint32_t best = 0;
            for (std::uint32_t p = 1; p < points.size(); ++p)
                if (measure(points[p]) > measure(points[best])) best = p;
            return best;
        };
        const std::uint32_t a = farthest([](const auto& x) { return -x[0]; });
        const Vector<Dim> o = points[a];
        const std::uint32_t b = farthest([&](const auto& x) { return (x - o).norm(); });
        const Vector<Dim> u = (points[b] - o).normalized();
        const std::uint32_t c = farthest([&](const auto& x) { return u.cross(x - o).norm(); });
        const Vector<Dim> n = u.cross(points[c] - o);
        if (!(n.norm() > flat))
            throw input_error("the vertices lie on a line, but must span a volume");
        const Vector<Dim> unit = n.normalized();
        const std::uint32_t d = farthest([&](const auto& x) { return std::abs(unit.dot(x - o)); });
        height_ = std::abs(unit.dot(points[d] - o));
        const Wide sign = volume({a, b, c}, d);
        if (!(height_ > flat) || sign == 0)
            throw input_error("the vertices lie flat in a plane, but must span a volume");
        const std::array<std::uint32_t, 4> v =
            sign < 0 ? std::array{a, b, c, d} : std::array{a, c, b, d};
        all_.push_back({{{v[0], v[1], v[2]}, {3, 1, 2}}, {}});
        all_.push_back({{{v[0], v[2], v[3]}, {0, 3, 2}}, {}});
        all_.push_back({{{v[0], v[3], v[1]}, {1, 3, 0}}, {}});
        all_.push_back({{{v[1], v[3], v[2]}, {2, 1, 0}}, {}});
        all_[0].neighbours = {2, 3, 1};
        for (std::uint32_t p = 0; p < points.size(); ++p) assign(p, 0);
        beside_.resize(points.size());
    }

    /// Puts the point on the list of a triangle from `first` on that it sees, if there is one.
    void assign(std::uint32_t p, std::size_t first) {
        for (std::size_t t = first; t < all_.size(); ++t)
            if (all_[t].alive && volume(all_[t].corners, p) > 0) {
                all_[t].above.push_back(p);
                return;
            }
    }

    std::pair<std::uint32_t, std::uint32_t> farthest_above(std::uint32_t t) const {
        const auto& above = all_[t].above;
        std::uint32_t best = above[0];
        Wide most = volume(all_[t].corners, best);
        for (const std::uint32_t p : above)
            if (const Wide v = volume(all_[t].corners, p); v > most) best = p, most = v;
        return {best, t};
    }

    /// Replaces the triangles that the point sees, or lies in the plane of, by the cone over their
    /// outline.
    void add(std::pair<std::uint32_t, std::uint32_t> point_and_triangle) {
        const auto [p, t] = point_and_triangle;
        struct Side {
            std::uint32_t tail, head, outer;
        };
        std::vector<Side> outline;
        std::vector<std::uint32_t> seen{t};
        all_[t].seen = true;
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (const std::uint32_t s : all_[seen[i]].neighbours)
                if (!all_[s].seen && volume(all_[s].corners, p) >= 0) {
                    all_[s].seen = true;
                    seen.push_back(s);
                }
        for (const std::uint32_t s : seen)
            for (std::size_t k = 0; k < 3; ++k)
                if (const std::uint32_t outer = all_[s].neighbours[k]; !all_[outer].seen)
                    outline.push_back({all_[s].corners[k], all_[s].corners[(k + 1) % 3], outer});
        const std::size_t first = all_.size();
        for (const Side& side : outline) {
            const auto index = static_cast<std::uint32_t>(all_.size());
            beside_[side.tail] = index;
            all_.push_back({{{side.tail, side.head, p}, {side.outer, 0, 0}}, {}});
            auto& outer = all_[side.outer];
            for (std::size_t k = 0; k < 3; ++k)
                if (outer.corners[k] == side.head && outer.corners[(k + 1) % 3] == side.tail)
                    outer.neighbours[k] = index;
        }
        for (std::size_t i = first; i < all_.size(); ++i) {
            const std::uint32_t next = beside_[all_[i].corners[1]];
            all_[i].neighbours[1] = next;
            all_[next].neighbours[2] = static_cast<std::uint32_t>(i);
        }
        for (const std::uint32_t s : seen) {
            all_[s].alive = false;
            for (const std::uint32_t q : all_[s].above)
                if (q != p) assign(q, first);
            all_[s].above = {};
        }
    }

    void collect() {
        std::vector<std::uint32_t> number(all_.size());
        for (std::size_t t = 0; t < all_.size(); ++t)
            if (all_[t].alive) {
                number[t] = static_cast<std::uint32_t>(triangles_.size());
                triangles_.push_back(all_[t]);
            }
        for (Triangle& t : triangles_)
            for (std::uint32_t& n : t.neighbours) n = number[n];
        all_ = {};
    }

    std::vector<GridPoint> grid_;
    std::vector<Piece> all_;
    std::vector<std::uint32_t> beside_;  ///< new triangle at the tail of an outline's side
    std::vector<Triangle> triangles_;
    double height_ = 0.0;
};

}  // namespace talus::detail
