// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/block_lu.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <random>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(block_lu)

BOOST_AUTO_TEST_CASE(random_patterns_agree_with_a_dense_factorisation) {
    std::mt19937 random(90);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int k = 0; k < 200; ++k) {
        BOOST_TEST_INFO_SCOPE("matrix " << k);
        const int nodes = 1 + below(40);
        std::vector<int> sizes, offset{0};
        for (int i = 0; i < nodes; ++i) {
            sizes.push_back(1 + below(6));
            offset.push_back(offset.back() + sizes.back());
        }
        std::vector<std::pair<int, int>> edges(static_cast<std::size_t>(below(3 * nodes)));
        for (auto& e : edges) e = {below(nodes), below(nodes)};
        talus::BlockLu lu;
        lu.analyze(sizes, edges);
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(offset.back(), offset.back());
        const auto fill = [&](int i, int j) {
            auto block = lu.block(lu.slot(i, j));
            for (Eigen::Index a = 0; a < block.rows(); ++a)
                for (Eigen::Index b = 0; b < block.cols(); ++b) {
                    const double value = number(random) + (i == j && a == b ? 20.0 : 0.0);
                    block(a, b) += value;
                    dense(offset[static_cast<std::size_t>(i)] + a,
                          offset[static_cast<std::size_t>(j)] + b) += value;
                }
        };
        for (int twice = 0; twice < 2; ++twice) {
            lu.set_zero();
            dense.setZero();
            for (int i = 0; i < nodes; ++i) fill(i, i);
            for (const auto& [i, j] : edges) {
                fill(i, j);
                if (i != j) fill(j, i);
            }
            BOOST_REQUIRE(lu.factorize());
            const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(dense.rows(), -1.0, 2.0);
            Eigen::VectorXd x = b;
            lu.solve(x);
            const Eigen::VectorXd exact = dense.lu().solve(b);
            BOOST_TEST((x - exact).norm() <= 1e-11 * exact.norm());
        }
    }
}

BOOST_AUTO_TEST_CASE(a_singular_matrix_is_reported) {
    talus::BlockLu lu;
    const std::vector<std::pair<int, int>> edges{{0, 1}};
    lu.analyze(std::vector<int>{2, 2}, edges);
    lu.set_zero();
    lu.block(lu.slot(0, 0)).setIdentity();
    BOOST_TEST(!lu.factorize());
    lu.block(lu.slot(1, 1)).setIdentity();
    BOOST_TEST(lu.factorize());
}

BOOST_AUTO_TEST_CASE(no_nodes_no_rows) {
    talus::BlockLu lu;
    lu.analyze({}, {});
    BOOST_TEST(lu.size() == 0);
    BOOST_TEST(lu.factorize());
    Eigen::VectorXd x(0);
    lu.solve(x);
}

BOOST_AUTO_TEST_SUITE_END()
