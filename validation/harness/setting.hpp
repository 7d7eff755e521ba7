// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/prescribed_motion.hpp>
#include <talus/spatial/inertia.hpp>
#include <talus/spatial/tilt.hpp>
#include <talus/stepping/system.hpp>

#include <cmath>
#include <limits>
#include <numbers>

/// What the cases have in common: gravity along minus the last axis, the floor x_last = 0, plane
/// problems in the plane of the first and the last axis, SI units.
namespace validation {

inline constexpr double g = 9.81;
inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;
/// Bodies placed in touch are so up to rounding of coordinates of order 1 m [m].
inline constexpr double touching = 1e-10;

template <int Dim>
using V = talus::Vector<Dim>;
template <int Dim>
using W = talus::AngularVector<Dim>;
/// Coulomb friction on weighted means: the law of all cases.
template <int Dim>
using Law = talus::DefaultLaw<Dim>;

template <int Dim>
Law<Dim> law(double mu, double e_n = 0.0, double e_t = 0.0) {
    return {{mu}, e_n, e_t};
}

template <int Dim>
V<Dim> up() {
    return V<Dim>::Unit(Dim - 1);
}
/// A vector in the plane of the first and the last axis.
template <int Dim>
V<Dim> in_plane(double first, double last) {
    V<Dim> v = V<Dim>::Zero();
    v[0] = first;
    v[Dim - 1] = last;
    return v;
}
/// The spin that rolls a body towards + the first axis on the floor, of magnitude w: clockwise in
/// the plane, about the second axis in space.
template <int Dim>
W<Dim> rolling_spin(double w) {
    if constexpr (Dim == 2)
        return W<2>(-w);
    else
        return W<3>(0.0, w, 0.0);
}
using talus::tilt;
/// The spin from the first towards the last axis: the sense of `tilt`.
template <int Dim>
double tilting_spin(const talus::Twist<Dim>& twist) {
    return twist.angular.dot(rolling_spin<Dim>(-1.0));
}

/// Inertia factor kap of I = kap m r^2: disc 1/2, sphere 2/5.
template <int Dim>
inline constexpr double kap = Dim == 2 ? 0.5 : 0.4;

template <int Dim>
talus::Inertia<Dim> round_inertia(double mass, double radius, double factor = kap<Dim>) {
    return {mass, W<Dim>::Constant(factor * mass * radius * radius)};
}
/// A body that moves without turning.
template <int Dim>
talus::Inertia<Dim> point_mass(double mass) {
    return {mass, W<Dim>::Constant(std::numeric_limits<double>::infinity())};
}
/// A uniform slender rod along the first body axis; in space its own axis gets a small moment that
/// plays no part.
template <int Dim>
talus::Inertia<Dim> rod_inertia(double mass, double length) {
    W<Dim> moments = W<Dim>::Constant(mass * length * length / 12.0);
    if constexpr (Dim == 3) moments[0] *= 1e-2;
    return {mass, moments};
}
/// A homogeneous rectangle or block of given half extents.
template <int Dim>
talus::Inertia<Dim> box_inertia(double mass, const V<Dim>& half) {
    W<Dim> moments;
    if constexpr (Dim == 2)
        moments[0] = mass / 3.0 * half.squaredNorm();
    else
        for (int k = 0; k < 3; ++k)
            moments[k] = mass / 3.0 * (half.squaredNorm() - half[k] * half[k]);
    return {mass, moments};
}

/// Largest coordinate by magnitude.
template <class Vec>
double largest(const Vec& v) {
    return v.cwiseAbs().maxCoeff();
}

}  // namespace validation
