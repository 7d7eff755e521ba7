// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/hull/coordinate_rounding.hpp>
#include <talus/sample/polygon.hpp>
#include <talus/sample/polyhedron.hpp>
#include <talus/sample/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace talus::detail {

/// Files carry nine digits or more; what is right to this part of a grain's radius is right.
inline constexpr double file_tolerance = 1e-6;

inline std::string vertex_name(std::size_t i) { return "vertex " + std::to_string(i + 1); }

/// How far what follows from these corners may be off [m]: more than above, if their digits say so.
template <int Dim>
double grain_tolerance(const Grain<Dim>& grain) {
    const double rounding = coordinate_rounding<Dim>(grain.vertices);
    const bool may_be_exact = rounding > 2.5e-4 * grain.radius;  // as for HullOptions
    return std::max(file_tolerance * grain.radius, may_be_exact ? 0.0 : 4.0 * rounding);
}

inline std::string centroid_complaint(double off, double tolerance) {
    if (off <= tolerance) return {};
    return "has its centroid " + text_of(off) + " m from its position, but must have it within " +
           text_of(tolerance) + " m";
}

/// What is wrong with these corners of a polygon relative to their centroid, or nothing.
inline std::string shape_complaint(const std::vector<Vector<2>>& v, double tolerance) {
    double area = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i)
        area += 0.5 * turn(Vector<2>::Zero(), v[i], v[(i + 1) % v.size()]);
    if (area <= file_tolerance * v[0].squaredNorm())
        return "has the area " + text_of(area) +
               " m^2, but must be positive, its vertices counter-clockwise";
    try {
        convex_hull<2>(v, {.first_index = 1});
    } catch (const input_error& error) {
        return std::string("is not convex: ") + error.what();
    }
    return centroid_complaint(centroid(v).norm(), tolerance);
}

/// What is wrong with these corners of a polyhedron relative to their centroid, or nothing.
inline std::string shape_complaint(const std::vector<Vector<3>>& v, double tolerance) {
    try {
        const auto hull = convex_hull<3>(v, {.first_index = 1});
        return centroid_complaint(solid_centre(v, hull.faces).centroid.norm(), tolerance);
    } catch (const input_error& error) {
        return std::string("is not convex and solid: ") + error.what();
    }
}

/// What is wrong with a grain by itself, or nothing.
template <int Dim>
std::string grain_complaint(const Grain<Dim>& grain) {
    if (grain.is_ball()) return {};
    for (std::size_t j = 1; j < grain.vertices.size(); ++j)
        for (std::size_t i = 0; i < j; ++i)
            if ((grain.vertices[i] - grain.vertices[j]).norm() <= file_tolerance * grain.radius)
                return "has coincident vertices " + std::to_string(i + 1) + " and " +
                       std::to_string(j + 1) + ", but all must differ";
    const double reach = bounding_radius<Dim>(grain.vertices);
    const double tolerance = grain_tolerance(grain);
    if (!(std::abs(reach - grain.radius) <= tolerance))
        return "has the bounding radius " + text_of(grain.radius) +
               " m, but must have that of its farthest vertex, " + text_of(reach) + " m";
    return shape_complaint(grain.vertices, tolerance);
}

/// How a grain leaves the box, or nothing.
template <int Dim>
std::string box_complaint(const Grain<Dim>& grain, const Vector<Dim>& box_size) {
    Vector<Dim> low = Vector<Dim>::Constant(-grain.radius), high = -low;
    if (!grain.is_ball()) {
        low = high = grain.vertices[0];
        for (const auto& v : grain.vertices) {
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
    }
    const double slack = grain_tolerance(grain);
    for (int i = 0; i < Dim; ++i) {
        const double from = grain.position[i] + low[i], to = grain.position[i] + high[i];
        if (from < -slack || to > box_size[i] + slack)
            return "spans " + text_of(from) + " to " + text_of(to) + " m along axis " +
                   std::to_string(i + 1) + ", but must stay in the box, in [0, " +
                   text_of(box_size[i]) + "]";
    }
    return {};
}

/// How the mean radius of a scene that has grains is none of theirs, or nothing. What is meant by
/// the radius of a shape with corners may be the distance of its sides, half the width of a square:
/// a regular simplex, which has the farthest corners, reaches Dim times as far.
template <int Dim>
std::string mean_radius_complaint(const Scene<Dim>& scene) {
    constexpr double three_digits = 0.005;  // what they may leave off, of the number
    const auto [least, most] = std::ranges::minmax_element(scene.grains, {}, &Grain<Dim>::radius);
    const bool balls = least->is_ball();
    const double low = balls ? least->radius : least->radius / Dim, high = most->radius;
    if (scene.mean_radius >= (1.0 - three_digits) * low &&
        scene.mean_radius <= (1.0 + three_digits) * high)
        return {};
    return "is " + text_of(scene.mean_radius) + ", but must be in [" + text_of(low) + ", " +
           text_of(high) + "], from " + (balls ? "" : "1 / " + std::to_string(Dim) + " of ") +
           "the smallest radius to the largest";
}

}  // namespace talus::detail
