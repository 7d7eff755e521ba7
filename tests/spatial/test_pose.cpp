// SPDX-License-Identifier: BSL-1.0
#include <talus/spatial/pose.hpp>
#include <talus/spatial/twist.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(spatial_pose)

// Some ten roundings of numbers of order 1.
constexpr double tolerance = 4e-15;

BOOST_AUTO_TEST_CASE_TEMPLATE(poses_compose_and_invert, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(21);
    for (int k = 0; k < 20; ++k) {
        const auto outer = random_input::pose<Dim>(rng);
        const auto inner = random_input::pose<Dim>(rng);
        const auto p = random_input::vector<talus::Vector<Dim>>(rng);
        BOOST_CHECK_SMALL(
            ((outer * inner).point_world(p) - outer.point_world(inner.point_world(p))).norm(),
            tolerance);
        BOOST_CHECK_SMALL((outer.point_body(outer.point_world(p)) - p).norm(), tolerance);
        BOOST_CHECK_SMALL((outer.inverse().point_world(p) - outer.point_body(p)).norm(), tolerance);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(power_is_that_of_the_force_on_its_point, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(22);
    const talus::Twist<Dim> twist{random_input::vector<talus::Vector<Dim>>(rng),
                                  random_input::vector<talus::AngularVector<Dim>>(rng)};
    const auto arm = random_input::vector<talus::Vector<Dim>>(rng);
    const auto force = random_input::vector<talus::Vector<Dim>>(rng);
    const auto wrench = talus::Wrench<Dim>::at(arm, force);
    BOOST_CHECK_SMALL(talus::power(wrench, twist) - force.dot(twist.at(arm)), tolerance);
    talus::Wrench<Dim> twice = wrench;
    twice += wrench;
    BOOST_CHECK_SMALL(talus::power(twice, twist) - 2 * talus::power(wrench, twist), tolerance);
}

BOOST_AUTO_TEST_SUITE_END()
