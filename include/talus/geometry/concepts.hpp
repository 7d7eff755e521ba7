// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/aabb.hpp>
#include <talus/geometry/mass_properties.hpp>

#include <concepts>

namespace talus {

/// What any shape tells of itself: where it is when placed. Enough for an obstacle.
template <class S, int Dim>
concept Shape = std::copyable<S> && requires(const S& s, const Pose<Dim>& pose) {
    { s.aabb(pose) } -> std::convertible_to<Aabb<Dim>>;  // encloses the placed shape [m]
};

/// A shape with an inside that a body can be made of.
template <class S, int Dim>
concept SolidShape = Shape<S, Dim> && requires(const S& s, const Pose<Dim>& pose) {
    { s.mass_properties() } -> std::convertible_to<MassProperties<Dim>>;  // at unit density
    {
        s.placed(pose)
        } -> std::convertible_to<S>;  // the same shape seen from the frame in which its
                                      // present frame has this pose
};

/// A convex body known through its support mapping. The narrow phase accepts any model; those it
/// knows better (all of talus' own) have routines of their own.
template <class S, int Dim>
concept ConvexShape = Shape<S, Dim> && requires(const S& s, const Vector<Dim>& d) {
    {
        s.support(d)
        } -> std::convertible_to<Vector<Dim>>;  // farthest point along d, d of any length
                                                // but zero [m]
};

}  // namespace talus
