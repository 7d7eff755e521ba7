// SPDX-License-Identifier: BSL-1.0
#include <talus/spatial/gyroscopic.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(spatial_gyroscopic)

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_keep_their_spin_to_the_bit, D, dimensions) {
    constexpr int Dim = D::value;
    using Spin = talus::AngularVector<Dim>;
    std::mt19937 rng(41);
    const Spin w = random_input::vector<Spin>(rng, 10.0);
    const Spin equal = Spin::Constant(0.3);
    BOOST_CHECK(talus::gyroscopic_torque<Dim>(w, equal).isZero(0.0));
    BOOST_CHECK_EQUAL(talus::torque_free_spin<Dim>(w, equal, 0.1).spin, w);
}

BOOST_AUTO_TEST_CASE(the_implicit_update_keeps_angular_momentum_in_space) {
    std::mt19937 rng(42);
    const talus::Vector<3> moments(1.0, 2.0, 2.5);
    talus::Rotation<3> r = random_input::rotation<3>(rng);
    talus::Vector<3> w = random_input::vector<talus::Vector<3>>(rng, 2.0);
    const talus::Vector<3> before = r * moments.cwiseProduct(w);
    const double h = 0.05;
    const int steps = 400;
    for (int k = 0; k < steps; ++k) {
        r = r * talus::Rotation<3>::exp(0.5 * h * w);
        w = talus::torque_free_spin<3>(w, moments, h).spin;
        r = (r * talus::Rotation<3>::exp(0.5 * h * w)).normalized();
    }
    const talus::Vector<3> after = r * moments.cwiseProduct(w);
    // Each step rounds a few times.
    BOOST_CHECK_SMALL((after - before).norm() / before.norm(), steps * 2e-15);
}

BOOST_AUTO_TEST_CASE(the_implicit_update_can_be_run_backwards) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(1.0, -0.5, 2.0);
    const auto forth = talus::torque_free_spin<3>(w, moments, 0.1).spin;
    BOOST_CHECK_GT((forth - w).norm(), 1e-2);
    BOOST_CHECK_SMALL((talus::torque_free_spin<3>(forth, moments, -0.1).spin - w).norm(), 1e-14);
}

BOOST_AUTO_TEST_CASE(both_forms_agree_to_first_order) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(1.0, -0.5, 2.0);
    for (double h : {1e-2, 1e-3, 1e-4}) {
        const talus::Vector<3> implicit = talus::torque_free_spin<3>(w, moments, h).spin - w;
        const talus::Vector<3> explicit_ =
            h * talus::gyroscopic_torque<3>(w, moments).cwiseQuotient(moments);
        BOOST_CHECK_SMALL((implicit - explicit_).norm(), 20 * h * h);
        BOOST_CHECK_GT(implicit.norm(), 0.5 * h);
    }
}

BOOST_AUTO_TEST_CASE(absurd_turns_give_a_finite_answer_and_say_so) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(300.0, -500.0, 200.0);
    const auto end = talus::torque_free_spin<3>(w, moments, 1.0);
    BOOST_TEST(end.spin.allFinite());
    BOOST_TEST(end.in_parts);
    const auto length = [&](const talus::Vector<3>& x) { return moments.cwiseProduct(x).norm(); };
    BOOST_CHECK_CLOSE(length(end.spin), length(w), 1e-8);
}

// (avianphysics/avian#420) Bars, plates and lumps, about the middle axis too.
BOOST_AUTO_TEST_CASE(turns_of_up_to_a_radian_and_a_half_keep_momentum_and_energy) {
    std::mt19937 rng(43);
    for (int trial = 0; trial < 400; ++trial) {
        // Moments of masses along the axes, one or two of them thin.
        talus::Vector<3> mass;
        for (int k = 0; k < 3; ++k) mass[k] = random_input::uniform(rng, 0.01, 1.0);
        if (trial % 4 > 0) mass[2] *= 1e-3;
        if (trial % 4 > 1) mass[1] *= 1e-3;
        const talus::Vector<3> moments = mass.sum() * talus::Vector<3>::Ones() - mass;
        talus::Vector<3> w = random_input::vector<talus::Vector<3>>(rng, 1.0);
        if (trial % 3 == 0) w = talus::Vector<3>(0.0, 1.0, 0.0) + 1e-3 * w;
        w *= random_input::uniform(rng, 0.2, 1.5) / w.norm();
        const double energy = w.dot(moments.cwiseProduct(w));
        talus::Rotation<3> r;
        const talus::Vector<3> momentum = moments.cwiseProduct(w);
        for (int k = 0; k < 50; ++k) {
            r = r * talus::Rotation<3>::exp(0.5 * w);
            const auto end = talus::torque_free_spin<3>(w, moments, 1.0);
            BOOST_REQUIRE(!end.in_parts);
            w = end.spin;
            r = (r * talus::Rotation<3>::exp(0.5 * w)).normalized();
        }
        BOOST_CHECK_SMALL((r * moments.cwiseProduct(w) - momentum).norm(), 1e-10 * momentum.norm());
        BOOST_TEST(std::abs(w.dot(moments.cwiseProduct(w)) / energy - 1.0) < 0.15);
    }
}

BOOST_AUTO_TEST_SUITE_END()
