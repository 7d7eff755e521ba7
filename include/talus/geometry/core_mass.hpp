// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/mass_properties.hpp>

namespace talus {

/// Tensor of inertia about the centroid from the second moments M = integral of x x^T about it: the
/// number trace M in 2D, (trace M) 1 - M in 3D.
template <int Dim>
AngularMatrix<Dim> inertia_of_second_moments(const Matrix<Dim>& m) {
    if constexpr (Dim == 2)
        return AngularMatrix<2>(m.trace());
    else
        return m.trace() * Matrix<3>::Identity() - m;
}

/// Exact volume integrals of a polygon or polyhedron without rounding, as a sum over the simplices
/// that an inner point forms with the faces (divergence theorem): a simplex of volume V with
/// corners 0, v_1..v_d has
///   int x = V sum v / (d + 1),   int x x^T = V (s s^T + sum v v^T) / ((d + 1)(d + 2)),   s = sum
///   v.
/// O(vertices).
template <int Dim>
MassProperties<Dim> core_mass_properties(const CoreView<Dim>& core) {
    double volume = 0.0;
    Vector<Dim> first = Vector<Dim>::Zero();
    Matrix<Dim> second = Matrix<Dim>::Zero();
    const Vector<Dim> origin = core.centre;
    for (std::size_t f = 0; f < core.face_count(); ++f) {
        const auto loop = core.face(f);
        for (std::size_t k = 1; k + (Dim == 3) < loop.size(); ++k) {
            Matrix<Dim> corners;
            corners.set_column(0, core.vertices[loop[0]] - origin);
            for (int c = 1; c < Dim; ++c)
                corners.set_column(
                    c, core.vertices[loop[k + static_cast<std::size_t>(c - 1)]] - origin);
            const double v = corners.determinant() / (Dim == 2 ? 2.0 : 6.0);
            const Vector<Dim> sum = corners * Vector<Dim>::Ones();
            volume += v;
            first += v / (Dim + 1) * sum;
            second += v / ((Dim + 1) * (Dim + 2)) *
                      (sum * sum.transpose() + corners * corners.transpose());
        }
    }
    const Vector<Dim> centroid = first / volume;
    second -= volume * centroid * centroid.transpose();
    return {volume, origin + centroid, inertia_of_second_moments<Dim>(second)};
}

/// Volume integrals seen from the frame in which the present frame has this pose.
template <int Dim>
MassProperties<Dim> placed(const MassProperties<Dim>& m, const Pose<Dim>& pose) {
    MassProperties<Dim> result{m.volume, pose.point_world(m.centroid), m.inertia};
    if constexpr (Dim == 3) {
        const Matrix<3> r = pose.rotation.matrix();
        result.inertia = r * m.inertia * r.transpose();
    }
    return result;
}

}  // namespace talus
