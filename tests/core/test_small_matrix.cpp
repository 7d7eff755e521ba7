// SPDX-License-Identifier: BSL-1.0
// The oracle is Eigen: the same expressions on its matrices of any size, compiled once for all of
// these.
#include <talus/core/instantiate.hpp>
#include <talus/core/small_matrix.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

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
        check_same(a.cwiseMin(0.1), x.cwiseMin(0.1));
        check_same(a.cwiseMax(0.1), x.cwiseMax(0.1));
        check_same(a.cwiseAbs(), x.cwiseAbs());
        check_same(a.normalized(), x.normalized());
        check_same(a * b.transpose(), x * y.transpose());
        BOOST_TEST(std::abs(a.dot(b) - x.dot(y)) <= rounding);
        BOOST_TEST(std::abs(a.norm() - x.norm()) <= rounding);
        BOOST_TEST(std::abs(a.sum() - x.sum()) <= rounding);
        BOOST_TEST(a.minCoeff() == x.minCoeff());
        BOOST_TEST(a.maxCoeff() == x.maxCoeff());
        int least = -1, most = -1;
        Eigen::Index least_of_eigen = -1, most_of_eigen = -1;
        BOOST_TEST(a.minCoeff(&least) == x.minCoeff(&least_of_eigen));
        BOOST_TEST(a.maxCoeff(&most) == x.maxCoeff(&most_of_eigen));
        BOOST_TEST((least == least_of_eigen && most == most_of_eigen));
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

/// What would look as if it changed the matrix.
template <class Part>
concept Changeable = requires(Part part) {
    part = part.now();
}
|| requires(Part part) { part(0, 0) = 1.0; }
|| requires(Part part) { part.setZero(); }
|| requires(Part part) { part *= 2.0; }
|| requires(Part part) { part.row(0) *= 2.0; };

BOOST_AUTO_TEST_CASE(a_part_with_a_name_is_a_value) {
    talus::Matrix<3> m = talus::Matrix<3>::Identity();
    const auto part = m.bottomRightCorner<2, 2>();
    static_assert(!Changeable<std::remove_const_t<decltype(part)>>);
    m(1, 1) = 5.0;
    BOOST_TEST((part(0, 0) == 1.0 && part.diagonal()[0] == 1.0 && part.sum() == 2.0));
    BOOST_TEST((m.bottomRightCorner<2, 2>().sum() == 6.0));
}

/// Of a matrix that may change they reach the matrix, of a constant one they are values.
BOOST_AUTO_TEST_CASE(parts_are_those_of_eigen_and_assignments_reach_the_matrix) {
    std::mt19937 rng(5);
    for (int k = 0; k < 20; ++k) {
        auto m = random_matrix<5, 5>(rng);
        const auto other = random_matrix<2, 3>(rng);
        const auto v = random_matrix<5, 1>(rng);
        Eigen::MatrixXd x = m;
        const auto both = [&](const auto& change) {
            change(m);
            change(x);
            check_same(m, x);
        };
        both([&](auto& a) { a.template block<2, 3>(1, 2) = other; });
        both([&](auto& a) { a.template topRows<2>() *= 3.0; });
        both([&](auto& a) { a.row(3) = v; });
        both([&](auto& a) { a.col(1) += v; });
        both([&](auto& a) { a.diagonal().array() += 2.0; });
        both([&](auto& a) { a.template bottomRightCorner<2, 2>().setIdentity(); });
        both([&](auto& a) { a.row(0).swap(a.row(4)); });
        both([&](auto& a) { a.template bottomRightCorner<3, 3>().diagonal().array() += 0.5; });
        both([&](auto& a) { a.template bottomRightCorner<3, 3>().row(1) *= 2.0; });
        both([&](auto& a) { a.template topRightCorner<3, 2>().col(1).setConstant(0.25); });
        both([&](auto& a) { a.template topRows<3>().template block<2, 2>(1, 1).setOnes(); });
        both([&](auto& a) { a.col(2).template segment<2>(1) = a.col(4).template head<2>(); });
        both([&](auto& a) { a.row(2).template tail<2>()[1] = 4.0; });
        both([&](auto& a) { a.template leftCols<2>() = a.template rightCols<2>().eval(); });
        both([&](auto& a) { a.row(1)[2] = 7.0; });
        both([&](auto& a) { a.row(2) << 1.0, 2.0, 3.0, 4.0, 5.0; });
        both([&](auto& a) { a.row(2) -= a.col(2).transpose(); });
        check_same(std::as_const(m).diagonal(), x.diagonal());
        check_same(std::as_const(m).block<3, 2>(2, 1), x.block<3, 2>(2, 1));
        BOOST_TEST(std::abs(m.row(1).dot(v) - x.row(1).dot(v)) <= 30.0 * rounding);
        BOOST_TEST(std::abs(m.col(0).norm() - x.col(0).norm()) <= 30.0 * rounding);
        auto w = v;
        Eigen::VectorXd y = w;
        w.tail<2>() = 2.0 * w.head<2>();
        y.tail<2>() = (2.0 * y.head<2>()).eval();
        w.segment<3>(1).setZero();
        y.segment<3>(1).setZero();
        check_same(w, y);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(determinants_are_those_of_eigen, S, sizes) {
    constexpr int n = S::value;
    std::mt19937 rng(6);
    for (int k = 0; k < 20; ++k) {
        const auto m = random_matrix<n, n>(rng);
        const Eigen::MatrixXd x = m;
        BOOST_TEST(std::abs(m.determinant() - x.determinant()) <= 10.0 * rounding);
    }
}

BOOST_AUTO_TEST_CASE(some_vector_at_a_right_angle) {
    std::mt19937 rng(7);
    for (int k = 0; k < 20; ++k) {
        const auto a = random_matrix<2, 1>(rng);
        BOOST_TEST((a.unitOrthogonal() == Eigen::Vector2d(a).unitOrthogonal()));
        auto b = random_matrix<3, 1>(rng);
        if (k % 2) b *= 1e-20;
        if (k % 3) b.head<2>() *= 1e-14;
        check_same(b.unitOrthogonal(), Eigen::Vector3d(b).unitOrthogonal());
    }
}

/// As an operand: on the right of Eigen's expressions, on the left, and of assignments to parts.
BOOST_AUTO_TEST_CASE(it_is_an_operand_of_eigens_expressions) {
    std::mt19937 rng(8);
    const auto m = random_matrix<3, 3>(rng);
    const auto v = random_matrix<3, 1>(rng);
    const Eigen::MatrixXd x = m, dense = random_matrix<5, 3>(rng);
    const Eigen::VectorXd y = v;
    check_same(dense * v, dense * y);
    check_same(dense * m, dense * x);
    check_same(m * dense.transpose(), x * dense.transpose());
    check_same(v + y, 2.0 * y);
    check_same(y - 2.0 * v, -y);
    check_same(m * v.asDiagonal(), x * y.asDiagonal());
    check_same(Eigen::MatrixXd(v.asDiagonal()) * m, y.asDiagonal() * x);
    check_same(x.cwiseProduct(m), x.cwiseProduct(x));
    check_same(m.inverse() * m, Eigen::Matrix3d::Identity());
    check_same(x.partialPivLu().solve(v), m.partialPivLu().solve(y));
    check_same((m.array() > 0.0).select(m, 0.0), x.cwiseMax(0.0));
    BOOST_TEST(std::abs(y.dot(v) - v.dot(y)) <= rounding);
    BOOST_TEST((m == x && x == m && v != 2.0 * y));
    Eigen::VectorXd big = Eigen::VectorXd::Zero(6);
    big.segment<3>(2) = v;
    big.tail(3) += m * v;
    big.head<3>().noalias() -= m * y;
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
    expected.segment<3>(2) = y;
    expected.tail(3) += x * y;
    expected.head<3>() -= x * y;
    check_same(big, expected);
    const auto changed = [](Eigen::Ref<Eigen::Vector3d> a) { a *= 2.0; };
    auto w = v;
    changed(w);
    check_same(w, 2.0 * y);
    // An expression holds it by value.
    const auto sum = y + (v + v);
    check_same(sum, 3.0 * y);
}

template <class D>
double sum_of_lengths(const Eigen::MatrixBase<D>& m) {
    return m.norm() + m[0] * m(1) + m.normalized()[2] + m.transpose().squaredNorm();
}

BOOST_AUTO_TEST_CASE(functions_of_any_matrix_of_eigens_take_it) {
    std::mt19937 rng(9);
    const auto a = random_matrix<3, 1>(rng), b = random_matrix<3, 1>(rng);
    const Eigen::Vector3d x = a, y = b;
    BOOST_TEST(std::abs(sum_of_lengths(a) - sum_of_lengths(x)) <= rounding);
    check_same(Eigen::Quaterniond::FromTwoVectors(a, b).coeffs(),
               Eigen::Quaterniond::FromTwoVectors(x, y).coeffs());
}

/// What is written down of Eigen without including it.
BOOST_AUTO_TEST_CASE_TEMPLATE(its_constants_are_eigens, S, sizes) {
    const auto check = [](auto matrix) {
        using M = decltype(matrix);
        using E = typename M::OfEigen;
        BOOST_TEST(int(M::Flags) == (int(E::Flags) & ~int(Eigen::NestByRefBit)));
        BOOST_TEST(int(M::InnerSizeAtCompileTime) == int(E::InnerSizeAtCompileTime));
        BOOST_TEST(int(M::OuterStrideAtCompileTime) == int(E::OuterStrideAtCompileTime));
        BOOST_TEST(int(M::NumDimensions) == int(E::NumDimensions));
        BOOST_TEST(M::outerSize() == E().outerSize());
        static_assert(sizeof(M) == E::SizeAtCompileTime * sizeof(double));
        static_assert(std::is_same_v<typename M::PlainObject, typename E::PlainObject>);
        static_assert(std::is_trivially_copyable_v<M>);
    };
    check(talus::SmallMatrix<S::value, 1>());
    check(talus::SmallMatrix<1, S::value>());
    check(talus::SmallMatrix<S::value, S::value>());
    check(talus::SmallMatrix<2, S::value>());
    static_assert(talus::detail::eigen_array_alignment == EIGEN_MAX_STATIC_ALIGN_BYTES);
    static_assert(std::max(talus::detail::eigen_alignment, 16) == EIGEN_DEFAULT_ALIGN_BYTES);
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
