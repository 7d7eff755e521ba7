// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/symmetric_eigen.hpp>
#include <talus/core/types.hpp>
#include <talus/spatial/inertia.hpp>
#include <talus/spatial/pose.hpp>

#include <cmath>

namespace talus {

/// Volume integrals of a shape of unit density, in the frame of the shape. In the plane "volume" is
/// an area and density a mass per area.
template <int Dim>
requires SpaceDimension<Dim>
struct MassProperties {
    double volume = 0.0;                                      ///< [m^Dim]
    Vector<Dim> centroid = Vector<Dim>::Zero();               ///< [m]
    AngularMatrix<Dim> inertia = AngularMatrix<Dim>::Zero();  ///< about the centroid [m^(Dim+2)]
};

/// The frame of a shape's centroid and principal axes, in the frame of the shape.
template <int Dim>
struct PrincipalFrame {
    Pose<Dim> pose;              ///< principal frame, seen from the frame of the shape
    AngularVector<Dim> moments;  ///< principal moments at unit density [m^(Dim+2)]
};

/// Principal frame of `m`. A tensor that is diagonal to rounding keeps the axes it came in.
template <int Dim>
PrincipalFrame<Dim> principal_frame(const MassProperties<Dim>& m) {
    PrincipalFrame<Dim> result;
    result.pose.position = m.centroid;
    if constexpr (Dim == 2) {
        result.moments = m.inertia;
    } else {
        const double off =
            std::abs(m.inertia(0, 1)) + std::abs(m.inertia(0, 2)) + std::abs(m.inertia(1, 2));
        if (off <= 1e-14 * m.inertia.trace()) {
            result.moments = {m.inertia(0, 0), m.inertia(1, 1), m.inertia(2, 2)};
        } else {
            const SymmetricEigen<3> eigen(m.inertia);
            Matrix<3> axes = eigen.vectors;
            if (axes.determinant() < 0.0) axes.set_column(0, -axes.column(0));
            result.moments = eigen.values;
            result.pose.rotation = Rotation<3>::from_matrix(axes);
        }
    }
    return result;
}

}  // namespace talus
