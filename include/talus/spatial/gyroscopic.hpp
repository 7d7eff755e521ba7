// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/spatial/rotation.hpp>

#include <cmath>
#include <optional>

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

namespace detail {

/// J with exp(phi + d) = exp(J d) exp(phi) to first order in d: the left Jacobian of the rotations.
inline Matrix<3> left_jacobian(const Vector<3>& phi) {
    const double square = phi.squaredNorm(), angle = std::sqrt(square);
    // (1 - cos) / angle^2 and (angle - sin) / angle^3, by their series where digits would cancel.
    const bool small = angle < 1e-2;
    const double half = std::sin(0.5 * angle);
    const double b = small ? 0.5 - square / 24.0 : 2.0 * half * half / square;
    const double c =
        small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
    const Matrix<3> cross = moment_matrix<3>(phi);
    return Matrix<3>::Identity() + b * cross + c * (cross * cross);
}

/// The equation of torque_free_spin, by Newton's method, which does not go where the error grows.
/// Nothing where no solution was found next to the spin.
inline std::optional<Vector<3>> solve_torque_free_spin(const Vector<3>& spin_body,
                                                       const Vector<3>& principal,
                                                       double duration) {
    const double half = 0.5 * duration;
    const Vector<3> target =
        Rotation<3>::exp(-half * spin_body) * principal.cwiseProduct(spin_body);
    const auto error_at = [&](const Vector<3>& w) -> Vector<3> {
        return Rotation<3>::exp(half * w) * principal.cwiseProduct(w) - target;
    };
    Vector<3> w = spin_body, error = error_at(w);
    for (int k = 0; k < 50; ++k) {
        // d(exp(half w) m) = -half [exp(half w) m]_x J dw.
        Matrix<3> slope = columns_scaled<3>(Rotation<3>::exp(half * w).matrix(), principal);
        slope -= half * (moment_matrix<3>(Vector<3>(error + target)) * left_jacobian(half * w));
        const Vector<3> step = solve_by_cramer(slope, error);
        Vector<3> next = w - step, next_error = error_at(next);
        for (int j = 1; j <= 20 && !(next_error.norm() < error.norm()); ++j) {
            next = w - std::ldexp(1.0, -j) * step;
            next_error = error_at(next);
        }
        if (!(next_error.norm() < error.norm())) break;  // rounding reached, or no way on
        w = next;
        error = next_error;
    }
    constexpr double rounding = 1e-12;  // of the momentum
    const bool solved = error.norm() <= rounding * target.norm();
    // Farther away are solutions of another branch, of another energy.
    const bool next_to_it = (w - spin_body).norm() <= spin_body.norm();
    return solved && next_to_it ? std::optional(w) : std::nullopt;
}

}  // namespace detail

/// Spin, in principal axes, of a body without torque at the end of an interval.
template <int Dim>
struct TorqueFreeSpin {
    AngularVector<Dim> spin;
    bool in_parts = false;  ///< of the interval: what follows the whole of it keeps no momentum
};

/// Spin, in principal axes, with which a torque-free body ends an interval of length `duration` [s]
/// that it enters with `spin_body`, when it turns by half the interval at each of the two spins:
///
///   exp(duration/2 w_end) I w_end = exp(-duration/2 w_begin) I w_begin.
///
/// Both sides are the angular momentum in the axes of the midpoint, so the momentum in space is
/// kept to rounding; the map is time-reversible, hence of order 2 ([SimoWong1991] study such
/// updates). A turn of up to 1.5 rad per interval has a solution next to its spin for all moments
/// tried, plates and needles among them, with an energy that swings by 10 % at most. Beyond, where
/// none is found, the interval is halved until there is one.
template <int Dim>
requires SpaceDimension<Dim> TorqueFreeSpin<Dim> torque_free_spin(
    const AngularVector<Dim>& spin_body, const AngularVector<Dim>& principal, double duration) {
    if constexpr (Dim == 3) {
        if (is_isotropic<3>(principal)) return {spin_body};
        constexpr int most_parts = 4096;
        for (int parts = 1; parts <= most_parts; parts *= 2) {
            std::optional<Vector<3>> w = spin_body;
            for (int k = 0; k < parts && w; ++k)
                w = detail::solve_torque_free_spin(*w, principal, duration / parts);
            if (w) return {*w, parts > 1};
        }
        return {spin_body, true};
    }
    return {spin_body};
}

}  // namespace talus
