// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace talus {

/// Twice the signed area of the triangle a, b, c [m^2]: positive when they turn left.
inline double turn(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Centroid of the polygon with these corners in order [m]. The area must not be zero.
inline Vector<2> centroid(std::span<const Vector<2>> corners) {
    double area = 0.0;
    Vector<2> sum = Vector<2>::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const double t = turn(corners[0], corners[i], corners[i + 1]);
        area += t;
        sum += t * (corners[i] + corners[i + 1] - 2.0 * corners[0]);
    }
    return corners[0] + sum / (3.0 * area);
}

/// Largest distance of a point from the origin [m].
template <int Dim>
double bounding_radius(const std::vector<Vector<Dim>>& points) {
    double r = 0.0;
    for (const auto& p : points) r = std::max(r, p.norm());
    return r;
}

}  // namespace talus
