// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include "examples/solve_problem/file_units.hpp"

BOOST_AUTO_TEST_SUITE(examples_file_units)

using Problem = talus::AssembledProblem<2, talus::Coulomb<2>>;

/// A mass of 1 kg that falls on a floor at `speed`.
Problem falling_mass(double speed) {
    talus::ContactJacobian<2> jacobian;
    jacobian.resize(1);
    jacobian.a = {1};
    jacobian.b = {0};
    jacobian.frame = {talus::Matrix<2>::Identity()};
    jacobian.arm_a = jacobian.arm_b = {talus::Vector<2>::Zero()};
    talus::InverseMass<2> inverse_mass;
    inverse_mass.linear = {0.0, 1.0};
    inverse_mass.angular.assign(2, talus::AngularMatrix<2>::Zero());
    return {talus::DelassusSparse<2>(jacobian, inverse_mass),
            {talus::Vector<2>(-speed, 0.0)},
            {talus::Coulomb<2>{.mu = 0.5}}};
}
double residual(double speed, double impulse) {
    return solve_problem::residual_in_file_units<2>(falling_mass(speed),
                                                    {talus::Vector<2>(impulse, 0.0)});
}

BOOST_AUTO_TEST_CASE(a_residual_in_file_units_is_relative_and_0_over_0_is_0) {
    BOOST_TEST(residual(2.0, 2.0) == 0.0);
    BOOST_TEST(residual(2.0, 0.0) == 1.0);
    BOOST_TEST(residual(0.0, 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_residual_of_what_is_not_finite_is_not_a_number) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    BOOST_TEST(std::isnan(residual(std::nan(""), 1.0)));
    BOOST_TEST(std::isnan(residual(1.0, std::nan(""))));
    BOOST_TEST(std::isnan(residual(infinity, 1.0)));
    BOOST_TEST(std::isnan(residual(-infinity, 0.0)));
    BOOST_TEST(std::isnan(residual(1e200, 1.0)));  // squares overflow
}

BOOST_AUTO_TEST_SUITE_END()
