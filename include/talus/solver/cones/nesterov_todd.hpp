// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

/// The second-order cone { |x_t| <= x_0 } and its Jordan algebra [NesterovTodd1998]:
/// x o y = (x.y, x_0 y_t + y_0 x_t), unit (1, 0). Points are of one unit, whichever it is.
template <int Dim>
struct SecondOrderCone {
    using Point = Vector<Dim>;

    /// x_0^2 - |x_t|^2: positive inside, zero on the boundary; as a product, which keeps the digits
    /// of points near it.
    static double hyperbolic(const Point& x) {
        const double t = x.template tail<Dim - 1>().norm();
        return (x[0] - t) * (x[0] + t);
    }
    static Point product(const Point& a, const Point& b) {
        Point y;
        y[0] = a.dot(b);
        y.template tail<Dim - 1>() =
            a[0] * b.template tail<Dim - 1>() + b[0] * a.template tail<Dim - 1>();
        return y;
    }
    /// y with product(l, y) = x, for l inside.
    static Point quotient(const Point& l, const Point& x) {
        Point y;
        y[0] = (l[0] * x[0] - l.template tail<Dim - 1>().dot(x.template tail<Dim - 1>())) /
               hyperbolic(l);
        y.template tail<Dim - 1>() =
            (x.template tail<Dim - 1>() - y[0] * l.template tail<Dim - 1>()) / l[0];
        return y;
    }
    /// Largest step that keeps x + step d in the cone, for x inside: the least positive root of
    /// a step^2 + 2 b step + c, and not beyond the apex.
    static double longest_step(const Point& x, const Point& d) {
        constexpr double far = std::numeric_limits<double>::infinity();
        const double a = hyperbolic(d), c = hyperbolic(x);
        const double b = x[0] * d[0] - x.template tail<Dim - 1>().dot(d.template tail<Dim - 1>());
        double step = d[0] < 0.0 ? -x[0] / d[0] : far;
        const double discriminant = b * b - a * c;
        if (discriminant < 0.0) return step;
        // Both roots without cancellation; one is infinite where a = 0.
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        for (const double root : {q / a, c / q})
            if (root > 0.0) step = std::min(step, root);
        return step;
    }
};

/// Nesterov and Todd's scaling of s and z inside the cone: the symmetric matrix T with
/// T z = T^-1 s = lambda [NesterovTodd1998], so that s o z = eps e is the same for both. T = eta
/// (2 w w^T - J) ^ 1/2, J the diagonal (1, -1, ...), is applied without being formed.
template <int Dim>
struct NesterovTodd {
    using Point = Vector<Dim>;
    Point w;       ///< of unit hyperbolic norm
    double eta;    ///< fourth root of the ratio of the hyperbolic norms
    Point lambda;  ///< the scaled point, of both

    NesterovTodd() = default;
    NesterovTodd(const Point& s, const Point& z) {
        const double hs = SecondOrderCone<Dim>::hyperbolic(s);
        const double hz = SecondOrderCone<Dim>::hyperbolic(z);
        const Point a = s / std::sqrt(hs), b = z / std::sqrt(hz);
        const double gamma = std::sqrt(0.5 * (1.0 + a.dot(b)));
        w = a;
        w[0] += b[0];
        w.template tail<Dim - 1>() -= b.template tail<Dim - 1>();
        w /= 2.0 * gamma;
        // Of unit norm again, whatever rounding did near the boundary.
        w[0] = std::sqrt(1.0 + w.template tail<Dim - 1>().squaredNorm());
        eta = std::pow(hs / hz, 0.25);
        lambda = times(z);
    }

    /// T x.
    Point times(const Point& x) const {
        const double d = w.template tail<Dim - 1>().dot(x.template tail<Dim - 1>());
        Point y;
        y[0] = eta * (w[0] * x[0] + d);
        y.template tail<Dim - 1>() = eta * (x.template tail<Dim - 1>() +
                                            (x[0] + d / (1.0 + w[0])) * w.template tail<Dim - 1>());
        return y;
    }
    /// T^-1 x.
    Point divided(const Point& x) const {
        const double d = w.template tail<Dim - 1>().dot(x.template tail<Dim - 1>());
        Point y;
        y[0] = (w[0] * x[0] - d) / eta;
        y.template tail<Dim - 1>() =
            (x.template tail<Dim - 1>() + (d / (1.0 + w[0]) - x[0]) * w.template tail<Dim - 1>()) /
            eta;
        return y;
    }
    /// T^2, which Newton's matrix gets.
    Matrix<Dim> square() const {
        Matrix<Dim> m = 2.0 * w * w.transpose();
        m(0, 0) -= 1.0;
        for (int d = 1; d < Dim; ++d) m(d, d) += 1.0;
        return eta * eta * m;
    }
};

}  // namespace talus
