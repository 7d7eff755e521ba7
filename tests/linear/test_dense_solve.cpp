// SPDX-License-Identifier: BSL-1.0
#include <talus/linear/dense_solve.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(dense_solve)

BOOST_AUTO_TEST_CASE(regular_systems_are_solved) {
    const Eigen::Matrix2d a{{2.0, 1.0}, {1.0, 3.0}};
    const Eigen::Vector2d b(3.0, 5.0);
    Eigen::VectorXd x;
    BOOST_TEST(talus::solve_dense(a, b, x));
    BOOST_TEST((a * x - b).norm() <= 1e-15);
    BOOST_TEST((a * talus::solved_dense(a, b) - b).norm() <= 1e-15);
    BOOST_TEST(talus::dense_determinant(a) == 5.0, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(talus::solve_dense(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0), x));
    BOOST_TEST(x.size() == 0);
}

// What counts as zero does so in the answer too: a pivot of 1e-13 is beyond the threshold, but
// within what Eigen takes for rounding by default.
BOOST_AUTO_TEST_CASE(singular_systems_get_the_shortest_of_the_best_answers) {
    Eigen::VectorXd x;
    for (const double small : {0.0, 1e-18, 1e-15, 1e-13, 5e-12}) {
        const Eigen::Matrix3d turn =
            Eigen::Matrix3d{{2.0, 1.0, 2.0}, {-2.0, 2.0, 1.0}, {1.0, 2.0, -2.0}} / 3.0;
        const Eigen::Matrix3d a =
            turn * Eigen::Vector3d(1.0, 2.0, small).asDiagonal() * turn.transpose();
        const Eigen::Vector3d b = turn * Eigen::Vector3d(3.0, 4.0, 0.0);
        BOOST_TEST_INFO_SCOPE("smallest value " << small);
        BOOST_TEST(!talus::solve_dense(a, b, x));
        BOOST_TEST((x - turn * Eigen::Vector3d(3.0, 2.0, 0.0)).norm() <= 1e-10);
    }
}

BOOST_AUTO_TEST_SUITE_END()
