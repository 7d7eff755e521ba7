// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/polygon.hpp>
#include <talus/sample/random.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus {

/// How random polygons look.
struct RandomPolygonParams {
    int fewest_vertices = 4;   ///< in [3, 64]; 4 avoids the sharpest corners
    int most_vertices = 8;     ///< in [fewest, 64]; beyond 8 they are hard to tell from discs
    double regularity = 0.35;  ///< smallest over largest angle drawn, over one minus itself [-]
    double eccentricity =
        0.25;  ///< largest distance from circumcentre to centroid, over radius [-]
};

/// Convex polygon with corners on a circle at random angles: counter-clockwise, centroid on the
/// origin, farthest corner at `radius` [m]. Those whose centroid is far from the centre of the
/// circle (slivers and half-moons) are drawn again.
inline std::vector<Vector<2>> random_polygon(Random& random, double radius,
                                             const RandomPolygonParams& params = {}) {
    require_positive("radius of a polygon [m]", radius);
    require_in("fewest vertices of a polygon", params.fewest_vertices, 3, 64);
    require_in("most vertices of a polygon", params.most_vertices, params.fewest_vertices, 64);
    require_in("regularity of polygons", params.regularity, 1e-3, 1e3);
    require_in("eccentricity of polygons", params.eccentricity, 0.05, 1.0);
    const auto on_circle = [&] {
        const int count = random.integer(params.fewest_vertices, params.most_vertices);
        std::vector<double> share(static_cast<std::size_t>(count));
        double angle = random.uniform(0.0, 2.0 * std::numbers::pi), sum = 0.0;
        for (double& s : share) sum += s = params.regularity + random.uniform();
        std::vector<Vector<2>> corners;
        for (const double s : share) {
            corners.emplace_back(std::cos(angle), std::sin(angle));
            angle += s / sum * 2.0 * std::numbers::pi;
        }
        return corners;
    };
    auto corners = on_circle();
    Vector<2> centre = centroid(corners);
    while (centre.norm() > params.eccentricity) {
        corners = on_circle();
        centre = centroid(corners);
    }
    for (auto& c : corners) c -= centre;
    const double scale = radius / bounding_radius<2>(corners);
    for (auto& c : corners) c *= scale;
    return corners;
}

}  // namespace talus
