// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/polygon.hpp>
#include <talus/sample/polyhedron.hpp>
#include <talus/sample/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace talus::detail {

/// Files carry nine digits; what is right to this part of a grain's radius is right.
inline constexpr double file_tolerance = 1e-6;

inline std::string vertex_name(std::size_t i) { return "vertex " + std::to_string(i + 1); }

/// What is wrong with these corners of a polygon relative to their centroid, or nothing.
inline std::string shape_complaint(const std::vector<Vector<2>>& v, double radius) {
    const std::size_t count = v.size();
    double area = 0.0, turned = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        area += 0.5 * turn(Vector<2>::Zero(), v[i], v[(i + 1) % count]);
    if (area <= file_tolerance * radius * radius)
        return "has the area " + text_of(area) +
               " m^2, but must be positive, its vertices counter-clockwise";
    for (std::size_t i = 0; i < count; ++i) {
        const Vector<2>&before = v[i], &corner = v[(i + 1) % count], &after = v[(i + 2) % count];
        const double bend = turn(before, corner, after);
        if (bend <= 1e-9 * radius * radius)
            return "is not strictly convex at " + vertex_name((i + 1) % count) +
                   ": every corner must turn left";
        const Vector<2> in = corner - before, out = after - corner;
        turned += std::atan2(bend, in.dot(out));
    }
    // A star turns left at every corner too, but goes round more than once.
    if (turned > 7.0) return "is not convex: its sides cross, but must go round once";
    if (const double off = centroid(v).norm(); off > file_tolerance * radius)
        return "has its centroid " + text_of(off) + " m from its position, but must have it there";
    return {};
}

/// What is wrong with these corners of a polyhedron relative to their centroid, or nothing.
inline std::string shape_complaint(const std::vector<Vector<3>>& v, double radius) {
    const auto faces = hull_faces(v);
    if (faces.empty()) return "is flat: its vertices must not lie in one plane";
    for (std::size_t i = 0; i < v.size(); ++i)
        if (std::none_of(faces.begin(), faces.end(), [i](const Face& f) {
                return std::find(f.begin(), f.end(), i) != f.end();
            }))
            return "is not convex: " + vertex_name(i) + " lies inside the hull of the others";
    const SolidCentre centre = solid_centre(v, faces);
    if (centre.volume <= file_tolerance * radius * radius * radius)
        return "has the volume " + text_of(centre.volume) + " m^3, but must be solid";
    if (centre.centroid.norm() > file_tolerance * radius)
        return "has its centroid " + text_of(centre.centroid.norm()) +
               " m from its position, but must have it there";
    return {};
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
    if (std::abs(reach - grain.radius) > file_tolerance * grain.radius)
        return "has the bounding radius " + text_of(grain.radius) +
               " m, but must have that of its farthest vertex, " + text_of(reach) + " m";
    return shape_complaint(grain.vertices, grain.radius);
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
    const double slack = file_tolerance * grain.radius;
    for (int i = 0; i < Dim; ++i) {
        const double from = grain.position[i] + low[i], to = grain.position[i] + high[i];
        if (from < -slack || to > box_size[i] + slack)
            return "spans " + text_of(from) + " to " + text_of(to) + " m along axis " +
                   std::to_string(i + 1) + ", but must stay in the box, in [0, " +
                   text_of(box_size[i]) + "]";
    }
    return {};
}

}  // namespace talus::detail
