// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/spatial/inertia.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "upright.hpp"

namespace lab {

/// A voussoir: what joints towards the centre cut out of a ring between two radii [m]. Its shape
/// has straight sides; weight, centroid and inertia are those of the round one. Its frame is in the
/// centroid, axis 0 outwards.
template <int Dim>
class Voussoir {
  public:
    /// `half`: half the angle between its joints [rad]; `depth` in space [m]; density [kg/m^Dim].
    Voussoir(double inner, double outer, double half, double depth, double density)
        : inner_(inner), outer_(outer), half_(half), depth_(depth) {
        const double fourth = (std::pow(outer, 4) - std::pow(inner, 4)) / 4.0;
        const double area = half * (outer * outer - inner * inner);
        centroid_ = 2.0 / 3.0 * std::sin(half) * (std::pow(outer, 3) - std::pow(inner, 3)) / area;
        const double mass = density * area * (Dim == 2 ? 1.0 : depth), per_area = mass / area;
        const double outwards =
            per_area * fourth * (half + 0.5 * std::sin(2.0 * half)) - mass * centroid_ * centroid_;
        const double along = per_area * fourth * (half - 0.5 * std::sin(2.0 * half));
        const double deep = mass * depth * depth / 12.0;
        inertia.mass = mass;
        inertia.principal.fill(outwards + along);
        if constexpr (Dim == 3)
            inertia.principal << along + deep, outwards + along, outwards + deep;
    }

    talus::Inertia<Dim> inertia;

    talus::ConvexPolytope<Dim> shape() const {
        const auto corner = [&](double radius, double side) {
            return talus::Vector<2>(radius * std::cos(half_) - centroid_,
                                    side * radius * std::sin(half_));
        };
        const std::vector<talus::Vector<2>> outline{corner(inner_, -1), corner(outer_, -1),
                                                    corner(outer_, 1), corner(inner_, 1)};
        return upright_prism<Dim>(outline, depth_);
    }
    /// Where it is in the ring, at an angle from the axis along, about a point on the floor.
    talus::Pose<Dim> pose(double centre, double angle) const {
        return upright_pose<Dim>(centre + centroid_ * std::cos(angle), centroid_ * std::sin(angle),
                                 angle);
    }

  private:
    double inner_, outer_, half_, depth_, centroid_ = 0.0;
};

/// Thickness over mean radius that a semicircular arch of n voussoirs, an even number, must have to
/// stand under its own weight without sliding (V. Milankovitch 1907; Heyman 1969): with hinges at
/// the outer edges of crown and springings and at the inner edge of the joint where that is worst.
/// For an endless number of voussoirs 0.107478.
inline double least_arch_thickness(int n) {
    const auto stands = [n](double t) {
        const double pi = std::numbers::pi, inner = 1 - t / 2, outer = 1 + t / 2;
        const double moment = 1 + t * t / 12;  // about the crown's upright, of a part, over 1 - cos
        const double springing = (pi / 2 * outer - moment) / outer;  // thrust that it can take
        for (int k = 1; k < n / 2; ++k) {
            const double b = pi * k / n;  // from the crown
            const double needed = (b * inner * std::sin(b) - moment * (1 - std::cos(b))) /
                                  (outer - inner * std::cos(b));
            if (needed > springing) return false;
        }
        return true;
    };
    double low = 1e-6, high = 1.0;
    for (int k = 0; k < 60; ++k) (stands(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return high;
}

}  // namespace lab
