// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace talus {

/// A face of a polyhedron: indices of its corners, counter-clockwise seen from outside.
using Face = std::vector<std::size_t>;

namespace detail {

/// The points on the plane through points[i], j, k, or nothing unless all others lie below it.
inline Face supported_by(std::span<const Vector<3>> points, const Vector<3>& origin,
                         const Vector<3>& normal, double tolerance) {
    Face face;
    for (std::size_t m = 0; m < points.size(); ++m) {
        const double height = normal.dot(points[m] - origin);
        if (height > tolerance) return {};
        if (height >= -tolerance) face.push_back(m);
    }
    return face;
}

inline void sort_around(Face& face, std::span<const Vector<3>> points, const Vector<3>& normal) {
    Vector<3> centre = Vector<3>::Zero();
    for (const auto m : face) centre += points[m] / static_cast<double>(face.size());
    const Vector<3> x = (points[face[0]] - centre).normalized();
    const Vector<3> y = normal.cross(x);
    std::sort(face.begin() + 1, face.end(), [&](std::size_t a, std::size_t b) {
        const auto angle = [&](std::size_t m) {
            const double t = std::atan2(y.dot(points[m] - centre), x.dot(points[m] - centre));
            return t < 0.0 ? t + 6.283185307179586 : t;
        };
        return angle(a) < angle(b);
    });
}

}  // namespace detail

/// Faces of the convex hull of a few points, coplanar triangles merged: every plane through three
/// points that leaves the others on one side. O(k^4) in the number of points, which suits grains of
/// up to some tens of corners and has no case to forget. Empty when the points are coplanar to
/// 1e-9 of their spread. A point that no face names is not a corner.
inline std::vector<Face> hull_faces(std::span<const Vector<3>> points) {
    double spread = 0.0;
    for (const auto& p : points) spread = std::max(spread, (p - points[0]).norm());
    const double tolerance = 1e-9 * spread;
    std::vector<Face> faces;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                Vector<3> n = (points[j] - points[i]).cross(points[k] - points[i]);
                if (n.norm() <= tolerance * spread) continue;
                n.normalize();
                for (const Vector<3>& normal : {n, Vector<3>(-n)}) {
                    Face face = detail::supported_by(points, points[i], normal, tolerance);
                    if (face.empty() || face.size() == points.size()) continue;
                    // A face of many corners is met by many triples: it is kept by its first.
                    const bool first = std::none_of(faces.begin(), faces.end(), [&](Face known) {
                        std::sort(known.begin(), known.end());
                        return known == face;
                    });
                    if (!first) continue;
                    detail::sort_around(face, points, normal);
                    faces.push_back(std::move(face));
                }
            }
    return faces;
}

/// Volume [m^3] and centroid [m] of the polyhedron with these faces.
struct SolidCentre {
    double volume = 0.0;
    Vector<3> centroid = Vector<3>::Zero();
};

/// Sums the tetrahedra between the first point and the triangles of the faces.
inline SolidCentre solid_centre(std::span<const Vector<3>> points, std::span<const Face> faces) {
    SolidCentre sum;
    for (const Face& face : faces)
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            const Vector<3> a = points[face[0]] - points[0];
            const Vector<3> b = points[face[i]] - points[0];
            const Vector<3> c = points[face[i + 1]] - points[0];
            const double volume = a.dot(b.cross(c)) / 6.0;
            sum.volume += volume;
            sum.centroid += volume * (a + b + c) / 4.0;
        }
    sum.centroid = points[0] + sum.centroid / sum.volume;
    return sum;
}

}  // namespace talus
