// SPDX-License-Identifier: BSL-1.0
#include <talus/core/cross.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(core_cross)

template <class V>
V random_vector(std::mt19937& rng) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    V v;
    for (int i = 0; i < v.size(); ++i) v[i] = uniform(rng);
    return v;
}

// A handful of products of numbers below 1.
constexpr double rounding = 1e-15;

BOOST_AUTO_TEST_CASE_TEMPLATE(spin_and_moment_are_dual, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(1);
    for (int k = 0; k < 100; ++k) {
        const auto w = random_vector<talus::AngularVector<Dim>>(rng);
        const auto arm = random_vector<talus::Vector<Dim>>(rng);
        const auto f = random_vector<talus::Vector<Dim>>(rng);
        // Power of the force on the moving point = power of its moment on the spin.
        BOOST_CHECK_SMALL(f.dot(talus::cross<Dim>(w, arm)) - w.dot(talus::moment<Dim>(arm, f)),
                          4 * rounding);
        BOOST_CHECK_SMALL(talus::cross<Dim>(w, arm).dot(arm), 4 * rounding);
        BOOST_CHECK_SMALL(talus::moment<Dim>(arm, arm).norm(), 4 * rounding);
        const auto l = talus::moment_matrix<Dim>(arm);
        BOOST_CHECK_SMALL((l * f - talus::moment<Dim>(arm, f)).norm(), 4 * rounding);
        BOOST_CHECK_SMALL((l.transpose() * w - talus::cross<Dim>(w, arm)).norm(), 4 * rounding);
    }
}

BOOST_AUTO_TEST_CASE(the_plane_is_the_xy_plane_of_space) {
    std::mt19937 rng(2);
    const auto w = random_vector<talus::AngularVector<2>>(rng);
    const auto arm = random_vector<talus::Vector<2>>(rng);
    const auto f = random_vector<talus::Vector<2>>(rng);
    const talus::Vector<3> w3(0, 0, w[0]), arm3(arm[0], arm[1], 0), f3(f[0], f[1], 0);
    BOOST_CHECK_EQUAL(talus::cross<3>(w3, arm3).head<2>(), talus::cross<2>(w, arm));
    BOOST_CHECK_EQUAL(talus::moment<3>(arm3, f3)[2], talus::moment<2>(arm, f)[0]);
}

BOOST_AUTO_TEST_SUITE_END()
