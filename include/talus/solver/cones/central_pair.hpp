// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace talus {

/// Impulse and velocity of a contact on the central path of InteriorPoint: u_n r_n = eps, u_t =
/// -lambda r_t with lambda (mu^2 r_n^2 - |r_t|^2) = eps. For eps -> 0 they obey Coulomb's law. Each
/// r - u has one such pair, and r and u are smooth in it [ChenMangasarian1996]. In scaled units.
template <int Dim>
requires SpaceDimension<Dim>
struct CentralPair {
    Vector<Dim> r, u;
    Matrix<Dim> d;  ///< -du/dr along the pairs of this eps
};

namespace detail {

/// d in (0, R] with (R - d) (1 + eps / (d (2 R - d))) = length: how far inside the disc r_t
/// ends. The left side falls with d; Newton in a bracket.
inline double depth_in_disc(double length, double radius, double eps) {
    double low = 0.0, high = radius;
    double d = length < radius ? radius - length / (1.0 + eps / (radius * radius))
                               : radius * eps / (2.0 * radius * (length - radius) + eps);
    if (!(d > 0.0 && d < radius)) d = 0.5 * radius;
    for (int k = 0; k < 200; ++k) {
        const double left = radius - d, w = d * (radius + left);
        const double f = length * w - left * (w + eps);
        (f < 0.0 ? low : high) = d;
        const double slope = 2.0 * left * length + w + eps - 2.0 * left * left;
        double next = d - f / slope;
        if (!(next > low && next < high)) next = low > 0.0 ? std::sqrt(low * high) : 1e-3 * high;
        const bool done = std::abs(next - d) <= 4e-16 * d;
        d = next;
        if (done) break;
    }
    return d;
}

}  // namespace detail

/// The pair with r - u = x and complementarity eps > 0.
template <int Dim>
requires SpaceDimension<Dim> CentralPair<Dim> central_pair(const Vector<Dim>& x, double mu,
                                                           double eps) {
    using Tangent = Eigen::Matrix<double, Dim - 1, 1>;
    CentralPair<Dim> p;
    p.d.setZero();
    // u_n r_n = eps with r_n - u_n = x_0: the positive root of r (r - x_0) = eps, without
    // cancellation on either side.
    const double root = std::sqrt(x[0] * x[0] + 4.0 * eps);
    p.r[0] = x[0] >= 0.0 ? 0.5 * (x[0] + root) : 2.0 * eps / (root - x[0]);
    p.u[0] = eps / p.r[0];
    p.d(0, 0) = p.u[0] / p.r[0];
    const Tangent x_t = x.template tail<Dim - 1>();
    const double length = x_t.norm(), radius = mu * p.r[0];
    // No friction: u_t is what it is, and no r_t answers to it.
    if (radius == 0.0) {
        constexpr double rigid = 1e30;
        p.r.template tail<Dim - 1>().setZero();
        p.u.template tail<Dim - 1>() = -x_t;
        p.d.diagonal().template tail<Dim - 1>().setConstant(rigid);
        return p;
    }
    const double depth = detail::depth_in_disc(length, radius, eps);
    const double reach = radius - depth;  // |r_t|
    // mu^2 r_n^2 - |r_t|^2, from the depth: the difference of squares has no digits near the edge.
    const double room = depth * (radius + reach);
    const double lambda = eps / room;  // u_t = -lambda r_t
    const Tangent r_t = length > 0.0 ? Tangent(x_t * (reach / length)) : Tangent::Zero();
    p.r.template tail<Dim - 1>() = r_t;
    p.u.template tail<Dim - 1>() = -lambda * r_t;
    // Beyond `stiff` a number only says that something does not move: larger ones would drown
    // the others of their block.
    constexpr double stiff = 1e9;
    if (p.d(0, 0) > stiff) {
        p.d.diagonal().setConstant(stiff);
        return p;
    }
    // -du_t / dr_t = lambda 1 + (dlambda/dr_t) r_t^T, lambda = eps / room: a wall along r_t that
    // rises as r_t nears the edge. The coupling to r_n, by the radius, is its lower-left part.
    const double wall =
        2.0 * lambda / room * std::min(1.0, stiff * room / (2.0 * lambda * reach * reach + 1e-300));
    SmallMatrix<Dim - 1, Dim - 1> block = wall * r_t * r_t.transpose();
    for (int k = 0; k < Dim - 1; ++k) block(k, k) += std::min(lambda, stiff);
    p.d.template bottomRightCorner<Dim - 1, Dim - 1>() = block;
    p.d.template bottomLeftCorner<Dim - 1, 1>() = -(wall * radius * mu) * r_t;
    return p;
}

}  // namespace talus
