// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/ellipsoid.hpp"
#include "common/random_geometry.hpp"

namespace own_shapes {

template <int Dim>
struct Silent : Ellipsoid<Dim> {};

/// An ellipsoid that knows where it is and what it weighs, so that it can be a child.
template <int Dim>
struct Egg {
    talus::Vector<Dim> semi_axes;
    talus::Pose<Dim> pose = {};

    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const {
        return pose.point_world(
            Ellipsoid<Dim>{semi_axes}.support(pose.rotation.transpose_times(d)));
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& at) const {
        return Ellipsoid<Dim>{semi_axes}.aabb(at * pose);
    }
    talus::MassProperties<Dim> mass_properties() const {
        return {1.0, pose.position, talus::AngularMatrix<Dim>::Identity()};
    }
    Egg placed(const talus::Pose<Dim>& at) const { return {semi_axes, at * pose}; }
};

/// Has neither core nor support: only its own routine lets it meet balls.
template <int Dim>
struct Ghost {
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        return {pose.position - talus::Vector<Dim>::Ones(),
                pose.position + talus::Vector<Dim>::Ones()};
    }
    talus::MassProperties<Dim> mass_properties() const {
        return {1.0, talus::Vector<Dim>::Zero(), talus::AngularMatrix<Dim>::Identity()};
    }
    Ghost placed(const talus::Pose<Dim>&) const { return *this; }
};

}  // namespace own_shapes

using namespace own_shapes;

namespace talus {
template <int Dim>
struct PairContacts<Dim, Silent<Dim>, Ball<Dim>> {
    static void append(const Silent<Dim>&, const Pose<Dim>&, const Ball<Dim>&, const Pose<Dim>&,
                       double, Column<ContactPoint<Dim>>& out) {
        out.push_back({Vector<Dim>::Zero(), Vector<Dim>::Unit(0), -1.0, {}});
    }
};
template <int Dim>
struct PairContacts<Dim, Ghost<Dim>, Ball<Dim>> {
    static void append(const Ghost<Dim>&, const Pose<Dim>&, const Ball<Dim>& ball, const Pose<Dim>&,
                       double, Column<ContactPoint<Dim>>& out) {
        out.push_back({Vector<Dim>::Zero(), Vector<Dim>::Unit(0), -ball.radius(), {}});
    }
};
}  // namespace talus

static_assert(talus::CanMeet<Ghost<2>, talus::Ball<2>, 2>);
static_assert(talus::CanMeet<talus::CompoundOf<3, Ghost<3>>, talus::Ball<3>, 3>);
static_assert(!talus::CanMeet<Ghost<2>, Ghost<2>, 2>);
static_assert(!talus::CanMeet<talus::AnyShape<3>, Ghost<3>, 3>);

BOOST_AUTO_TEST_SUITE(collision_own_shapes)

constexpr double accuracy = 1e-10;  // promised for smooth shapes of size one

BOOST_AUTO_TEST_CASE_TEMPLATE(round_ellipsoids_act_like_balls, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(14);
    const Ellipsoid<Dim> a{talus::Vector<Dim>::Constant(1.0)}, b{talus::Vector<Dim>::Constant(0.5)};
    for (int trial = 0; trial < 50; ++trial) {
        const auto at_a = random_geometry::pose<Dim>(g, 2.0),
                   at_b = random_geometry::pose<Dim>(g, 2.0);
        talus::Column<talus::ContactPoint<Dim>> found, exact;
        talus::contact_points<Dim>(a, at_a, b, at_b, 1.0, found);
        talus::contact_points<Dim>(talus::Ball<Dim>(1.0), at_a, talus::Ball<Dim>(0.5), at_b, 1.0,
                                   exact);
        BOOST_REQUIRE_EQUAL(found.size(), exact.size());
        if (found.empty()) continue;
        BOOST_CHECK_SMALL(found[0].gap - exact[0].gap, accuracy);
        BOOST_CHECK_SMALL((found[0].normal - exact[0].normal).norm(), 1e-5);
        BOOST_CHECK_EQUAL(found[0].feature.code, 0u);
    }
}

/// Optimality: at the nearest points, or of least overlap, the difference of the two supports is
/// along the normal; and no sampled direction separates better.
BOOST_AUTO_TEST_CASE_TEMPLATE(ellipsoids_touch_where_their_normals_are_opposite, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(15);
    int overlapping = 0;
    for (int trial = 0; trial < 100; ++trial) {
        talus::Vector<Dim> p = talus::Vector<Dim>::Constant(0.6), q = p;
        p[0] = 1.0;
        q[1] = 0.9;
        const Ellipsoid<Dim> a{p}, b{q};
        const auto at_a = random_geometry::pose<Dim>(g, 1.0),
                   at_b = random_geometry::pose<Dim>(g, 1.0);
        talus::Column<talus::ContactPoint<Dim>> found;
        talus::contact_points<Dim>(a, at_a, b, at_b, 3.0, found);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        const auto& c = found[0];
        overlapping += c.gap < 0.0;
        const auto separation = [&](const talus::Vector<Dim>& n) {
            return n.dot(at_a.point_world(a.support(at_a.rotation.transpose_times(-n))) -
                         at_b.point_world(b.support(at_b.rotation.transpose_times(n))));
        };
        BOOST_CHECK_SMALL(separation(c.normal) - c.gap, accuracy);
        for (int i = 0; i < 500; ++i)
            BOOST_CHECK_LE(separation(random_geometry::direction<Dim>(g)), c.gap + accuracy);
        for (int i = 0; i < 50; ++i)
            BOOST_CHECK_LE(
                separation((c.normal + 1e-3 * random_geometry::direction<Dim>(g)).normalized()),
                c.gap + accuracy);
    }
    BOOST_CHECK_GT(overlapping, 20);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_ellipsoid_rests_on_floors_and_talus_shapes, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Vector<Dim> axes = talus::Vector<Dim>::Constant(1.0);
    axes[Dim - 1] = 0.5;
    const Ellipsoid<Dim> egg{axes};
    talus::Pose<Dim> at;
    at.position[Dim - 1] = 0.99;
    const talus::AnyShape<Dim> bases[] = {
        talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1), 0.5),
        talus::Box<Dim>(talus::Vector<Dim>::Constant(0.5)), talus::Ball<Dim>(0.5)};
    for (const auto& base : bases) {
        talus::Column<talus::ContactPoint<Dim>> found;
        talus::contact_points<Dim>(egg, at, base, talus::Pose<Dim>{}, 0.0, found);
        talus::contact_points<Dim>(base, talus::Pose<Dim>{}, egg, at, 0.0, found);
        BOOST_REQUIRE_EQUAL(found.size(), 2u);
        BOOST_CHECK_SMALL(found[0].gap + 0.01, accuracy);
        BOOST_CHECK_SMALL(found[1].gap + 0.01, accuracy);
        BOOST_CHECK_SMALL((found[0].normal - talus::Vector<Dim>::Unit(Dim - 1)).norm(), 1e-5);
        BOOST_CHECK_SMALL((found[0].normal + found[1].normal).norm(), 1e-5);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_routine_of_ones_own_is_preferred_in_either_order, D, dimensions) {
    constexpr int Dim = D::value;
    const Silent<Dim> own{{talus::Vector<Dim>::Constant(1.0)}};
    const talus::AnyShape<Dim> ball = talus::Ball<Dim>(1.0);
    talus::Column<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(own, talus::Pose<Dim>{}, ball, talus::Pose<Dim>{}, 0.0, found);
    talus::contact_points<Dim>(ball, talus::Pose<Dim>{}, own, talus::Pose<Dim>{}, 0.0, found);
    BOOST_REQUIRE_EQUAL(found.size(), 2u);
    BOOST_CHECK_EQUAL(found[0].normal[0], 1.0);
    BOOST_CHECK_EQUAL(found[1].normal[0], -1.0);
}

/// Two eggs side by side, a ball above: the first overlaps a floor by 0.01 with its flat pole, the
/// second by as much with its sharp one, and the ball hangs 0.2 over it.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_compound_of_own_shapes_stands_on_its_children, D, dimensions) {
    constexpr int Dim = D::value;
    using Child = talus::AnyShapeOf<Dim, Egg<Dim>, talus::Ball<Dim>>;
    const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1),
                             side = talus::Vector<Dim>::Unit(0);
    talus::Vector<Dim> flat = talus::Vector<Dim>::Constant(1.0);
    flat[Dim - 1] = 0.5;
    talus::Vector<Dim> sharp = talus::Vector<Dim>::Constant(0.5);
    sharp[Dim - 1] = 1.0;
    const talus::CompoundOf<Dim, Child> clump(
        {{Egg<Dim>{flat}, {talus::Vector<Dim>(-2.0 * side + 0.49 * up), {}}},
         {Egg<Dim>{sharp}, {talus::Vector<Dim>(2.0 * side + 0.99 * up), {}}},
         {talus::Ball<Dim>(0.5), {talus::Vector<Dim>(2.0 * side + 0.7 * up), {}}}});
    const talus::HalfSpace<Dim> floor(up);
    const talus::AnyShapeOf<Dim, talus::CompoundOf<Dim, Child>, talus::HalfSpace<Dim>> held = clump;

    talus::Column<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(held, talus::Pose<Dim>{}, floor, talus::Pose<Dim>{}, 0.0, found);
    BOOST_REQUIRE_EQUAL(found.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        BOOST_CHECK_SMALL(found[i].gap + 0.01, accuracy);
        BOOST_CHECK_SMALL((found[i].normal - up).norm(), accuracy);
        BOOST_CHECK_SMALL(std::abs(found[i].point[0]) - 2.0, accuracy);
        BOOST_CHECK(found[i].feature == talus::feature_code({{}, 0, static_cast<unsigned>(i)}, {}));
    }
    // A ball of radius one beside the flat egg, 0.1 off its end.
    talus::Pose<Dim> at;
    at.position = -4.1 * side + 0.49 * up;
    found.clear();
    talus::contact_points<Dim>(talus::Ball<Dim>(1.0), at, held, talus::Pose<Dim>{}, 0.2, found);
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    BOOST_CHECK_SMALL(found[0].gap - 0.1, accuracy);
    BOOST_CHECK_SMALL((found[0].normal + side).norm(), 1e-5);
    BOOST_CHECK_SMALL((found[0].point - (-3.05 * side + 0.49 * up)).norm(), 1e-5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_child_meets_by_its_own_routine, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::CompoundOf<Dim, Ghost<Dim>> pair({{Ghost<Dim>{}, {}}, {Ghost<Dim>{}, {}}});
    talus::Column<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(pair, talus::Pose<Dim>{}, talus::Ball<Dim>(0.7), talus::Pose<Dim>{},
                               0.0, found);
    talus::contact_points<Dim>(talus::Ball<Dim>(0.7), talus::Pose<Dim>{}, pair, talus::Pose<Dim>{},
                               0.0, found);
    BOOST_REQUIRE_EQUAL(found.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        BOOST_CHECK_EQUAL(found[i].gap, -0.7);
        BOOST_CHECK_EQUAL(found[i].normal[0], i < 2 ? 1.0 : -1.0);
    }
    BOOST_CHECK(found[1].feature == talus::with_child_of_a({}, 1));
    BOOST_CHECK(found[3].feature == talus::with_child_of_b({}, 1));
}

BOOST_AUTO_TEST_SUITE_END()
