// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <span>
#include <vector>

/// The numerical tools of the references, over the GNU Scientific Library, with its handles hidden.
/// All throw std::runtime_error, with GSL's words, when they fail.
namespace validation::gsl {

using Function = std::function<double(double)>;

/// Root of f in [low, high], where f has opposite signs, by Brent's method to rounding.
double root(const Function& f, double low, double high);

/// Place of the smallest value of f in [low, high], which `guess` is near to, by Brent's method (to
/// about the square root of rounding).
double minimum(const Function& f, double low, double guess, double high);

/// Integral over [low, high]; integrable singularities at the ends are allowed (qags).
double integral(const Function& f, double low, double high);

/// State at the times given (increasing, the first is the initial one) of y' = f(t, y, dy) by the
/// eighth-order Runge-Kutta method of Prince and Dormand at 1e-13 absolute, 1e-12 relative.
using RightHandSide =
    std::function<void(double t, std::span<const double> y, std::span<double> dy)>;
std::vector<std::vector<double>> ode(const RightHandSide& f, std::vector<double> y,
                                     std::span<const double> times);

/// Goes on from (t, y) until `event(t, y)` changes its sign; returns t and leaves y there, both to
/// rounding. Throws if that does not happen before t_max.
double ode_until(const RightHandSide& f, double t, std::vector<double>& y,
                 const std::function<double(double, std::span<const double>)>& event, double t_max);

/// Complete elliptic integral of the first kind of *modulus* k (m = k^2).
double ellint_K(double k);

/// Jacobi's functions of u and *parameter* m = k^2.
struct Jacobi {
    double sn, cn, dn;
};
Jacobi jacobi(double u, double m);

/// Least-squares line y = intercept + slope x, with the standard error of the slope.
struct Line {
    double intercept, slope, slope_error;
};
Line fit_line(std::span<const double> x, std::span<const double> y);

/// Linear least squares: coefficients c of the smallest |X c - y|, X by rows.
std::vector<double> fit_linear(const std::vector<std::vector<double>>& rows,
                               std::span<const double> y);

/// Real roots of a x^2 + b x + c, ascending.
std::vector<double> quadratic_roots(double a, double b, double c);

/// Quantile of Student's distribution with `freedom` degrees: P(|t| < q) = probability.
double student_quantile(double probability, double freedom);

}  // namespace validation::gsl
