// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/polygon.hpp>
#include <talus/sample/polyhedron.hpp>
#include <talus/sample/random.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus {

/// How random polyhedra look.
struct RandomPolyhedronParams {
    int fewest_vertices = 8;  ///< in [6, 32]: fewer rarely hold a ball of the thickness below
    int most_vertices = 14;   ///< in [fewest, 32]
    double spread = 0.6;     ///< least chord between corners over that of even spacing, in [0, 0.7]
    double thickness = 0.4;  ///< least distance from centroid to a face, over radius, in [0, 0.5]
};

namespace detail {

/// Points on the unit sphere, none nearer to another than `chord`: darts thrown one by one. Empty
/// when a dart found no place, which too many darts before it may cause.
inline std::vector<Vector<3>> darts(Random& random, int count, double chord) {
    std::vector<Vector<3>> points;
    for (int thrown = 0; thrown < 50 * count; ++thrown) {
        if (points.size() == static_cast<std::size_t>(count)) return points;
        // Archimedes: height and longitude of a uniform point of the sphere are uniform.
        const double z = random.uniform(-1.0, 1.0);
        const double longitude = random.uniform(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(1.0 - z * z);
        const Vector<3> p(r * std::cos(longitude), r * std::sin(longitude), z);
        const bool free = std::all_of(points.begin(), points.end(),
                                      [&](const Vector<3>& q) { return (p - q).norm() >= chord; });
        if (free) points.push_back(p);
    }
    return {};
}

/// Least distance from `centre` to the planes of the faces.
inline double least_depth(std::span<const Vector<3>> points, std::span<const VertexLoop> faces,
                          const Vector<3>& centre) {
    double least = 2.0;
    for (const VertexLoop& f : faces) {
        const Vector<3>& a = points[f[0]];
        const Vector<3> normal = (points[f[1]] - a).cross(points[f[2]] - a).normalized();
        least = std::min(least, normal.dot(a - centre));
    }
    return least;
}

}  // namespace detail

/// Corners of a convex polyhedron, well spread on a sphere: centroid on the origin, farthest corner
/// at `radius` [m]. Thin ones are drawn again.
inline std::vector<Vector<3>> random_polyhedron(Random& random, double radius,
                                                const RandomPolyhedronParams& params = {}) {
    require_positive("radius of a polyhedron [m]", radius);
    require_in("fewest vertices of a polyhedron", params.fewest_vertices, 6, 32);
    require_in("most vertices of a polyhedron", params.most_vertices, params.fewest_vertices, 32);
    require_in("spread of the vertices of polyhedra", params.spread, 0.0, 0.7);
    require_in("thickness of polyhedra", params.thickness, 0.0, 0.5);
    for (;;) {
        const int count = random.integer(params.fewest_vertices, params.most_vertices);
        // An even share of the sphere's 4 pi is a hexagon, of chord sqrt(8 pi / (sqrt 3 count)).
        const double even = std::sqrt(8.0 * std::numbers::pi / (std::numbers::sqrt3 * count));
        auto corners = detail::darts(random, count, params.spread * even);
        if (corners.empty()) continue;
        const auto faces = convex_hull<3>(corners).faces;
        const Vector<3> centre = solid_centre(corners, faces).centroid;
        if (detail::least_depth(corners, faces, centre) < params.thickness) continue;
        for (auto& c : corners) c -= centre;
        const double scale = radius / bounding_radius<3>(corners);
        for (auto& c : corners) c *= scale;
        return corners;
    }
}

}  // namespace talus
