// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/small_lu.hpp>
#include <talus/linear/dense_solve.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_small_lu)

/// Random, with nothing on the diagonal: rows must change places.
template <int Dof>
void check(Eigen::Index n, std::mt19937& rng) {
    talus::SmallLu<Dof> lu;
    for (int k = 0; k < 200; ++k) {
        Eigen::MatrixXd a(n, n);
        Eigen::VectorXd b(n);
        for (double& x : a.reshaped()) x = random_input::uniform(rng, -1.0, 1.0);
        for (double& x : b) x = random_input::uniform(rng, -1.0, 1.0);
        if (n > 1) a.diagonal().setZero();
        Eigen::Matrix<double, Dof, 1> x = b;
        lu.factor(a);
        lu.solve(x);
        const Eigen::VectorXd exact = talus::solved_dense(a, b);
        const double condition = a.norm() * exact.norm() / b.norm();
        BOOST_TEST((a * x - b).norm() <= 1e-14 * a.norm() * (1.0 + x.norm()));
        if (condition < 1e3) BOOST_TEST((x - exact).norm() <= 1e-11 * exact.norm());
    }
}

BOOST_AUTO_TEST_CASE(solves_what_needs_row_exchanges) {
    std::mt19937 rng(17);
    check<1>(1, rng);
    check<3>(3, rng);
    for (Eigen::Index n = 1; n <= 8; ++n) check<Eigen::Dynamic>(n, rng);
}

BOOST_AUTO_TEST_CASE(of_a_singular_matrix_nothing_finite_comes) {
    talus::SmallLu<2> lu;
    lu.factor(Eigen::Matrix2d::Zero());
    Eigen::Vector2d b(1.0, 2.0);
    lu.solve(b);
    BOOST_TEST(!b.allFinite());
}

BOOST_AUTO_TEST_SUITE_END()
