// SPDX-License-Identifier: BSL-1.0
#include <talus/spatial/local_frame.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(spatial_local_frame)

// A few roundings of numbers of order 1.
constexpr double tolerance = 2e-15;

template <int Dim>
void check_frame(const talus::Vector<Dim>& n) {
    const talus::Matrix<Dim> f = talus::local_frame<Dim>(n);
    BOOST_CHECK_SMALL((f * f.transpose() - talus::Matrix<Dim>::Identity()).norm(), tolerance);
    BOOST_CHECK_CLOSE(f.determinant(), 1.0, 1e-12);
    BOOST_CHECK_EQUAL(talus::Vector<Dim>(f.row(0)), n);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(frames_are_right_handed_with_the_normal_first, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(31);
    for (int k = 0; k < 200; ++k) check_frame<Dim>(random_input::unit<talus::Vector<Dim>>(rng));
    for (int axis = 0; axis < Dim; ++axis)
        for (double sign : {1.0, -1.0}) check_frame<Dim>(sign * talus::Vector<Dim>::Unit(axis));
}

BOOST_AUTO_TEST_CASE(frames_stay_orthonormal_next_to_the_pole_of_the_construction) {
    for (double tilt : {0.0, 1e-300, 1e-160, 1e-16, 1e-9, 1e-3})
        for (double sign : {1.0, -1.0})
            check_frame<3>(talus::Vector<3>(tilt, 0.5 * tilt, sign).normalized());
    check_frame<3>(talus::Vector<3>(1.0, 0.0, -0.0));
}

BOOST_AUTO_TEST_SUITE_END()
