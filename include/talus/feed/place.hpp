// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/random.hpp>
#include <talus/spatial/rotation.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace talus {

/// Where a new body is tried: a point drawn at random [m].
template <int Dim>
using Place = std::function<Vector<Dim>(Random&)>;

/// Always the same point.
template <int Dim>
Place<Dim> at_point(const Vector<Dim>& x) {
    require_finite("place", x);
    return [x](Random&) { return x; };
}

/// Anywhere on the segment between two points.
template <int Dim>
Place<Dim> on_segment(const Vector<Dim>& from, const Vector<Dim>& to) {
    require_finite("end of the segment", from);
    require_finite("end of the segment", to);
    return
        [from, to](Random& random) { return Vector<Dim>(from + random.uniform() * (to - from)); };
}

/// Anywhere in the box between two corners; equal coordinates make it a surface. Throws input_error
/// unless low <= high along each axis.
template <int Dim>
Place<Dim> in_box(const Vector<Dim>& low, const Vector<Dim>& high) {
    require_finite("low corner of the box", low);
    require_finite("high corner of the box", high);
    for (int k = 0; k < Dim; ++k) require_in("high corner of the box", high[k], low[k], 1e300);
    return [low, high](Random& random) {
        Vector<Dim> x;
        for (int k = 0; k < Dim; ++k) x[k] = random.uniform(low[k], high[k]);
        return x;
    };
}

/// Anywhere within a distance of a point, on the surface across an axis through it: a segment in
/// the plane, a disc in space. Throws input_error unless the radius is positive and the axis has a
/// length.
template <int Dim>
Place<Dim> in_disc(const Vector<Dim>& centre, double radius, const Vector<Dim>& axis) {
    require_finite("centre of the disc", centre);
    require_positive("radius of the disc", radius);
    const Vector<Dim> normal = axis / require_positive("length of the disc's axis", axis.norm());
    return [centre, radius, normal](Random& random) {
        for (;;) {
            Vector<Dim> x;
            for (int k = 0; k < Dim; ++k) x[k] = random.uniform(-1.0, 1.0);
            if (x.norm() > 1.0) continue;
            // Points of a ball have all directions across the axis; the length is drawn anew.
            x -= normal.dot(x) * normal;
            const double length = x.norm();
            if (length < 1e-3) continue;  // whose direction would be rounding
            const double share = std::pow(random.uniform(), 1.0 / (Dim - 1));
            return Vector<Dim>(centre + radius * share / length * x);
        }
    };
}

/// Any rotation, all as likely as each other [Shoemake1992].
template <int Dim>
Rotation<Dim> random_rotation(Random& random) {
    if constexpr (rotation_dof<Dim> == 1) {
        return Rotation<Dim>::exp(
            AngularVector<Dim>::Constant(random.uniform(-std::numbers::pi, std::numbers::pi)));
    } else {
        const double u = random.uniform();
        const double a = random.uniform(0.0, 2.0 * std::numbers::pi);
        const double b = random.uniform(0.0, 2.0 * std::numbers::pi);
        return Rotation<Dim>(
            Quaternion(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                       std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)));
    }
}

}  // namespace talus
