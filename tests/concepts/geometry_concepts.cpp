// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/concepts.hpp>

namespace geometry_concepts {

using talus::Aabb;
using talus::MassProperties;
using talus::Pose;
using talus::Vector;

/// The least that is a shape: it tells where it is.
template <int Dim>
struct Located {
    Aabb<Dim> aabb(const Pose<Dim>&) const;
};
static_assert(talus::Shape<Located<2>, 2> && talus::Shape<Located<3>, 3>);
static_assert(!talus::Shape<Located<2>, 3>, "a box of the plane encloses nothing in space");
static_assert(!talus::SolidShape<Located<3>, 3>, "no inside");
static_assert(!talus::ConvexShape<Located<3>, 3>, "no support mapping");

/// The least that is solid.
template <int Dim>
struct Filled : Located<Dim> {
    MassProperties<Dim> mass_properties() const;
    Filled placed(const Pose<Dim>&) const;
};
static_assert(talus::SolidShape<Filled<2>, 2> && talus::SolidShape<Filled<3>, 3>);

/// The least that is convex.
template <int Dim>
struct Convex : Located<Dim> {
    Vector<Dim> support(const Vector<Dim>&) const;
};
static_assert(talus::ConvexShape<Convex<2>, 2> && talus::ConvexShape<Convex<3>, 3>);
static_assert(!talus::SolidShape<Convex<2>, 2>, "an obstacle needs no mass");

// Near-misses.
struct NotConst {
    Aabb<2> aabb(const Pose<2>&);
};
static_assert(!talus::Shape<NotConst, 2>, "a shape answers without changing");

struct NotCopyable : Located<2> {
    NotCopyable(const NotCopyable&) = delete;
    NotCopyable& operator=(const NotCopyable&) = delete;
};
static_assert(!talus::Shape<NotCopyable, 2>, "shapes are values");

struct PlacesAnother : Located<3> {
    MassProperties<3> mass_properties() const;
    Located<3> placed(const Pose<3>&) const;
};
static_assert(!talus::SolidShape<PlacesAnother, 3>, "placing a shape gives the same kind of shape");

struct ScalarSupport : Located<2> {
    double support(const Vector<2>&) const;
};
static_assert(!talus::ConvexShape<ScalarSupport, 2>, "the support is a point, not a distance");

}  // namespace geometry_concepts
