// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/dimension.hpp>
#include <talus/core/instantiate.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#if TALUS_BODIES
#include <Eigen/Eigenvalues>
#endif

namespace talus {

/// Directions in which a contact can slide, by an angle [rad]: two of them in the plane, 0 and pi;
/// a circle in space. For Enumeration.
template <int Dim>
requires SpaceDimension<Dim>
struct SlipAngle {
    using Tangent = Eigen::Matrix<double, Dim - 1, 1>;
    /// Whether the angle is an unknown.
    static constexpr bool turns = rotation_dof<Dim> > 1;
    /// So many that every combination of statuses takes seconds.
    static constexpr std::size_t max_contacts = turns ? 4 : 8;

    /// The k-th of `starts` angles; where the contact turns, off the axes.
    static double start(int k, int starts) {
        return 2.0 * std::numbers::pi * (k + (turns ? 0.3 : 0.0)) / starts;
    }
    static Tangent direction(double angle) {
        Tangent t;
        t[Dim - 2] = std::sin(angle);
        t[0] = std::cos(angle);  // in the plane the only one
        return t;
    }
    /// Derivative of the direction.
    static Tangent turned(double angle) {
        if (!turns) return Tangent::Zero();
        Tangent t;
        t[Dim - 2] = std::cos(angle);
        t[0] = -std::sin(angle);
        return t;
    }
};

/// Angles near which a trigonometric polynomial of degree two vanishes, from its values at the
/// angles 2 pi k / 5: at most four, those next to a double root included. Nothing if it is below
/// `zero` everywhere. The roots z = exp(i angle) of a quartic, as eigenvalues of its companion
/// matrix.
TALUS_FUNCTION std::optional<std::vector<double>> trigonometric_roots(
    const std::array<double, 5>& value, double zero);

#if TALUS_BODIES

TALUS_FUNCTION std::optional<std::vector<double>> trigonometric_roots(
    const std::array<double, 5>& value, double zero) {
    using Complex = std::complex<double>;
    constexpr double part = 2.0 * std::numbers::pi / 5.0;
    std::array<Complex, 5> coefficient{};  // of z^0 ... z^4
    double size = 0.0;
    for (int n = 0; n < 5; ++n) {
        for (int k = 0; k < 5; ++k)
            coefficient[static_cast<std::size_t>(n)] +=
                value[static_cast<std::size_t>(k)] / 5.0 * std::polar(1.0, -part * k * (n - 2));
        size = std::max(size, std::abs(coefficient[static_cast<std::size_t>(n)]));
    }
    if (!(size > zero)) return std::nullopt;
    // Coefficients come in conjugate pairs: where the outer two vanish the degree is two less.
    const std::size_t skip = std::abs(coefficient[4]) > 1e-13 * size ? 0 : 1;
    const std::size_t degree = 4 - 2 * skip;
    std::vector<double> angles;
    if (std::abs(coefficient[skip + degree]) <= 1e-13 * size) return angles;
    const auto n = static_cast<Eigen::Index>(degree);
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        if (k > 0) companion(k, k - 1) = 1.0;
        companion(k, n - 1) =
            -coefficient[skip + static_cast<std::size_t>(k)] / coefficient[skip + degree];
    }
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> eigen(companion, false);
    constexpr double unit = 0.01;  // off the circle, by a double root's rounding and more
    for (const Complex& z : eigen.eigenvalues())
        if (std::abs(std::abs(z) - 1.0) < unit) angles.push_back(std::arg(z));
    return angles;
}

#endif

}  // namespace talus
