// SPDX-License-Identifier: BSL-1.0
// The oracle is Eigen: the same expressions on its matrices of any size, compiled once for all of
// these.
#include <talus/core/small_matrix.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(small_matrix)

template <int N>
using Size = std::integral_constant<int, N>;
using sizes = std::tuple<Size<1>, Size<2>, Size<3>, Size<5>>;

/// Sums of N products of numbers below 1: the order of additions may differ.
constexpr double rounding = 30.0 * std::numeric_limits<double>::epsilon();

template <int R, int C>
talus::SmallMatrix<R, C> random_matrix(std::mt19937& rng) {
    talus::SmallMatrix<R, C> m;
    for (int i = 0; i < R * C; ++i) m.data()[i] = random_input::uniform(rng, -1.0, 1.0);
    return m;
}

void check_same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    BOOST_REQUIRE((a.rows() == b.rows() && a.cols() == b.cols()));
    BOOST_TEST((a - b).cwiseAbs().maxCoeff() <= rounding);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(vectors_are_those_of_eigen, S, sizes) {
    constexpr int n = S::value;
    std::mt19937 rng(3);
    for (int k = 0; k < 50; ++k) {
        const auto a = random_matrix<n, 1>(rng), b = random_matrix<n, 1>(rng);
        const Eigen::VectorXd x = a, y = b;
        check_same(a + b, x + y);
        check_same(a - b, x - y);
        check_same(-a, -x);
        check_same(2.0 * a, 2.0 * x);
        check_same(a * 3, x * 3.0);
        check_same(a / 7.0, x / 7.0);
        check_same(a.cwiseProduct(b), x.cwiseProduct(y));
        check_same(a.cwiseMin(b), x.cwiseMin(y));
        check_same(a.cwiseMax(b), x.cwiseMax(y));
        check_same(a.cwiseAbs(), x.cwiseAbs());
        check_same(a.normalized(), x.normalized());
        check_same(a * b.transpose(), x * y.transpose());
        BOOST_TEST(std::abs(a.dot(b) - x.dot(y)) <= rounding);
        BOOST_TEST(std::abs(a.norm() - x.norm()) <= rounding);
        BOOST_TEST(std::abs(a.sum() - x.sum()) <= rounding);
        BOOST_TEST(a.minCoeff() == x.minCoeff());
        BOOST_TEST(a.maxCoeff() == x.maxCoeff());
        check_same(a.cwiseInverse().cwiseProduct(a).cwiseQuotient(a).cwiseProduct(a),
                   Eigen::VectorXd::Ones(n));
        auto c = a;
        c += b;
        c -= 2.0 * a;
        c *= 3.0;
        c /= 2.0;
        check_same(c, 1.5 * (y - x));
        if constexpr (n == 3) check_same(a.cross(b), Eigen::Vector3d(x).cross(Eigen::Vector3d(y)));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(products_are_those_of_eigen, S, sizes) {
    constexpr int n = S::value;
    std::mt19937 rng(4);
    for (int k = 0; k < 50; ++k) {
        const auto a = random_matrix<n, n>(rng), b = random_matrix<n, n>(rng);
        const auto wide = random_matrix<2, n>(rng);
        const auto v = random_matrix<n, 1>(rng);
        const Eigen::MatrixXd x = a, y = b, w = wide;
        const Eigen::VectorXd u = v;
        check_same(a * v, x * u);
        check_same(a * b, x * y);
        check_same(a.transpose() * b, x.transpose() * y);
        check_same(wide * a * wide.transpose(), w * x * w.transpose());
        check_same(wide.transpose(), w.transpose());
        BOOST_TEST(std::abs(a.trace() - x.trace()) <= rounding);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(constants, S, sizes) {
    constexpr int n = S::value;
    using Column = talus::SmallMatrix<n, 1>;
    using Square = talus::SmallMatrix<n, n>;
    BOOST_TEST((Column::Zero() == Eigen::Matrix<double, n, 1>::Zero()));
    BOOST_TEST((Column::Constant(2.5) == Eigen::Matrix<double, n, 1>::Constant(2.5)));
    BOOST_TEST((Column::Unit(n - 1) == Eigen::Matrix<double, n, 1>::Unit(n - 1)));
    BOOST_TEST((Square::Identity() == Eigen::Matrix<double, n, n>::Identity()));
    BOOST_TEST(Column::Zero().normalized().is_zero());
    BOOST_TEST(!Column::Unit(n - 1).is_zero());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(numbers_that_are_none_are_seen_in_any_place, S, sizes) {
    constexpr int n = S::value;
    for (int i = 0; i < n; ++i) {
        auto v = talus::SmallMatrix<n, 1>::Ones();
        BOOST_TEST((v.allFinite() && !v.hasNaN()));
        v[i] = std::numeric_limits<double>::infinity();
        BOOST_TEST((!v.allFinite() && !v.hasNaN()));
        v[i] = std::nan("");
        BOOST_TEST((!v.allFinite() && v.hasNaN() && !v.is_zero()));
    }
}

/// What this type is for: a sum is a value, which may outlive what it was made of.
BOOST_AUTO_TEST_CASE(arithmetic_is_eager) {
    using V = talus::SmallMatrix<3, 1>;
    using M = talus::SmallMatrix<3, 3>;
    V a, b;
    M m;
    static_assert(std::is_same_v<decltype(a + b), V> && std::is_same_v<decltype(2.0 * a), V>);
    static_assert(std::is_same_v<decltype(m * a), V> && std::is_same_v<decltype(m * m), M>);
    static_assert(std::is_same_v<decltype(a.cross(b)), V> && sizeof(V) == 3 * sizeof(double));
    const auto sum = [] { return V(1.0, 2.0, 3.0) + V(1.0, 1.0, 1.0); }();
    BOOST_TEST((sum == V(2.0, 3.0, 4.0)));
}

BOOST_AUTO_TEST_CASE(eigen_takes_and_gives_it) {
    using V = talus::SmallMatrix<3, 1>;
    const Eigen::Vector3d x(1.0, 2.0, 3.0);
    V v = 2.0 * x + Eigen::Vector3d::Ones();
    BOOST_TEST((v == V(3.0, 5.0, 7.0)));
    v = x;
    v += x.cross(Eigen::Vector3d::UnitX());
    v << 1.0, v.head<2>();
    BOOST_TEST((v == V(1.0, 1.0, 5.0)));
    const double numbers[] = {4.0, 5.0, 6.0};
    const Eigen::Map<const V> mapped(numbers);
    BOOST_TEST((v + mapped == Eigen::Vector3d(5.0, 6.0, 11.0)));
}

BOOST_AUTO_TEST_SUITE_END()
