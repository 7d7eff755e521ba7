// SPDX-License-Identifier: BSL-1.0
#include <talus/dynamics/place.hpp>
#include <talus/dynamics/prescribed_motion.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <string>

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

BOOST_AUTO_TEST_CASE_TEMPLATE(a_motion_of_a_pose_alone_has_the_twist_of_its_pose, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    talus::AngularVector<Dim> spin = talus::AngularVector<Dim>::Ones();
    const auto motion = talus::PrescribedMotion<Dim>::of_pose([=](double t) {
        return talus::Pose<Dim>{V(0.2 * std::sin(300.0 * t) * V::Unit(1)),
                                talus::Rotation<Dim>::exp(t * spin)};
    });
    for (const double t : {0.0, 0.1234, 7.7}) {
        BOOST_TEST(std::abs(motion.twist(t).linear[1] - 60.0 * std::cos(300.0 * t)) < 1e-7);
        BOOST_TEST((motion.twist(t).angular - spin).norm() < 1e-8);
    }
    BOOST_CHECK_THROW(
        talus::PrescribedMotion<Dim>::of_pose([&](double t) { return motion.pose(t); }, 0.0),
        talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_table_of_displacements_is_met_and_smooth, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    // A parabola is a cubic's own: exact away from the ends, on uneven times too.
    const std::vector<double> time{0.0, 0.5, 0.7, 1.5, 2.0};
    std::vector<V> place;
    for (const double t : time) place.push_back(t * t * V::Unit(0));
    const auto motion = talus::PrescribedMotion<Dim>::of_displacements({}, time, place);
    for (std::size_t k = 0; k < time.size(); ++k)
        BOOST_TEST((motion.pose(time[k]).position - place[k]).norm() < 1e-15);
    for (const double t : {0.55, 0.7, 1.1}) {
        BOOST_TEST(std::abs(motion.pose(t).position[0] - t * t) < 1e-14);
        BOOST_TEST(std::abs(motion.twist(t).linear[0] - 2.0 * t) < 1e-13);
    }
    BOOST_TEST(motion.twist(-1.0).linear.is_zero());
    BOOST_TEST(motion.pose(9.0).position[0] == 4.0);
    BOOST_TEST(motion.twist(9.0).linear.is_zero());
    BOOST_CHECK_THROW(talus::PrescribedMotion<Dim>::of_displacements({}, {0.0, 0.0}, {V(), V()}),
                      talus::input_error);
    BOOST_CHECK_THROW(talus::PrescribedMotion<Dim>::of_displacements({}, {0.0}, {V()}),
                      talus::input_error);
    BOOST_CHECK_THROW(talus::PrescribedMotion<Dim>::of_displacements({}, {0.0, 1.0}, {V()}),
                      talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_record_of_accelerations_is_integrated_exactly, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    // a = 6 t up to 1 s, then -6 (a sudden turn takes a short piece), to rest at 1.5 s.
    const auto motion = talus::PrescribedMotion<Dim>::of_accelerations(
        {}, {0.0, 1.0, 1.0 + 1e-12, 1.5},
        {V::Zero(), 6.0 * V::Unit(1), -6.0 * V::Unit(1), -6.0 * V::Unit(1)});
    const auto close = [](double a, double b) { return std::abs(a - b) < 1e-10; };
    BOOST_TEST(close(motion.pose(0.5).position[1], 0.125));
    BOOST_TEST(close(motion.twist(0.5).linear[1], 0.75));
    BOOST_TEST(close(motion.pose(1.0).position[1], 1.0));
    BOOST_TEST(close(motion.twist(1.2).linear[1], 3.0 - 6.0 * 0.2));
    BOOST_TEST(close(motion.twist(3.0).linear[1], 0.0));
    BOOST_TEST(close(motion.pose(3.0).position[1], 1.0 + 0.75));
    BOOST_TEST(motion.pose(-1.0).position.is_zero());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_twist_that_is_not_of_its_pose_is_refused, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const auto pose = [](double t) {
        return talus::Pose<D::value>{V(0.1 * std::sin(5.0 * t) * V::Unit(1)), {}};
    };
    const auto still = [](double) { return talus::Twist<D::value>{}; };
    const auto right = [](double t) {
        return talus::Twist<D::value>{V(0.5 * std::cos(5.0 * t) * V::Unit(1))};
    };
    using Motion = talus::PrescribedMotion<Dim>;
    talus::Bodies<Dim> bodies;
    bodies.add_obstacle({});
    for (const double t : {0.0, 0.3, 2.0}) {
        BOOST_CHECK_THROW(talus::place(bodies, 0, Motion(pose, still), t, 1e-6),
                          talus::input_error);
        talus::place(bodies, 0, Motion(pose, right), t, 1e-6);
        talus::place(bodies, 0, Motion(pose, still).with_surface(still), t, 1e-6);
        talus::place(bodies, 0, Motion::of_pose(pose), t, 1e-6);
    }
    // A motion that starts at once has two velocities at that time.
    const auto ramp = [](double t) {
        return talus::Pose<D::value>{V(std::max(0.0, t) * V::Unit(0)), {}};
    };
    const auto step = [](double t) {
        return talus::Twist<D::value>{V((t >= 0.0 ? 1.0 : 0.0) * V::Unit(0))};
    };
    talus::place(bodies, 0, Motion(ramp, step), 0.0, 1e-6);
}

/// Places an obstacle as the steps of 20 s do.
template <int Dim>
void place_in_steps(const talus::PrescribedMotion<Dim>& motion, double h) {
    talus::Bodies<Dim> bodies;
    bodies.add_obstacle({});
    for (int k = 0; k < 20.0 / h; ++k) talus::place(bodies, 0, motion, (k + 0.5) * h, 1e-3 * h);
}

// Near a turning point the velocity changes by more than itself between two neighbouring times.
BOOST_AUTO_TEST_CASE_TEMPLATE(motions_may_turn_back_at_any_time, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    using Motion = talus::PrescribedMotion<Dim>;
    constexpr int turns = Dim == 2 ? 1 : 3;
    using Turn = talus::AngularVector<Dim>;
    const auto rocks = [](double t) {
        return talus::Pose<D::value>{
            {}, talus::Rotation<D::value>::exp(0.1 * std::sin(3.0 * t) * Turn::Unit(turns - 1))};
    };
    for (const double h : {1e-2, 1e-3, 2e-4}) {
        for (const double frequency : {0.37, 1.1, 2.7, 7.3}) {
            const double w = 2.0 * std::numbers::pi * frequency;
            const auto at = [w](double t) { return V(1e-3 / w * std::sin(w * t) * V::Unit(0)); };
            const auto speed = [w](double t) { return V(1e-3 * std::cos(w * t) * V::Unit(0)); };
            place_in_steps(Motion::of_pose([at](double t) {
                               return talus::Pose<D::value>{at(t), {}};
                           }),
                           h);
            place_in_steps(Motion::shifted({}, at, speed), h);
        }
        place_in_steps(Motion::of_pose(rocks), h);
    }
}

// A triangle wave: of_pose differentiates over its corners.
BOOST_AUTO_TEST_CASE_TEMPLATE(motions_known_by_their_poses_may_jump_in_speed, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const auto wave = [](double t) {
        return talus::Pose<D::value>{V(std::abs(t - std::round(t)) * V::Unit(0)), {}};
    };
    talus::Bodies<Dim> bodies;
    bodies.add_obstacle({});
    const auto motion = talus::PrescribedMotion<Dim>::of_pose(wave);
    for (const double h : {1e-2, 1e-3, 1e-4})
        for (int k = -300; k <= 300; ++k) talus::place(bodies, 0, motion, 0.5 + k * 1e-7, 1e-3 * h);
    // Too coarse for what it does, and said so.
    const auto coarse = talus::PrescribedMotion<Dim>::of_pose(wave, 0.3);
    BOOST_CHECK_EXCEPTION(talus::place(bodies, 0, coarse, 0.4, 1e-6), talus::input_error,
                          [](const talus::input_error& e) {
                              return std::string(e.what()).find("resolution of 0.3 s") !=
                                     std::string::npos;
                          });
}

BOOST_AUTO_TEST_SUITE_END()
