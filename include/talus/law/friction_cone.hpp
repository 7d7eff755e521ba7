// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>

namespace talus {

/// The velocity u + mu |u_t| n. With it Coulomb's law is one cone complementarity between the
/// friction cone and its dual:  K* contains de_saxce_corrected(u), orthogonal to r in K
/// [DeSaxceFeng1998].
template <int Dim>
requires SpaceDimension<Dim> Vector<Dim> de_saxce_corrected(Vector<Dim> u, double mu) {
    u[0] += mu * tangential(u).norm();
    return u;
}

/// The cone K = { x : |x_t| <= mu x_n } of admissible impulses and its dual
/// K* = { x : x_n >= mu |x_t| }. Round in space, never faceted.
template <int Dim>
requires SpaceDimension<Dim>
struct FrictionCone {
    double mu = 0.0;  ///< slope: friction coefficient [-], finite, not negative

    bool contains(const Vector<Dim>& x) const {
        return x[0] >= 0.0 && tangential(x).norm() <= mu * x[0];
    }
    bool dual_contains(const Vector<Dim>& x) const { return x[0] >= mu * tangential(x).norm(); }

    /// Nearest point of K. Homogeneous of degree one; no overflow for any finite mu.
    Vector<Dim> project(const Vector<Dim>& x) const {
        const double t = tangential(x).norm();
        // The polar cone first: with mu = 0 and x_t = 0 both tests would accept x_n < 0.
        if (mu * t <= -x[0]) return Vector<Dim>::Zero();
        if (t <= mu * x[0]) return x;
        // hypot(1, mu), cheaper.
        const double secant = mu < 1e100 ? std::sqrt(1.0 + mu * mu) : mu;
        const double cosine = 1.0 / secant, sine = mu / secant;
        const double length = cosine * x[0] + sine * t;  // along the generator below x
        return in_local_frame(cosine * length, (sine * length / t) * tangential(x));
    }

    /// Half the error of r beside u against the law as it is written [N s]: of r_n against p =
    /// max(0, r_n - rho u_n), of r_t against the point of the disc of radius mu p nearest to r_t -
    /// rho u_t [AlartCurnier1991]. What the natural map hides on a steep cone, where it sees u_n
    /// times 1 / sqrt(1 + mu^2) only, and a lacking force of friction mu r_n as r_n. On slopes up
    /// to 0.8 it is less than the error of the natural map (tested), and 0 is returned.
    double steep_error(const Vector<Dim>& u, const Vector<Dim>& r, double rho) const {
        constexpr double steep = 0.8;
        if (mu <= steep) return 0.0;
        const double p = std::max(0.0, r[0] - rho * u[0]);
        auto wanted = tangential(r - rho * u).eval();
        const double size = wanted.norm();
        if (size > mu * p) wanted *= mu * p / size;
        return 0.5 * std::hypot(r[0] - p, (tangential(r) - wanted).norm());
    }

    /// Nearest point of K*, by Moreau's decomposition  x = P_K*(x) - P_K(-x).
    Vector<Dim> project_dual(const Vector<Dim>& x) const { return x + project(-x); }
};

}  // namespace talus
