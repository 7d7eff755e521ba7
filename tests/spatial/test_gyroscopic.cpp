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
    BOOST_CHECK_EQUAL(talus::torque_free_spin<Dim>(w, equal, 0.1), w);
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
        w = talus::torque_free_spin<3>(w, moments, h);
        r = (r * talus::Rotation<3>::exp(0.5 * h * w)).normalized();
    }
    const talus::Vector<3> after = r * moments.cwiseProduct(w);
    // Each step rounds a few times.
    BOOST_CHECK_SMALL((after - before).norm() / before.norm(), steps * 2e-15);
}

BOOST_AUTO_TEST_CASE(the_implicit_update_can_be_run_backwards) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(1.0, -0.5, 2.0);
    const auto forth = talus::torque_free_spin<3>(w, moments, 0.1);
    BOOST_CHECK_GT((forth - w).norm(), 1e-2);
    BOOST_CHECK_SMALL((talus::torque_free_spin<3>(forth, moments, -0.1) - w).norm(), 1e-14);
}

BOOST_AUTO_TEST_CASE(both_forms_agree_to_first_order) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(1.0, -0.5, 2.0);
    for (double h : {1e-2, 1e-3, 1e-4}) {
        const talus::Vector<3> implicit = talus::torque_free_spin<3>(w, moments, h) - w;
        const talus::Vector<3> explicit_ =
            h * talus::gyroscopic_torque<3>(w, moments).cwiseQuotient(moments);
        BOOST_CHECK_SMALL((implicit - explicit_).norm(), 20 * h * h);
        BOOST_CHECK_GT(implicit.norm(), 0.5 * h);
    }
}

BOOST_AUTO_TEST_CASE(absurd_turns_give_a_finite_answer) {
    const talus::Vector<3> moments(1.0, 2.0, 2.9), w(300.0, -500.0, 200.0);
    BOOST_CHECK(talus::torque_free_spin<3>(w, moments, 1.0).allFinite());
}

BOOST_AUTO_TEST_SUITE_END()
