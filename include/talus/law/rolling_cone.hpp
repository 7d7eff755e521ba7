// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>

namespace talus {

/// Number of tangents in a local vector with rolling components, and of rolling components.
template <int Rows>
requires RollingRows<Rows>
inline constexpr int tangent_count = (Rows - 1) / 2;

/// The velocity u + (mu |u_t| + mu_r |u_m|) n. With it sliding and rolling friction are one cone
/// complementarity between the rolling cone and its dual [AcaryBourrier2021].
template <int Rows>
requires RollingRows<Rows> Vector<Rows> de_saxce_corrected(Vector<Rows> u, double mu, double mu_r) {
    constexpr int T = tangent_count<Rows>;
    u[0] += mu * u.template segment<T>(1).norm() + mu_r * u.template tail<T>().norm();
    return u;
}

/// The cone K = { x : |x_t| <= mu x_n, |x_m| <= mu_r x_n } of admissible impulses and its dual
/// K* = { x : x_n >= mu |x_t| + mu_r |x_m| }; x = (x_n, x_t, x_m).
template <int Rows>
requires RollingRows<Rows>
struct RollingCone {
    double mu = 0.0;    ///< slope in the tangents, finite, not negative
    double mu_r = 0.0;  ///< slope in the rolling components, finite, not negative

    bool contains(const Vector<Rows>& x) const {
        return x[0] >= 0.0 && slide(x) <= mu * x[0] && roll(x) <= mu_r * x[0];
    }
    bool dual_contains(const Vector<Rows>& x) const {
        return x[0] >= mu * slide(x) + mu_r * roll(x);
    }

    /// Nearest point y of K, exactly: with s = y_n the other parts are x_t and x_m shortened to mu
    /// s and mu_r s where they are longer, and s is the zero of the increasing, piecewise linear
    ///   s - x_n - mu max(0, |x_t| - mu s) - mu_r max(0, |x_m| - mu_r s),
    /// which its two break points |x_t| / mu and |x_m| / mu_r part into three pieces at most.
    Vector<Rows> project(const Vector<Rows>& x) const {
        const double t = slide(x), m = roll(x);
        // The polar cone first: with slopes of zero the interior would accept x_n < 0.
        if (mu * t + mu_r * m <= -x[0]) return Vector<Rows>::Zero();
        if (contains(x)) return x;
        double s = on_face(x[0], t, mu, m, mu_r);
        if (t <= mu * s)
            s = on_face(x[0], 0.0, 0.0, m, mu_r);
        else if (m <= mu_r * s)
            s = on_face(x[0], t, mu, 0.0, 0.0);
        return shortened(x, std::max(0.0, s), t, m);
    }

    /// Nearest point of K*, by Moreau's decomposition  x = P_K*(x) - P_K(-x).
    Vector<Rows> project_dual(const Vector<Rows>& x) const { return x + project(-x); }

  private:
    static constexpr int T = tangent_count<Rows>;

    static double slide(const Vector<Rows>& x) { return x.template segment<T>(1).norm(); }
    static double roll(const Vector<Rows>& x) { return x.template tail<T>().norm(); }
    /// Zero of s - x_n - a (t - a s) - b (m - b s). No overflow for any finite a, b.
    static double on_face(double x_n, double t, double a, double m, double b) {
        const double secant = std::hypot(1.0, a, b);
        return (x_n / secant + (a / secant) * t + (b / secant) * m) / secant;
    }
    Vector<Rows> shortened(Vector<Rows> x, double s, double t, double m) const {
        x[0] = s;
        if (t > mu * s) x.template segment<T>(1) *= mu * s / t;
        if (m > mu_r * s) x.template tail<T>() *= mu_r * s / m;
        return x;
    }
};

}  // namespace talus
