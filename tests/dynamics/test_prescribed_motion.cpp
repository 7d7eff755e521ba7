// SPDX-License-Identifier: BSL-1.0
#include <talus/dynamics/prescribed_motion.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(dynamics_prescribed_motion)

BOOST_AUTO_TEST_CASE_TEMPLATE(pose_and_twist_of_a_uniform_motion_belong_together, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(61);
    const auto start = random_input::pose<Dim>(rng);
    const talus::Twist<Dim> twist{random_input::vector<talus::Vector<Dim>>(rng),
                                  random_input::vector<talus::AngularVector<Dim>>(rng)};
    const auto motion = talus::PrescribedMotion<Dim>::uniform(start, twist);
    const auto p = random_input::vector<talus::Vector<Dim>>(rng);
    const double t = 0.8, eps = 1e-6;  // central difference: error about eps^2
    const talus::Vector<Dim> seen =
        (motion.pose(t + eps).point_world(p) - motion.pose(t - eps).point_world(p)) / (2 * eps);
    const talus::Vector<Dim> arm = motion.pose(t).point_world(p) - motion.pose(t).position;
    BOOST_CHECK_SMALL((seen - motion.twist(t).at(arm)).norm(), 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_belt_stays_while_its_surface_moves, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(62);
    const auto at = random_input::pose<Dim>(rng);
    talus::Twist<Dim> surface;
    surface.linear[0] = 2.0;
    const auto belt = talus::PrescribedMotion<Dim>::belt(at, surface);
    BOOST_CHECK_EQUAL(belt.pose(5.0).position, at.position);
    BOOST_CHECK_EQUAL(belt.twist(5.0).linear[0], 2.0);
    const auto fixed = talus::PrescribedMotion<Dim>(at);
    BOOST_CHECK(fixed.twist(1.0).linear.isZero(0.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_shifted_obstacle_follows_any_function_of_time, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const auto motion = talus::PrescribedMotion<Dim>::shifted(
        {}, [](double t) { return V(std::sin(t) * V::Unit(1)); },
        [](double t) { return V(std::cos(t) * V::Unit(1)); });
    BOOST_CHECK_CLOSE(motion.pose(0.3).position[1], std::sin(0.3), 1e-12);
    BOOST_CHECK_CLOSE(motion.twist(0.3).linear[1], std::cos(0.3), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
