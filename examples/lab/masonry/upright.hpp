// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/spatial/pose.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lab {

// What stands upright and is the same in the plane and in space: along axis 0, up the last one, in
// space as deep as it is told along axis 1.

/// A point at x along, z up, in space in the middle of the depth [m].
template <int Dim>
talus::Vector<Dim> upright_point(double x, double z) {
    talus::Vector<Dim> point = talus::Vector<Dim>::Zero();
    point[0] = x;
    point[Dim - 1] = z;
    return point;
}

/// The vector of a turn, or of a spin, from the axis along towards the axis up [rad, rad/s].
template <int Dim>
talus::AngularVector<Dim> upright_turn(double angle) {
    talus::AngularVector<Dim> turn = talus::AngularVector<Dim>::Zero();
    turn[Dim == 2 ? 0 : 1] = Dim == 2 ? angle : -angle;
    return turn;
}

/// At a point, turned by that angle.
template <int Dim>
talus::Pose<Dim> upright_pose(double x, double z, double angle = 0.0) {
    return {upright_point<Dim>(x, z), talus::Rotation<Dim>::exp(upright_turn<Dim>(angle))};
}

/// By how much a body is turned from the axis along towards the axis up [rad], -pi to pi.
template <int Dim>
double upright_angle(const talus::Rotation<Dim>& rotation) {
    const talus::Vector<Dim> along = rotation * talus::Vector<Dim>::Unit(0);
    return std::atan2(along[Dim - 1], along[0]);
}

/// The fastest of so many bodies from `first` on [m/s].
template <int Dim>
double top_speed(const talus::Bodies<Dim>& bodies, std::size_t first, std::size_t count) {
    double speed = 0.0;
    for (std::size_t i = first; i < first + count; ++i)
        speed = std::max(speed, bodies.velocity[i].norm());
    return speed;
}

/// Half extents of a box that wide and high, in space that deep [m].
template <int Dim>
talus::Vector<Dim> upright_half(double width, double height, double depth) {
    talus::Vector<Dim> half = talus::Vector<Dim>::Constant(0.5 * depth);
    half[0] = 0.5 * width;
    half[Dim - 1] = 0.5 * height;
    return half;
}

/// A convex polygon of points (along, up), counter-clockwise; in space drawn out to a prism [m].
template <int Dim>
talus::ConvexPolytope<Dim> upright_prism(std::span<const talus::Vector<2>> outline, double depth) {
    std::vector<talus::Vector<Dim>> corners;
    for (int side = Dim == 2 ? 1 : -1; side <= 1; side += 2)
        for (const talus::Vector<2>& p : outline) {
            corners.push_back(upright_point<Dim>(p[0], p[1]));
            if (Dim == 3) corners.back()[1] = 0.5 * side * depth;
        }
    return talus::ConvexPolytope<Dim>(corners);
}

}  // namespace lab
