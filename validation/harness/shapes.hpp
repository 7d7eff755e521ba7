// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/half_space.hpp>

#include <limits>
#include <type_traits>

/// Shapes that the cases need beside those of talus, made as a user would.
namespace validation {

/// A segment along the first body axis, centred.
template <int Dim>
struct Rod {
    double length;  ///< [m]

    talus::Vector<Dim> end(double sign) const {
        return 0.5 * sign * length * talus::Vector<Dim>::Unit(0);
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        talus::Aabb<Dim> box;
        box.include(pose.point_world(end(1)));
        box.include(pose.point_world(end(-1)));
        return box;
    }
    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const { return end(d[0] < 0 ? -1 : 1); }
};
static_assert(talus::ConvexShape<Rod<2>, 2> && talus::ConvexShape<Rod<3>, 3>);

/// The edge of a disc without thickness, in the plane of the first two body axes.
struct Rim {
    double radius;  ///< [m]

    talus::Aabb<3> aabb(const talus::Pose<3>& pose) const {
        talus::Vector<3> reach;
        for (int k = 0; k < 3; ++k) {
            const auto axis = pose.rotation.transpose_times(talus::Vector<3>::Unit(k));
            reach[k] = radius * axis.head<2>().norm();
        }
        return {pose.position - reach, pose.position + reach};
    }
    talus::Vector<3> support(const talus::Vector<3>& d) const {
        talus::Vector<3> flat(d[0], d[1], 0.0);
        if (flat.isZero(0.0)) flat[0] = 1.0;
        return radius * flat.normalized();
    }
};
static_assert(talus::ConvexShape<Rim, 3>);

/// The outside of a circle or sphere: an obstacle whose inside is hollow.
template <int Dim>
struct Bowl {
    double radius;  ///< [m]

    talus::Aabb<Dim> aabb(const talus::Pose<Dim>&) const {
        const double infinity = std::numeric_limits<double>::infinity();
        return {talus::Vector<Dim>::Constant(-infinity), talus::Vector<Dim>::Constant(infinity)};
    }
};
static_assert(talus::Shape<Bowl<2>, 2> && talus::Shape<Bowl<3>, 3>);

template <int Dim, class... More>
using ShapeOf = talus::AnyShapeOf<Dim, talus::Ball<Dim>, talus::HalfSpace<Dim>, talus::Box<Dim>,
                                  talus::ConvexPolytope<Dim>, Rod<Dim>, Bowl<Dim>, More...>;
template <int Dim>
using ShapeType = typename std::conditional_t<Dim == 2, std::type_identity<ShapeOf<2>>,
                                              std::type_identity<ShapeOf<3, Rim>>>::type;

}  // namespace validation

/// A ball within the bowl touches it where it is farthest from the bowl's centre.
template <int Dim>
struct talus::PairContacts<Dim, talus::Ball<Dim>, validation::Bowl<Dim>> {
    static void append(const Ball<Dim>& ball, const Pose<Dim>& at,
                       const validation::Bowl<Dim>& bowl, const Pose<Dim>& around, double margin,
                       Column<ContactPoint<Dim>>& out) {
        const Vector<Dim> from_centre = at.position - around.position;
        const double distance = from_centre.norm();
        const double gap = bowl.radius - ball.radius() - distance;
        if (gap > margin || distance == 0.0) return;
        const Vector<Dim> outwards = from_centre / distance;
        // Half-way between the two surfaces, as everywhere in talus.
        const double r = 0.5 * (bowl.radius + ball.radius() + distance);
        out.push_back({around.position + r * outwards, -outwards, gap, {}});
    }
};
/// Nothing but balls is put into bowls.
template <int Dim, class Other>
struct talus::PairContacts<Dim, validation::Bowl<Dim>, Other> {
    static void append(const validation::Bowl<Dim>&, const Pose<Dim>&, const Other&,
                       const Pose<Dim>&, double,
                       Column<ContactPoint<Dim>>&) requires(!std::same_as<Other, Ball<Dim>>) {}
};
