// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Dense>
#include <Eigen/LU>

#include <algorithm>
#include <vector>

#include "harness/case.hpp"

/// A semicircular arch of mean radius 1 and thickness t, of n equal voussoirs with radial joints on
/// a floor; specific weight 1.
namespace validation {

// --- reference: the safe theorem as a linear program, no line of talus ---------------------------

/// Half an arch from the crown down is held by a horizontal thrust H and a moment M at the crown
/// (symmetry leaves no vertical force there; averaging a solution with its mirror image keeps it
/// one). At every joint the resultant has to pass between the corners and within the cone of
/// friction: inequalities that are linear in (H, M), so that the question is whether a polygon in
/// two dimensions is empty.
class ArchStatics {
  public:
    /// mu < 0: no sliding.
    ArchStatics(int voussoirs, double thickness, double mu)
        : inner_(1 - thickness / 2), outer_(1 + thickness / 2), mu_(mu) {
        for (int j = 0; j <= voussoirs; ++j) {
            const double angle = pi * (0.5 - static_cast<double>(j) / voussoirs);  // from the crown
            if (angle >= -1e-12) add_joint(std::max(angle, 0.0));
        }
    }
    /// Whether forces exist that hold the arch.
    bool stands() const {
        if (feasible(0.0, 0.0)) return true;
        for (std::size_t i = 0; i < rows_.size(); ++i)
            for (std::size_t k = i + 1; k < rows_.size(); ++k) {
                Eigen::Matrix2d a;
                a << rows_[i][0], rows_[i][1], rows_[k][0], rows_[k][1];
                if (std::abs(a.determinant()) < 1e-14) continue;
                const Eigen::Vector2d x = a.inverse() * Eigen::Vector2d(rows_[i][2], rows_[k][2]);
                if (feasible(x[0], x[1])) return true;
            }
        return false;
    }

  private:
    /// Weight of the part between the crown and `angle`, and its moment about the crown's vertical.
    void add_joint(double angle) {
        const double area = 0.5 * (outer_ * outer_ - inner_ * inner_) * angle;
        const double moment =
            (outer_ * outer_ * outer_ - inner_ * inner_ * inner_) / 3 * (1 - std::cos(angle));
        const double s = std::sin(angle), c = std::cos(angle);
        // The thrust H acts on the part at the crown at height M / H above the centre. The joint
        // receives H outwards and the weight downwards; its normal component is compressive.
        // Moment of all loads on the part about the corner at radius r:
        //   H (y_thrust - r c) pushes the crown end over the corner, the weight turns back.
        // Passing inside the outer and outside the inner corner:
        //   M - H outer c - (outer s area - moment) <= 0
        //   M - H inner c - (inner s area - moment) >= 0
        rows_.push_back({-outer_ * c, 1.0, outer_ * s * area - moment});
        rows_.push_back({inner_ * c, -1.0, -(inner_ * s * area - moment)});
        if (mu_ >= 0.0) {
            // N = H c + V s, T = H s - V c with V = area.
            rows_.push_back({s - mu_ * c, 0.0, area * (c + mu_ * s)});
            rows_.push_back({-s - mu_ * c, 0.0, area * (mu_ * s - c)});
        }
    }
    bool feasible(double thrust, double moment) const {
        return std::all_of(rows_.begin(), rows_.end(), [&](const Eigen::Vector3d& row) {
            return row[0] * thrust + row[1] * moment <= row[2] + 1e-12;
        });
    }

    double inner_, outer_, mu_;
    std::vector<Eigen::Vector3d> rows_;  // row . (H, M) <= last
};

/// Smallest value of a parameter for which `stands(value)` holds, standing at `high`.
template <class Stands>
double least(double low, double high, const Stands& stands) {
    for (int k = 0; k < 60; ++k) {
        const double mid = 0.5 * (low + high);
        (stands(mid) ? high : low) = mid;
    }
    return high;
}

// --- the arch of talus
// ----------------------------------------------------------------------------

/// Voussoir k has the outline of its chords but weight, centroid and inertia of the true sector.
inline World<2> arch(Trial<2>& trial, int n, double thickness, double mu, double h) {
    auto world = trial.world(
        {.h = h, .contact = law<2>(mu), .solver = {.max_sweeps = 2000000, .tolerance = 1e-12}});
    world.add_floor();
    const double inner = 1 - thickness / 2, outer = 1 + thickness / 2;
    const double half = 0.5 * pi / n;
    const double area = half * (outer * outer - inner * inner);
    const double centroid = 2.0 / 3 * std::sin(half) / half *
                            (outer * outer * outer - inner * inner * inner) /
                            (outer * outer - inner * inner);
    const double mass = area / g;
    const double polar = mass / 2 * (outer * outer + inner * inner) - mass * centroid * centroid;
    const auto polar_point = [](double r, double angle) {
        return V<2>(r * std::cos(angle), r * std::sin(angle));
    };
    // Seen with its own axis of symmetry along the first axis.
    const auto corner = [&](double r, double side) {
        return V<2>(polar_point(r, side * half) - V<2>(centroid, 0.0));
    };
    const talus::ConvexPolytope<2> voussoir(
        {corner(inner, -1), corner(outer, -1), corner(outer, 1), corner(inner, 1)});
    for (int k = 0; k < n; ++k) {
        const double angle = (2 * k + 1) * half;
        world.add(voussoir, {mass, W<2>(polar)},
                  {polar_point(centroid, angle), talus::Rotation<2>::exp(W<2>(angle))});
    }
    return world;
}

}  // namespace validation
