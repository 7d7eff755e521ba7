// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/input.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// A polygon as the loop of its vertices.
using VertexLoop = std::vector<std::uint32_t>;

namespace detail {

[[noreturn]] inline void reject_vertex(std::size_t index, const std::string& what) {
    throw input_error("vertex " + std::to_string(index) + " " + what);
}

/// Incremental convex hull in space. Triangles are counter-clockwise seen from outside.
class TriangleHull {
  public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// `rounding` [m]: a point no farther than this above a plane does not see it.
    TriangleHull(std::span<const Vector<3>> points, double rounding)
        : points_(points), rounding_(rounding) {
        const std::array<std::uint32_t, 4> first = widest_simplex();
        const auto [a, b, c, d] = first;
        triangles_ = {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
        for (std::uint32_t p = 0; p < points.size(); ++p)
            if (std::ranges::find(first, p) == first.end()) add(p);
    }

    const std::vector<Triangle>& triangles() const { return triangles_; }

    /// Height of a point above the plane of a triangle [m].
    double height(const Triangle& t, const Vector<3>& x) const {
        return normal(t).normalized().dot(x - points_[t[0]]);
    }
    /// Twice the area, along the outward normal [m^2].
    Vector<3> normal(const Triangle& t) const {
        return (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]);
    }

  private:
    template <class Measure>
    std::uint32_t farthest(Measure measure) const {
        std::uint32_t best = 0;
        for (std::uint32_t p = 1; p < points_.size(); ++p)
            if (measure(points_[p]) > measure(points_[best])) best = p;
        return best;
    }
    /// Four points far apart, positively oriented for the constructor's triangles.
    std::array<std::uint32_t, 4> widest_simplex() const {
        const std::uint32_t a = farthest([](const auto& x) { return -x[0]; });
        const Vector<3> o = points_[a];
        const std::uint32_t b = farthest([&](const auto& x) { return (x - o).norm(); });
        const Vector<3> u = (points_[b] - o).normalized();
        const std::uint32_t c = farthest([&](const auto& x) { return u.cross(x - o).norm(); });
        const Vector<3> n = u.cross(points_[c] - o);
        if (!(n.norm() > rounding_))
            throw input_error("the vertices lie on a line, but must span a volume");
        const Vector<3> unit = n.normalized();
        const std::uint32_t d = farthest([&](const auto& x) { return std::abs(unit.dot(x - o)); });
        const double height = unit.dot(points_[d] - o);
        if (!(std::abs(height) > 1e3 * rounding_))
            throw input_error("the vertices lie in a plane, but must span a volume");
        return height < 0.0 ? std::array{a, b, c, d} : std::array{a, c, b, d};
    }
    /// Replaces the triangles that point p sees by the cone from p over their outline.
    void add(std::uint32_t p) {
        std::vector<Triangle> kept, seen;
        for (const Triangle& t : triangles_)
            (height(t, points_[p]) > rounding_ ? seen : kept).push_back(t);
        if (seen.empty()) return;
        std::map<std::pair<std::uint32_t, std::uint32_t>, bool> sides;
        for (const Triangle& t : seen)
            for (std::size_t k = 0; k < 3; ++k) sides[{t[k], t[(k + 1) % 3]}] = true;
        for (const auto& [side, unused] : sides)
            if (!sides.contains({side.second, side.first}))
                kept.push_back({side.first, side.second, p});
        triangles_ = std::move(kept);
    }

    std::span<const Vector<3>> points_;
    double rounding_;
    std::vector<Triangle> triangles_;
};

/// Groups of triangles that lie in one plane: the group of each triangle, numbered in order.
inline std::vector<std::size_t> coplanar_groups(const TriangleHull& hull,
                                                std::span<const Vector<3>> points, double flat) {
    const auto& triangles = hull.triangles();
    std::vector<std::size_t> group(triangles.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) owner[{triangles[t][k], triangles[t][(k + 1) % 3]}] = t;
    const auto lies_in = [&](std::size_t s, std::size_t t) {
        return std::ranges::all_of(triangles[s], [&](std::uint32_t v) {
            return std::abs(hull.height(triangles[t], points[v])) <= flat;
        });
    };
    for (const auto& [side, t] : owner) {
        const auto other = owner.find({side.second, side.first});
        if (other == owner.end()) throw input_error("the vertices span no clear convex hull");
        const std::size_t s = other->second;
        // The larger triangle has the more accurate plane.
        const bool larger = hull.normal(triangles[t]).norm() >= hull.normal(triangles[s]).norm();
        if (group[s] != group[t] && (larger ? lies_in(s, t) : lies_in(t, s)))
            std::ranges::replace(group, std::max(group[s], group[t]), std::min(group[s], group[t]));
    }
    return group;
}

/// The outline of each group of triangles.
inline std::vector<VertexLoop> outlines(std::span<const TriangleHull::Triangle> triangles,
                                        std::span<const std::size_t> group) {
    std::map<std::size_t, std::map<std::uint32_t, std::uint32_t>> next;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            owner[{triangles[t][k], triangles[t][(k + 1) % 3]}] = group[t];
    for (const auto& [side, g] : owner)
        if (owner.at({side.second, side.first}) != g) next[g][side.first] = side.second;
    std::vector<VertexLoop> loops;
    for (const auto& [g, step] : next) {
        VertexLoop loop;
        std::uint32_t v = step.begin()->first;
        do {
            loop.push_back(v);
            v = step.at(v);
        } while (v != loop.front() && loop.size() <= step.size());
        loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace detail

/// Faces of the convex hull of `points`, every one of which must be a corner of it; triangles in
/// one plane are merged into polygons. Each face begins at its smallest index. Incremental
/// construction; two tolerances, relative to the extent of the points: a point sees a plane it is
/// 1e-12 above, and triangles whose corners are within 1e-9 of one plane are one face, so that
/// coordinates written with ten digits give the faces that were meant. Throws input_error naming
/// the vertex that is not finite, coincides with another or is no corner; or when all lie in a
/// plane. O(vertices * faces).
inline std::vector<VertexLoop> convex_hull_faces(std::span<const Vector<3>> points) {
    if (points.size() < 4)
        detail::reject("vertex count", static_cast<double>(points.size()), "at least 4");
    double extent = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        require_finite("vertex " + std::to_string(i), points[i]);
        extent = std::max(extent, (points[i] - points[0]).norm());
    }
    const double flat = 1e-9 * extent;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if ((points[i] - points[j]).norm() <= flat)
                detail::reject_vertex(i, "coincides with vertex " + std::to_string(j) +
                                             ", but the vertices must be distinct");
    const detail::TriangleHull hull(points, 1e-12 * extent);
    auto loops = detail::outlines(hull.triangles(), detail::coplanar_groups(hull, points, flat));
    std::vector<int> faces_at(points.size(), 0);
    for (const VertexLoop& loop : loops)
        for (const std::uint32_t v : loop) ++faces_at[v];
    for (std::size_t i = 0; i < points.size(); ++i)
        if (faces_at[i] < 3)
            detail::reject_vertex(i, "is no corner of the convex hull, but all vertices must be");
    return loops;
}

}  // namespace talus
