// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random.hpp>
#include <talus/spatial/tilt.hpp>
#include <talus/spatial/twist.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus {

/// A shape and where it stands, to become an obstacle:
///
///     for (const auto& wall : hopper<3>({.opening = 0.06, .width = 0.3, .depth = 0.06}))
///         sim.system().add_obstacle(wall.shape, wall.pose);
///
/// To set up the whole elsewhere or to turn it, put a pose before: `pose * wall.pose`.
template <int Dim>
struct PlacedShape {
    AnyShape<Dim> shape;
    Pose<Dim> pose = {};
};

/// A hopper with plane walls; the lower edges of its planks are at height 0, up is the last axis.
struct HopperParams {
    double opening;                        ///< between the planks, along axis 0 [m]
    double width;                          ///< between the upright walls above them [m]
    double depth = 0.0;                    ///< in space, of the whole along axis 1 [m]
    double lean = std::numbers::pi / 4.0;  ///< of the planks, to the horizontal [rad]
    double thickness = 0.02;               ///< of the planks [m]
};
/// Two planks, then the upright walls: two in the plane, four in space. Throws input_error unless 0
/// <= opening < width, depth is positive in space, 0 < lean < pi / 2 and the thickness is positive.
template <int Dim>
std::vector<PlacedShape<Dim>> hopper(const HopperParams& params) {
    require_non_negative("opening of the hopper", params.opening);
    require_positive("width of the hopper", params.width);
    if (!(params.opening < params.width))
        detail::reject("opening of the hopper", params.opening,
                       "below its width, " + detail::text_of(params.width));
    if (rotation_dof<Dim> != 1) require_positive("depth of the hopper", params.depth);
    require_positive("lean of the hopper", params.lean);
    require_in("lean of the hopper", params.lean, 0.0, 0.499 * std::numbers::pi);
    require_positive("thickness of the hopper's planks", params.thickness);

    const Vector<Dim> x = Vector<Dim>::Unit(0), up = Vector<Dim>::Unit(Dim - 1);
    // From the opening to the upright walls, and behind them by the thickness.
    const double half =
        0.25 * (params.width - params.opening) / std::cos(params.lean) + 0.5 * params.thickness;
    std::vector<PlacedShape<Dim>> walls;
    for (const double side : {-1.0, 1.0}) {
        Vector<Dim> size = Vector<Dim>::Constant(half);
        if (rotation_dof<Dim> != 1) size[1] = 0.5 * params.depth + params.thickness;
        size[Dim - 1] = 0.5 * params.thickness;
        const Vector<Dim> along = std::cos(params.lean) * side * x + std::sin(params.lean) * up;
        const Vector<Dim> outside = std::sin(params.lean) * side * x - std::cos(params.lean) * up;
        const Vector<Dim> edge = 0.5 * params.opening * side * x;
        walls.push_back({Box<Dim>(size),
                         {Vector<Dim>(edge + half * along + 0.5 * params.thickness * outside),
                          tilt<Dim>(side * params.lean)}});
    }
    for (const double side : {-1.0, 1.0})
        walls.push_back({HalfSpace<Dim>(side * x, -0.5 * params.width)});
    if constexpr (rotation_dof<Dim> != 1)
        for (const double side : {-1.0, 1.0})
            walls.push_back({HalfSpace<3>(side * Vector<3>::Unit(1), -0.5 * params.depth)});
    return walls;
}

/// A drum about the origin: a circle in the plane, in space a round hole along axis 1, then its two
/// ends, `length` apart. Throws input_error unless both are positive.
template <int Dim>
std::vector<PlacedShape<Dim>> drum(double radius, double length = 1.0) {
    require_positive("radius of the drum", radius);
    require_positive("length of the drum", length);
    if constexpr (rotation_dof<Dim> == 1) {
        return {{RoundHole<2>(radius)}};
    } else {
        const Vector<3> axis = Vector<3>::Unit(1);
        return {{RoundHole<3>(radius, axis)},
                {HalfSpace<3>(axis, -0.5 * length)},
                {HalfSpace<3>(-axis, -0.5 * length)}};
    }
}
/// The motion of a drum that turns so many times in a second [1/s], from axis 0 upwards.
template <int Dim>
Twist<Dim> drum_twist(double turns) {
    Twist<Dim> twist;
    twist.angular[rotation_dof<Dim> == 1 ? 0 : 1] =
        (rotation_dof<Dim> == 1 ? 1.0 : -1.0) * 2.0 * std::numbers::pi * turns;
    return twist;
}

/// An upright tube without ends about the last axis: two plates in the plane, a round hole in
/// space. Throws input_error unless the diameter [m] is positive.
template <int Dim>
std::vector<PlacedShape<Dim>> tube(double diameter) {
    require_positive("diameter of the tube", diameter);
    if constexpr (rotation_dof<Dim> == 1)
        return {{HalfSpace<2>(Vector<2>::Unit(0), -0.5 * diameter)},
                {HalfSpace<2>(-Vector<2>::Unit(0), -0.5 * diameter)}};
    else
        return {{RoundHole<3>(0.5 * diameter, Vector<3>::Unit(2))}};
}

/// A floor at height 0 with grains glued to it, up to `reach` [m] from the origin: a plane, then
/// balls on a lattice of 1.1 mean diameters, shaken by a third of it, half sunk in the plane.
/// Throws input_error unless the reach is positive, and small enough for 10^7 grains.
template <int Dim, RadiusLaw Law>
std::vector<PlacedShape<Dim>> rough_floor(Random& random, const Law& radii, double reach) {
    require_positive("reach of the floor", reach);
    const double pitch = 2.2 * radii.mean();
    require_in("grains of the floor", std::pow(2.0 * reach / pitch, Dim - 1), 0.0, 1e7);
    std::vector<PlacedShape<Dim>> walls{
        {HalfSpace<Dim>(Vector<Dim>::Unit(Dim - 1), -radii.mean())}};
    const int side = static_cast<int>(reach / pitch), across = rotation_dof<Dim> == 1 ? 0 : side;
    for (int i = -side; i <= side; ++i)
        for (int j = -across; j <= across; ++j) {
            Vector<Dim> x = Vector<Dim>::Zero();
            x[0] = pitch * (i + random.uniform(-0.3, 0.3));
            if (rotation_dof<Dim> != 1) x[1] = pitch * (j + random.uniform(-0.3, 0.3));
            x[Dim - 1] = -0.5 * radii.mean();
            if (x.norm() < reach) walls.push_back({Ball<Dim>(radii(random)), {x, {}}});
        }
    return walls;
}

}  // namespace talus
