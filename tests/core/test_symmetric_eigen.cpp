// SPDX-License-Identifier: BSL-1.0
#include <talus/core/symmetric_eigen.hpp>

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <tuple>
#include <type_traits>

#include "common/random_blocks.hpp"

BOOST_AUTO_TEST_SUITE(symmetric_eigen)

template <int N>
using Size = std::integral_constant<int, N>;
using sizes = std::tuple<Size<1>, Size<2>, Size<3>, Size<5>>;

template <int N>
void test_decomposition(const Eigen::Matrix<double, N, N>& m) {
    BOOST_TEST_INFO_SCOPE("matrix " << m);
    const talus::SymmetricEigen<N> eigen(m);
    const double rounding = 20.0 * N * 2.2e-16;
    for (int i = 1; i < N; ++i) BOOST_TEST(eigen.values[i - 1] <= eigen.values[i]);
    const Eigen::MatrixXd any = m, v = eigen.vectors;
    BOOST_TEST((v.transpose() * v - Eigen::MatrixXd::Identity(N, N)).norm() <= rounding);
    const double size = any.cwiseAbs().maxCoeff();
    const Eigen::VectorXd values = eigen.values;
    BOOST_TEST((any * v - v * values.asDiagonal()).cwiseAbs().maxCoeff() <= rounding * size);
    // Eigen's own way for any size: one instance of it for all of these.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> other(any);
    BOOST_TEST((values - other.eigenvalues()).cwiseAbs().maxCoeff() <= rounding * size);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(decomposes, S, sizes) {
    constexpr int n = S::value;
    RandomBlocks random(11);
    for (int k = 0; k < 500; ++k)
        for (const double size : {1e-150, 1.0, 1e150})
            test_decomposition<n>(size * random.semidefinite<n>(random.integer(1, n)));
    test_decomposition<n>(Eigen::Matrix<double, n, n>::Zero());
    test_decomposition<n>(Eigen::Matrix<double, n, n>::Identity());
    test_decomposition<n>(Eigen::Matrix<double, n, n>::Ones());
}

BOOST_AUTO_TEST_CASE(reads_the_lower_triangle) {
    Eigen::Matrix2d m;
    m << 2.0, 1e9, 1.0, 2.0;
    const talus::SymmetricEigen<2> eigen(m);
    BOOST_TEST(std::abs(eigen.values[0] - 1.0) <= 1e-15);
    BOOST_TEST(std::abs(eigen.values[1] - 3.0) <= 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
