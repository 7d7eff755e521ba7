// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>

#if TALUS_BODIES
#include <talus/geometry/hull/coordinate_rounding.hpp>
#include <talus/geometry/hull/triangle_hull.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// A face as the loop of its corners, counter-clockwise seen from outside.
using VertexLoop = std::vector<std::uint32_t>;

/// How corners are read.
struct HullOptions {
    /// Each coordinate may be this far from what was meant [m], in [0, 1e-2] of the extent; without
    /// it what the digits of the coordinates say (coordinate_rounding), up to 1.25e-4 of the
    /// extent: numbers of three digits or less are more often exact than rounded.
    std::optional<double> rounding = std::nullopt;
    std::size_t first_index = 0;  ///< what complaints call the first vertex
};

/// Faces of a polygon (its sides) or polyhedron.
struct ConvexHull {
    std::vector<VertexLoop> faces;
    /// No vertex is farther above the plane of a face, no corner farther from it [m].
    double tolerance = 0.0;
    /// How far the surface may be from what was meant [m]: the tolerance, if it is that of rounded
    /// coordinates; where few digits may be exact, what the unevenness of the faces shows.
    double slack = 0.0;
};

/// Polyhedron with all these points as vertices. Triangles whose corners are in one plane to four
/// times the rounding of the coordinates (see HullOptions), at least to 1e-9 of their extent, are
/// one face. Each face begins at its smallest index; faces are in the order of their loops. A
/// vertex that lies in a face or on an edge to that tolerance is a corner of none. Throws
/// input_error naming the vertex that is not finite, coincides with another or lies deeper inside;
/// or when all lie in a plane. As costly as detail::TriangleHull and faces * vertices.
template <int Dim>
requires(Dim == 3) ConvexHull
    convex_hull(std::span<const Vector<Dim>> points, const HullOptions& options = {});

/// The same of points of which any may lie inside or coincide.
template <int Dim>
requires(Dim == 3) ConvexHull
    convex_hull_of_cloud(std::span<const Vector<Dim>> points, const HullOptions& options = {});

namespace detail {

inline std::string vertex_name(const HullOptions& options, std::size_t index) {
    return "vertex " + std::to_string(options.first_index + index);
}

/// Least height at which two vertices, or a vertex and a plane, are told apart, by the extent.
inline constexpr double coincident = 1e-9;

/// Checks the coordinates, returns their extent [m]: the largest distance from the first.
template <int Dim>
double extent_of(std::span<const Vector<Dim>> points, const HullOptions& options) {
    double extent = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        require_finite(vertex_name(options, i), points[i]);
        extent = std::max(extent, (points[i] - points[0]).norm());
    }
    if (extent > 0.0) require_in("extent of the vertices [m]", extent, 1e-90, 1e90);
    return extent;
}

}  // namespace detail

#if TALUS_BODIES
namespace detail {

struct HullTolerance {
    double value;     ///< of ConvexHull [m]
    double rounded;   ///< the part of it that the rounding asks for [m]
    bool few_digits;  ///< the coordinates may be exact

    /// ConvexHull::slack, when `used` was the tolerance in the end.
    double slack(double unevenness, double used, double extent) const {
        double slack = std::min(used, rounded);
        if (few_digits) slack = std::min(slack, 16.0 * unevenness);
        return slack > 0.1 * coincident * extent ? slack : 0.0;
    }
};
template <int Dim>
HullTolerance hull_tolerance(std::span<const Vector<Dim>> points, double extent,
                             const HullOptions& options) {
    constexpr double most = 1.25e-4;
    const double rounding = options.rounding ? require_in("rounding of the vertices [m]",
                                                          *options.rounding, 0.0, 1e-2 * extent)
                                             : coordinate_rounding<Dim>(points, most * extent);
    const bool few_digits = !options.rounding && rounding > most * extent;
    const double rounded = 4.0 * (few_digits ? most * extent : rounding);
    return {std::max(coincident * extent, rounded), rounded, few_digits};
}

/// Joins the triangles of a hull that lie in one plane to a tolerance.
template <int Dim>
requires(Dim == 3) class FaceMerger {
  public:
    FaceMerger(std::span<const Vector<Dim>> points,
               const std::vector<typename TriangleHull<Dim>::Triangle>& triangles, double tolerance)
        : points_(points), triangles_(triangles), tolerance_(tolerance) {
        for (const auto& t : triangles_) {
            const Vector<Dim>& a = points_[t.corners[0]];
            areas_.push_back((points_[t.corners[1]] - a).cross(points_[t.corners[2]] - a));
            for (const std::uint32_t v : t.corners) surface_.push_back(v);
        }
        std::ranges::sort(surface_);
        surface_.erase(std::unique(surface_.begin(), surface_.end()), surface_.end());
    }

    /// The loops of the faces; nothing if they make no polyhedron with every vertex below every
    /// face to the tolerance, which then is too large for this body.
    std::optional<std::vector<VertexLoop>> faces() {
        grow_all();
        for (std::size_t trial = 0; trial <= triangles_.size(); ++trial) {
            auto loops = outlines();
            if (!loops) return std::nullopt;
            if (dissolve_degenerate(*loops)) continue;
            if (!fits(*loops)) return std::nullopt;
            return loops;
        }
        return std::nullopt;
    }

  private:
    static constexpr std::uint32_t none = 0xffffffffu;
    /// A triangle joins a face if its normal has at least this cosine with the face's.
    static constexpr double same_side = 0.1;

    /// Largest triangles first, as they have the most accurate planes.
    void grow_all() {
        group_.assign(triangles_.size(), none);
        std::vector<std::uint32_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, [&](std::uint32_t s, std::uint32_t t) {
            return areas_[s].squaredNorm() > areas_[t].squaredNorm();
        });
        visited_.assign(triangles_.size(), none);
        group_count_ = 0;
        for (const std::uint32_t seed : order)
            if (group_[seed] == none) {
                for (const std::uint32_t t : grown(seed)) group_[t] = group_count_;
                ++group_count_;
            }
    }
    /// The triangles around `seed` in one plane. The plane is fitted anew to what it reaches, first
    /// with a larger tolerance since that of a small triangle is inaccurate far from it.
    std::vector<std::uint32_t> grown(std::uint32_t seed) {
        std::vector<std::uint32_t> members{seed};
        for (int round = 0; round < 12; ++round) {
            auto next = reached(seed, fitted(members), (round < 6 ? 1.5 : 1.0) * tolerance_);
            if (next.size() == members.size() && round >= 6) break;
            members = std::move(next);
            if (members.size() == 1) break;
        }
        return members;
    }
    Plane<Dim> fitted(const std::vector<std::uint32_t>& members) const {
        Plane<Dim> plane;
        for (const std::uint32_t t : members) plane.normal += areas_[t];
        plane.normal.normalize();
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t t : members)
            for (const std::uint32_t v : triangles_[t].corners) {
                low = std::min(low, plane.normal.dot(points_[v]));
                high = std::max(high, plane.normal.dot(points_[v]));
            }
        plane.offset = 0.5 * (low + high);
        return plane;
    }
    std::vector<std::uint32_t> reached(std::uint32_t seed, const Plane<Dim>& plane,
                                       double tolerance) {
        std::vector<std::uint32_t> members{seed};
        ++visit_;
        visited_[seed] = visit_;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const std::uint32_t t : triangles_[members[i]].neighbours) {
                if (visited_[t] == visit_ || group_[t] != none) continue;
                visited_[t] = visit_;
                const bool lies_in =
                    (areas_[t].dot(plane.normal) > same_side * areas_[t].norm() || is_sliver(t)) &&
                    std::ranges::all_of(triangles_[t].corners, [&](std::uint32_t v) {
                        return std::abs(plane.height(points_[v])) <= tolerance;
                    });
                if (lies_in) members.push_back(t);
            }
        return members;
    }

    /// Whether the triangle is so narrow that its normal is that of the rounding.
    bool is_sliver(std::uint32_t t) const {
        double longest = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, (points_[triangles_[t].corners[k]] -
                                         points_[triangles_[t].corners[(k + 1) % 3]])
                                            .norm());
        return areas_[t].norm() <= tolerance_ * longest;
    }

    /// The outline of each group, without the vertices where fewer than three groups meet; nothing
    /// if one is not a simple loop.
    std::optional<std::vector<VertexLoop>> outlines() const {
        struct Side {
            std::uint32_t group, tail, head;
            auto operator<=>(const Side&) const = default;
        };
        std::vector<Side> sides;
        std::vector<int> meeting(points_.size(), 0);
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (group_[triangles_[t].neighbours[k]] != group_[t]) {
                    sides.push_back(
                        {group_[t], triangles_[t].corners[k], triangles_[t].corners[(k + 1) % 3]});
                    ++meeting[triangles_[t].corners[k]];
                }
        std::ranges::sort(sides);
        std::vector<VertexLoop> loops(group_count_);
        for (auto from = sides.begin(); from != sides.end();) {
            const auto to = std::find_if(from, sides.end(),
                                         [&](const Side& s) { return s.group != from->group; });
            std::size_t walked = 0;
            auto at = from;
            do {
                if (meeting[at->tail] >= 3) loops[from->group].push_back(at->tail);
                const auto next = std::lower_bound(from, to, Side{from->group, at->head, 0});
                if (next == to || next->tail != at->head) return std::nullopt;
                at = next;
            } while (at != from && ++walked < sides.size());
            if (walked + 1 != static_cast<std::size_t>(to - from)) return std::nullopt;
            from = to;
        }
        return loops;
    }
    /// Gives the groups with fewer than three corners, whose vertices are all near one edge, to the
    /// groups beyond their longest sides. Returns whether there were any.
    bool dissolve_degenerate(const std::vector<VertexLoop>& loops) {
        std::vector<std::uint32_t> into(group_count_, none);
        std::vector<double> longest(group_count_, -1.0);
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t k = 0; k < 3 && loops[group_[t]].size() < 3; ++k) {
                const auto& c = triangles_[t].corners;
                const std::uint32_t g = group_[t], beyond = group_[triangles_[t].neighbours[k]];
                const double length = (points_[c[(k + 1) % 3]] - points_[c[k]]).norm();
                if (beyond != g && length > longest[g]) into[g] = beyond, longest[g] = length;
            }
        // Of two that would change places the second waits for the next round.
        std::vector<bool> taken(group_count_, false);
        std::vector<std::uint32_t> name(group_count_, none);
        for (std::uint32_t g = 0; g < group_count_; ++g)
            if (into[g] != none && !taken[g] && name[into[g]] == none) {
                name[g] = into[g];
                taken[into[g]] = true;
            }
        std::vector<std::uint32_t> number(group_count_, none);
        std::uint32_t count = 0;
        for (std::uint32_t g = 0; g < group_count_; ++g)
            if (name[g] == none) number[g] = count++;
        if (count == group_count_) return false;
        for (std::uint32_t& g : group_) g = number[name[g] == none ? g : name[g]];
        group_count_ = count;
        return true;
    }

    bool fits(const std::vector<VertexLoop>& loops) const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
        std::vector<bool> corner(points_.size(), false);
        for (const VertexLoop& loop : loops)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                sides.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
                corner[loop[k]] = true;
            }
        const auto corners = static_cast<std::size_t>(std::ranges::count(corner, true));
        std::ranges::sort(sides);
        if (loops.size() < 4 || 2 * (corners + loops.size() - 2) != sides.size()) return false;
        for (std::size_t k = 0; k < sides.size(); ++k)
            if ((k > 0 && sides[k] == sides[k - 1]) ||
                !std::ranges::binary_search(sides, std::pair(sides[k].second, sides[k].first)))
                return false;
        std::vector<std::size_t> triangle_count(loops.size(), 0);
        for (const std::uint32_t g : group_) ++triangle_count[g];
        return std::ranges::all_of(loops, [&](const VertexLoop& loop) {
            // A triangle of the hull has nothing above it.
            if (triangle_count[static_cast<std::size_t>(&loop - loops.data())] == 1) return true;
            const Plane<Dim> plane = plane_of<Dim>(points_, loop);
            return std::ranges::all_of(
                       surface_, [&](auto v) { return plane.height(points_[v]) <= tolerance_; }) &&
                   std::ranges::all_of(loop, [&](std::uint32_t v) {
                       return plane.height(points_[v]) >= -tolerance_;
                   });
        });
    }

    std::span<const Vector<Dim>> points_;
    const std::vector<typename TriangleHull<Dim>::Triangle>& triangles_;
    double tolerance_;
    std::vector<Vector<Dim>> areas_;      ///< twice the area of each triangle, outwards [m^2]
    std::vector<std::uint32_t> surface_;  ///< the corners of triangles
    std::vector<std::uint32_t> group_, visited_;
    std::uint32_t group_count_ = 0, visit_ = 0;
};

}  // namespace detail

template <int Dim>
requires(Dim == 3) ConvexHull
    convex_hull_of_cloud(std::span<const Vector<Dim>> points, const HullOptions& options) {
    if (points.size() < 4 || points.size() > 0xffffffffu)
        detail::reject("vertex count", static_cast<double>(points.size()), "at least 4");
    const double extent = detail::extent_of(points, options);
    const detail::TriangleHull<Dim> hull(points, detail::coincident * extent);
    ConvexHull result;
    // A body no thicker than the rounding of its corners tells it was not rounded so much.
    auto tolerance = detail::hull_tolerance<Dim>(points, extent, options);
    result.tolerance = std::min(tolerance.value, hull.height() / 16.0);
    tolerance.few_digits |= result.tolerance < tolerance.value;
    std::optional<std::vector<VertexLoop>> loops;
    while (!loops && result.tolerance > 1e-12 * extent) {
        loops = detail::FaceMerger<Dim>(points, hull.triangles(), result.tolerance).faces();
        if (!loops) result.tolerance *= 0.7;
    }
    if (loops)
        result.faces = std::move(*loops);
    else
        for (const auto& t : hull.triangles())
            result.faces.emplace_back(t.corners.begin(), t.corners.end());
    double unevenness = 0.0;
    for (VertexLoop& loop : result.faces) {
        std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
        const detail::Plane<Dim> plane = detail::plane_of<Dim>(points, loop);
        for (const std::uint32_t v : loop)
            unevenness = std::max(unevenness, std::abs(plane.height(points[v])));
    }
    std::ranges::sort(result.faces);
    result.slack = tolerance.slack(unevenness, result.tolerance, extent);
    return result;
}

template <int Dim>
requires(Dim == 3) ConvexHull
    convex_hull(std::span<const Vector<Dim>> points, const HullOptions& options) {
    const double flat = detail::coincident * detail::extent_of(points, options);
    // Along one axis, coincident points are neighbours.
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(points[i][0], i); });
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const auto [i, j] = std::minmax(order[a], order[b]);
            if (points[order[b]][0] - points[order[a]][0] > flat) break;
            if ((points[i] - points[j]).norm() <= flat)
                throw input_error(detail::vertex_name(options, j) + " coincides with " +
                                  detail::vertex_name(options, i) +
                                  ", but the vertices must be distinct");
        }
    ConvexHull hull = convex_hull_of_cloud(points, options);
    std::vector<bool> corner(points.size(), false);
    std::vector<detail::Plane<Dim>> planes;
    for (const VertexLoop& loop : hull.faces) {
        planes.push_back(detail::plane_of<Dim>(points, loop));
        for (const std::uint32_t v : loop) corner[v] = true;
    }
    const auto depth_of = [&](const Vector<Dim>& x) {
        double depth = std::numeric_limits<double>::infinity();
        for (const auto& plane : planes) depth = std::min(depth, -plane.height(x));
        return depth;
    };
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const double depth = corner[i] ? 0.0 : depth_of(points[i]);
            depth > 2.0 * hull.tolerance)
            throw input_error(detail::vertex_name(options, i) +
                              " is no corner of the convex hull but " + detail::text_of(depth) +
                              " m inside it, and must be at most " +
                              detail::text_of(2.0 * hull.tolerance) + " m inside");
    return hull;
}
#endif

}  // namespace talus

TALUS_IN_LIBRARY(talus::ConvexHull talus::convex_hull<3>(std::span<const talus::Vector<3>>,
                                                         const talus::HullOptions&))
TALUS_IN_LIBRARY(talus::ConvexHull talus::convex_hull_of_cloud<3>(std::span<const talus::Vector<3>>,
                                                                  const talus::HullOptions&))
