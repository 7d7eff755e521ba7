// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/geometry/hull/convex_hull.hpp>

#include <span>

namespace talus {

/// Volume [m^3] and centroid [m] of the polyhedron with these faces.
struct SolidCentre {
    double volume = 0.0;
    Vector<3> centroid = Vector<3>::Zero();
};

/// Sums the tetrahedra between the first point and the triangles of the faces.
inline SolidCentre solid_centre(std::span<const Vector<3>> points,
                                std::span<const VertexLoop> faces) {
    SolidCentre sum;
    for (const VertexLoop& face : faces)
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
