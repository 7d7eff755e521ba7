// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/any_shape.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// Random poses, directions and shapes for tests; every test fixes the seed of its generator.
namespace random_geometry {

using Generator = std::mt19937_64;

inline double uniform(Generator& g, double low, double high) {
    return low + (high - low) * (static_cast<double>(g() >> 11) * 0x1.0p-53);
}

template <int Dim>
talus::Vector<Dim> direction(Generator& g) {
    talus::Vector<Dim> d;
    do {
        for (int k = 0; k < Dim; ++k) d[k] = uniform(g, -1.0, 1.0);
    } while (d.norm() > 1.0 || d.norm() < 0.1);
    return d.normalized();
}

/// In any direction. (Compilers differ in which of two draws of one expression is made first.)
template <int Dim>
talus::Vector<Dim> displacement(Generator& g, double least, double most) {
    const double length = uniform(g, least, most);
    return length * direction<Dim>(g);
}

template <int Dim>
talus::Pose<Dim> pose(Generator& g, double reach) {
    talus::Pose<Dim> p;
    p.position = displacement<Dim>(g, 0.0, reach);
    talus::AngularVector<Dim> spin;
    for (int k = 0; k < spin.size(); ++k) spin[k] = uniform(g, -3.0, 3.0);
    p.rotation = talus::Rotation<Dim>::exp(spin);
    return p;
}

/// Corners on an ellipsoid: all of them corners of the hull; in the plane counter-clockwise.
template <int Dim>
std::vector<talus::Vector<Dim>> corners(Generator& g, int count, double scale) {
    std::vector<talus::Vector<Dim>> result;
    for (int i = 0; i < count; ++i) {
        talus::Vector<Dim> v;
        if constexpr (Dim == 2) {
            const double angle = 2.0 * std::numbers::pi * (i + uniform(g, 0.1, 0.9)) / count;
            v << std::cos(angle), std::sin(angle);
        } else {
            v = direction<3>(g);
        }
        v[0] *= 1.3;
        result.push_back(scale * v);
    }
    return result;
}

/// Child i of the kinds of convex shapes (0 ball, 1 capsule, 2 box, 3 polytope), of size `scale`.
template <int Dim>
talus::AnyShape<Dim> convex_shape(Generator& g, int kind, double scale) {
    if (kind == 0) return talus::Ball<Dim>(scale * uniform(g, 0.5, 1.0));
    if (kind == 1) {
        const double half_length = uniform(g, 0.3, 1.0);
        return talus::Capsule<Dim>(scale * half_length, scale * uniform(g, 0.2, 0.6));
    }
    if (kind == 2) {
        talus::Vector<Dim> h;
        for (int k = 0; k < Dim; ++k) h[k] = scale * uniform(g, 0.3, 1.0);
        return talus::Box<Dim>(h);
    }
    return talus::ConvexPolytope<Dim>(corners<Dim>(g, Dim == 2 ? 7 : 10, scale));
}

}  // namespace random_geometry
