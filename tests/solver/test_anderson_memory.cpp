// SPDX-License-Identifier: BSL-1.0
// The combination of iterates of an affine map is its fixed point once there are enough of them.
#include <talus/solver/sweeps/anderson_memory.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

BOOST_AUTO_TEST_SUITE(solver_anderson_memory)

constexpr int n = 5;

/// T(y) = M y + b, with the fixed point 1, 2, 3...
struct AffineMap {
    Eigen::MatrixXd m = 0.5 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd fixed = Eigen::VectorXd::LinSpaced(n, 1.0, n);

    AffineMap() {
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) m(i, j) += 0.4 / (1.0 + i + 2.0 * j);
    }
    Eigen::VectorXd operator()(const Eigen::VectorXd& y) const { return m * (y - fixed) + fixed; }
};

/// Error of the iterate after so many steps from zero.
double error_after(int steps, int depth) {
    const AffineMap map;
    talus::AndersonMemory memory;
    memory.prepare(n, depth);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
    for (int k = 0; k < steps; ++k) {
        const Eigen::VectorXd x = map(y), change = x - y;
        std::copy_n(x.data(), n, memory.image().begin());
        std::copy_n(change.data(), n, memory.increment().begin());
        y = x;
        if (memory.combine()) std::copy_n(memory.image().begin(), n, y.data());
    }
    return (y - map.fixed).norm() / map.fixed.norm();
}

BOOST_AUTO_TEST_CASE(as_many_iterates_as_dimensions_find_the_fixed_point) {
    // The first has nothing to be combined with.
    BOOST_CHECK_GT(error_after(n, n), 1e-5);
    BOOST_CHECK_LT(error_after(n + 1, n), 1e-6);  // a Gram matrix carries half the digits
    BOOST_CHECK_LT(error_after(n + 2, n), 1e-8);
}

BOOST_AUTO_TEST_CASE(the_oldest_iterates_give_way) {
    BOOST_CHECK_LT(error_after(60, 2), 1e-9);
    BOOST_CHECK_LT(error_after(60, 1), 1e-7);
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_empties_the_memory) {
    talus::AndersonMemory memory;
    memory.prepare(2, 3);
    const auto take = [&](double x, double change) {
        memory.image()[0] = memory.image()[1] = x;
        memory.increment()[0] = memory.increment()[1] = change;
        return memory.combine();
    };
    BOOST_TEST(!take(1.0, 1.0));
    BOOST_TEST(take(1.5, 0.5));
    BOOST_CHECK_CLOSE(memory.image()[0], 2.0, 1e-6);
    BOOST_TEST(!take(std::numeric_limits<double>::quiet_NaN(), 0.25));
    BOOST_TEST(!take(1.0, 1.0));
    BOOST_TEST(take(1.5, 0.5));
    BOOST_CHECK_CLOSE(memory.image()[0], 2.0, 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
