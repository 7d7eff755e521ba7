// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <limits>
#include <vector>

namespace talus {

/// One grain at rest, axes along the world's: a ball, or a convex polygon or polyhedron.
template <int Dim>
requires SpaceDimension<Dim>
struct Grain {
    Vector<Dim> position = Vector<Dim>::Zero();  ///< of the centroid [m]
    double radius = 0.0;                         ///< of the ball, or of the farthest corner [m]
    /// Corners relative to the position [m]; none for a ball. In the plane counter-clockwise.
    std::vector<Vector<Dim>> vertices;

    bool is_ball() const { return vertices.empty(); }
};

/// A pile before it falls: grains of one material in a box with the walls x_i = 0 and
/// x_i = box_size[i] along the horizontal axes and the floor at 0; the last axis points up.
template <int Dim>
requires SpaceDimension<Dim>
struct Scene {
    /// Sides of the box [m]; the last one is infinite: the box is open at the top.
    Vector<Dim> box_size = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
    double mu = 0.0;       ///< friction coefficient of every contact [-]
    double density = 0.0;  ///< [kg/m^Dim]
    double gravity = 0.0;  ///< downwards, along minus the last axis [m/s^2]
    /// Of the law the radii were drawn from, but not beyond any of them [m].
    double mean_radius = 0.0;
    std::vector<Grain<Dim>> grains;
};

}  // namespace talus
