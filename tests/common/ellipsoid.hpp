// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/aabb.hpp>
#include <talus/spatial/pose.hpp>

#include <Eigen/Core>

/// Ellipse or ellipsoid, as a user would add it: by its support mapping alone.
template <int Dim>
struct Ellipsoid {
    talus::Vector<Dim> semi_axes;

    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const {
        const talus::Vector<Dim> scaled = semi_axes.cwiseProduct(d);
        return semi_axes.cwiseProduct(scaled) / scaled.norm();
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        const talus::Matrix<Dim> r = pose.rotation.matrix();
        const talus::Vector<Dim> half = (r * semi_axes.asDiagonal()).rowwise().norm();
        return {pose.position - half, pose.position + half};
    }
};
