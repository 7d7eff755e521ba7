// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

/// Distances of convex bodies by trying everything: the differences of their corners span the
/// Minkowski difference, and all its triangles (segments in the plane) are tried. Slow, and without
/// a decision that rounding could turn.
template <int Dim>
class Minkowski {
  public:
    using Vector = talus::Vector<Dim>;
    using Points = std::vector<Vector>;

    /// Of two bodies given by their corners in the world.
    Minkowski(const Points& a, const Points& b) {
        for (const Vector& p : a)
            for (const Vector& q : b) differences_.push_back(p - q);
    }

    /// Apart: the distance. Overlapping: minus the shortest way out.
    double signed_distance() const {
        double separation = -std::numeric_limits<double>::infinity();
        double distance = std::numeric_limits<double>::infinity();
        const std::size_t n = differences_.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                distance = std::min(distance, to_segment(i, j));
                if constexpr (Dim == 2) {
                    const Vector side = differences_[j] - differences_[i];
                    try_normal({-side[1], side[0]}, side.squaredNorm(), separation);
                } else {
                    for (std::size_t k = 0; k < j; ++k) try_triangle(i, j, k, separation, distance);
                }
            }
        return separation > 0.0 ? distance : separation;
    }

  private:
    double to_segment(std::size_t i, std::size_t j) const {
        const Vector side = differences_[j] - differences_[i];
        const double s = -side.dot(differences_[i]) / side.squaredNorm();
        return (differences_[i] + (s > 0.0 ? std::min(s, 1.0) : 0.0) * side).norm();
    }
    /// Every unit vector tells a lower bound of the signed distance.
    void try_normal(const Vector& normal, double scale, double& separation) const {
        const double length = normal.norm();
        if (length <= 1e-9 * scale) return;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const Vector& d : differences_) {
            least = std::min(least, normal.dot(d));
            most = std::max(most, normal.dot(d));
        }
        separation = std::max({separation, least / length, -most / length});
    }
    void try_triangle(std::size_t i, std::size_t j, std::size_t k, double& separation,
                      double& distance) const requires(Dim == 3) {
        const Vector &a = differences_[i], ab = differences_[j] - a, ac = differences_[k] - a;
        const Vector normal = ab.cross(ac);
        try_normal(normal, ab.norm() * ac.norm(), separation);
        if (normal.norm() <= 1e-9 * ab.norm() * ac.norm()) return;
        Eigen::Matrix3d m;
        m << ab, ac, normal;
        const Vector weights = m.inverse() * -a;
        if (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[0] + weights[1] <= 1.0)
            distance = std::min(distance, std::abs(normal.dot(a)) / normal.norm());
    }

    Points differences_;
};
