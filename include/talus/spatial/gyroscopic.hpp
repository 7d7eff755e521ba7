// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/spatial/rotation.hpp>

#include <limits>

namespace talus {

/// Whether a body of these principal moments turns like a ball: its spin is then constant without
/// torque. Always so in the plane.
template <int Dim>
bool is_isotropic(const AngularVector<Dim>& principal) {
    return principal == AngularVector<Dim>::Constant(principal[0]);
}

/// The gyroscopic term of Euler's equations, I w' = - w x I w [N m], in principal axes; zero in the
/// plane. It is part of F in equation (3) of [Moreau].
template <int Dim>
requires SpaceDimension<Dim> AngularVector<Dim> gyroscopic_torque(
    const AngularVector<Dim>& spin_body, const AngularVector<Dim>& principal) {
    if constexpr (Dim == 2)
        return AngularVector<2>::Zero();
    else if (is_isotropic<3>(principal))
        return AngularVector<3>::Zero();
    else
        return -spin_body.cross(principal.cwiseProduct(spin_body));
}

/// Spin, in principal axes, with which a torque-free body ends an interval of length `duration` [s]
/// that it enters with `spin_body`, when it turns by half the interval at each of the two spins:
///
///   exp(duration/2 w_end) I w_end = exp(-duration/2 w_begin) I w_begin.
///
/// Both sides are the angular momentum in the axes of the midpoint, so the momentum in space is
/// kept to rounding; the map is time-reversible, hence of order 2 ([SimoWong1991] study such
/// updates). Solved by Newton's method; a turn of more than about one radian per interval, for
/// which the equation may have no solution, falls back to the best iterate.
template <int Dim>
requires SpaceDimension<Dim> AngularVector<Dim> torque_free_spin(
    const AngularVector<Dim>& spin_body, const AngularVector<Dim>& principal, double duration) {
    if constexpr (Dim == 2) {
        return spin_body;
    } else {
        if (is_isotropic<3>(principal)) return spin_body;
        const double half = 0.5 * duration;
        const Vector<3> target =
            Rotation<3>::exp(-half * spin_body) * principal.cwiseProduct(spin_body);
        Vector<3> w = spin_body;
        Vector<3> best = w;
        double best_error = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 50; ++k) {
            const Rotation<3> turn = Rotation<3>::exp(half * w);
            const Vector<3> carried = turn * principal.cwiseProduct(w);
            const Vector<3> error = carried - target;
            if (!(error.norm() < best_error)) break;  // rounding reached, or no progress
            best = w;
            best_error = error.norm();
            // d(exp(half w) m) = -half [exp(half w) m]_x dw to first order in half |w|.
            Matrix<3> slope = columns_scaled<3>(turn.matrix(), principal);
            slope -= half * moment_matrix<3>(carried);
            w -= solve_by_cramer(slope, error);
        }
        return best;
    }
}

}  // namespace talus
