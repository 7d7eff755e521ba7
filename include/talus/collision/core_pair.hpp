// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/collision/gjk.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/spatial/pose.hpp>

#include <algorithm>

namespace talus {

/// Tolerances of the narrow phase, all relative, so that grains of a micron and of a metre are
/// treated alike. Lengths are in units of CorePair::size.
struct NarrowPhaseTolerance {
    /// A vertex this far outside a face still counts as on it, and points within four times this
    /// are one: keeps the codes of boxes stacked exactly upon each other through rounding. Much
    /// larger values would move contacts visibly, smaller ones let codes flicker.
    static constexpr double lateral = 1e-7;
    /// An axis must be better by this to replace one found before it (faces of A, faces of B,
    /// pairs of edges); also how well a face's contacts must attain the best separation.
    static constexpr double preference = 1e-6;
    /// A face turned by less than this [rad] from the best axis supplies the normal, if its
    /// contacts attain the best separation: so a rocking box keeps face normals. The gap is exact
    /// along the normal, and longer than the shortest way by at most half the square of this.
    static constexpr double alignment = 1e-2;
    /// The same for rounded shapes [rad], smaller since there the excess is of the distance of the
    /// cores: 5e-7 of the rounding.
    static constexpr double alignment_rounded = 1e-3;
    /// Edges of rounded shapes this nearly parallel [rad] touch at both ends of their overlap.
    static constexpr double parallel_rounded = 0.1;
};

/// Two cores, and where B stands in the frame of A.
template <int Dim>
struct CorePair {
    CoreView<Dim> a, b;
    Matrix<Dim> rotation;  ///< axes of B to axes of A
    Vector<Dim> shift;     ///< origin of B in A [m]
    double size;           ///< scale of the tolerances: the smaller bound [m]
    double slack;          ///< nearer than this, faces of rounded corners touch [m]

    CorePair(const CoreView<Dim>& core_a, const Pose<Dim>& pose_a, const CoreView<Dim>& core_b,
             const Pose<Dim>& pose_b)
        : a(core_a),
          b(core_b),
          rotation((pose_a.rotation.inverse() * pose_b.rotation).matrix()),
          shift(pose_a.rotation.transpose_times(pose_b.position - pose_a.position)),
          // The millionth of the larger keeps the tolerances above the rounding of its coordinates.
          size(std::min(a.bound, b.bound) + 1e-6 * std::max(a.bound, b.bound)),
          slack(a.slack + b.slack) {}

    /// The same two, seen from B, which then is called A.
    CorePair exchanged() const {
        CorePair p = *this;
        std::swap(p.a, p.b);
        p.rotation = rotation.transpose();
        p.shift = -(p.rotation * shift);
        return p;
    }
    double rounding() const { return a.radius + b.radius; }  ///< [m]
    /// How much better an axis must be to replace one found before it [m].
    double preference() const { return NarrowPhaseTolerance::preference * size + slack; }
    Vector<Dim> in_a(const Vector<Dim>& point_b) const { return rotation * point_b + shift; }
    Vector<Dim> in_b(const Vector<Dim>& point_a) const {
        return rotation.transpose() * (point_a - shift);
    }
    Vector<Dim> direction_in_b(const Vector<Dim>& d) const { return rotation.transpose() * d; }
    /// Farthest point of A along d, and of B along -d, in the frame of A; without rounding.
    DifferencePoint<Dim> support(const Vector<Dim>& d) const {
        return {a.vertices[support_index(a, d)],
                in_a(b.vertices[support_index<Dim>(b, direction_in_b(-d))])};
    }
};

/// Where contacts of one pair of cores go: to `out`, in world axes, with the codes of this pair.
template <int Dim>
struct ContactSink {
    Column<ContactPoint<Dim>>& out;
    std::size_t first;       ///< of this pair of cores in `out`
    Pose<Dim> pose;          ///< of A's frame, in which contacts are given
    bool exchanged = false;  ///< A and B have changed places: mirror what is added

    /// `point` and `normal` in the frame of A.
    void add(const Vector<Dim>& point, const Vector<Dim>& normal, double gap, const Feature& a,
             const Feature& b) const {
        const Vector<Dim> n = pose.rotation * normal;
        if (exchanged)
            out.push_back({pose.point_world(point), -n, gap, feature_code(b, a)});
        else
            out.push_back({pose.point_world(point), n, gap, feature_code(a, b)});
    }
    /// Whether a contact of this pair stands within `reach` [m] of `point` (frame of A).
    bool occupied(const Vector<Dim>& point, double reach) const {
        const Vector<Dim> p = pose.point_world(point);
        return std::any_of(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                           [&](const auto& c) { return (c.point - p).norm() <= reach; });
    }
};

}  // namespace talus
