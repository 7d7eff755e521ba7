// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"

namespace {

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

template <int Dim>
struct Silent : Ellipsoid<Dim> {};

}  // namespace

namespace talus {
template <int Dim>
struct PairContacts<Dim, Silent<Dim>, Ball<Dim>> {
    static void append(const Silent<Dim>&, const Pose<Dim>&, const Ball<Dim>&, const Pose<Dim>&,
                       double, std::vector<ContactPoint<Dim>>& out) {
        out.push_back({Vector<Dim>::Zero(), Vector<Dim>::Unit(0), -1.0, {}});
    }
};
}  // namespace talus

BOOST_AUTO_TEST_SUITE(collision_own_shapes)

namespace {
const double accuracy = 1e-10;  // promised for smooth shapes of size one
}

BOOST_AUTO_TEST_CASE_TEMPLATE(round_ellipsoids_act_like_balls, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(14);
    const Ellipsoid<Dim> a{talus::Vector<Dim>::Constant(1.0)}, b{talus::Vector<Dim>::Constant(0.5)};
    for (int trial = 0; trial < 50; ++trial) {
        const auto at_a = random_geometry::pose<Dim>(g, 2.0),
                   at_b = random_geometry::pose<Dim>(g, 2.0);
        std::vector<talus::ContactPoint<Dim>> found, exact;
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
        std::vector<talus::ContactPoint<Dim>> found;
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
        std::vector<talus::ContactPoint<Dim>> found;
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
    std::vector<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(own, talus::Pose<Dim>{}, ball, talus::Pose<Dim>{}, 0.0, found);
    talus::contact_points<Dim>(ball, talus::Pose<Dim>{}, own, talus::Pose<Dim>{}, 0.0, found);
    BOOST_REQUIRE_EQUAL(found.size(), 2u);
    BOOST_CHECK_EQUAL(found[0].normal[0], 1.0);
    BOOST_CHECK_EQUAL(found[1].normal[0], -1.0);
}

BOOST_AUTO_TEST_SUITE_END()
