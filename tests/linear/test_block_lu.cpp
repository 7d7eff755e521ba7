// SPDX-License-Identifier: BSL-1.0
#include <talus/linear/block_lu.hpp>
#include <talus/linear/dense_solve.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <utility>
#include <vector>

#include "common/random_blocks.hpp"

BOOST_AUTO_TEST_SUITE(block_lu)

using Edges = std::vector<std::pair<int, int>>;

/// A block matrix twice: in BlockLu and written out.
class Twin {
  public:
    Twin(std::vector<int> sizes, Edges edges) : sizes_(std::move(sizes)), edges_(std::move(edges)) {
        lu.analyze(sizes_, edges_);
        offset_.push_back(0);
        for (const int s : sizes_) offset_.push_back(offset_.back() + s);
    }

    /// Random blocks; the diagonal ones made heavy enough for a positive definite symmetric part.
    void fill(RandomBlocks& random) {
        dense = Eigen::MatrixXd::Zero(offset_.back(), offset_.back());
        lu.set_zero();
        for (const auto& [i, j] : edges_)
            if (i != j) {
                add(i, j, random);
                add(j, i, random);
            }
        for (int i = 0; i < node_count(); ++i) {
            add(i, i, random);
            auto own = lu.block(lu.slot(i, i));
            const double heavy = dense.middleRows(offset(i), size(i)).cwiseAbs().sum() +
                                 dense.middleCols(offset(i), size(i)).cwiseAbs().sum();
            own.diagonal().array() += heavy;
            dense.diagonal().segment(offset(i), size(i)).array() += heavy;
        }
    }
    /// Makes node i depend on nothing and nothing on it, its block zero.
    void empty_node(int i) {
        for (int j = 0; j < node_count(); ++j)
            if (dense.block(offset(i), offset(j), size(i), size(j)).norm() > 0.0) {
                lu.block(lu.slot(i, j)).setZero();
                lu.block(lu.slot(j, i)).setZero();
            }
    }

    void check_solutions(RandomBlocks& random) {
        BOOST_REQUIRE(lu.size() == dense.rows());
        BOOST_REQUIRE(lu.factorize());
        for (int k = 0; k < 3; ++k) {
            Eigen::VectorXd b(dense.rows());
            for (double& x : b) x = random.uniform(-1.0, 1.0);
            const Eigen::VectorXd exact = talus::solved_dense(dense, b);
            Eigen::VectorXd x = b;
            lu.solve(x);
            // Diagonally dominant: condition numbers of some hundred at most.
            BOOST_TEST((x - exact).norm() <= 1e-12 * exact.norm());
        }
    }

    int node_count() const { return static_cast<int>(sizes_.size()); }
    int offset(int i) const { return offset_[static_cast<std::size_t>(i)]; }
    int size(int i) const { return sizes_[static_cast<std::size_t>(i)]; }

    talus::BlockLu lu;
    Eigen::MatrixXd dense;

  private:
    void add(int i, int j, RandomBlocks& random) {
        Eigen::MatrixXd b(size(i), size(j));
        for (double& x : b.reshaped()) x = random.uniform(-1.0, 1.0);
        lu.block(lu.slot(i, j)) += b;
        dense.block(offset(i), offset(j), size(i), size(j)) += b;
    }

    std::vector<int> sizes_, offset_;
    Edges edges_;
};

std::vector<int> random_sizes(int nodes, RandomBlocks& random) {
    std::vector<int> sizes;
    for (int i = 0; i < nodes; ++i) sizes.push_back(random.integer(1, 6));
    return sizes;
}
Edges tree(int nodes, RandomBlocks& random) {
    Edges edges;
    for (int i = 1; i < nodes; ++i) edges.emplace_back(i, random.integer(0, i - 1));
    return edges;
}
Edges chain(int nodes) {
    Edges edges;
    for (int i = 1; i < nodes; ++i) edges.emplace_back(i - 1, i);
    return edges;
}
Edges grid(int rows, int columns) {
    Edges edges;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            if (i > 0) edges.emplace_back(columns * i + j, columns * (i - 1) + j);
            if (j > 0) edges.emplace_back(columns * i + j, columns * i + j - 1);
        }
    return edges;
}
Edges clique(int nodes) {
    Edges edges;
    for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < i; ++j) edges.emplace_back(i, j);
    return edges;
}
/// Each pair with a probability, some of them said twice, some from both ends, some loops.
Edges scattered(int nodes, double share, RandomBlocks& random) {
    Edges edges;
    for (const auto& [i, j] : clique(nodes)) {
        if (random.uniform(0.0, 1.0) > share) continue;
        edges.emplace_back(i, j);
        if (random.uniform(0.0, 1.0) < 0.2) edges.emplace_back(j, i);
        if (random.uniform(0.0, 1.0) < 0.2) edges.emplace_back(i, j);
        if (random.uniform(0.0, 1.0) < 0.2) edges.emplace_back(i, i);
    }
    return edges;
}

void check(int nodes, const Edges& edges, RandomBlocks& random) {
    BOOST_TEST_INFO_SCOPE(nodes << " nodes, " << edges.size() << " edges");
    Twin twin(random_sizes(nodes, random), edges);
    for (int again = 0; again < 2; ++again) {
        twin.fill(random);
        twin.check_solutions(random);
    }
}

BOOST_AUTO_TEST_CASE(solutions_are_those_of_dense_elimination) {
    RandomBlocks random(101);
    for (const int nodes : {1, 2, 3, 5, 8, 13, 30, 60}) {
        check(nodes, {}, random);
        check(nodes, chain(nodes), random);
        check(nodes, tree(nodes, random), random);
        for (const double share : {0.02, 0.1, 0.4})
            check(nodes, scattered(nodes, share, random), random);
    }
    for (const int nodes : {2, 7, 25}) check(nodes, clique(nodes), random);
    check(12, grid(3, 4), random);
    check(60, grid(6, 10), random);
    check(60, grid(2, 30), random);
}

// Two cliques and a chain that know nothing of each other, and nodes alone.
BOOST_AUTO_TEST_CASE(disconnected_parts_are_solved_side_by_side) {
    RandomBlocks random(102);
    Edges edges;
    for (const auto& [i, j] : clique(6)) {
        edges.emplace_back(3 * i, 3 * j);
        edges.emplace_back(3 * i + 1, 3 * j + 1);
    }
    for (int i = 20; i < 28; ++i) edges.emplace_back(i, i + 1);
    check(35, edges, random);
}

// The symmetric part stays positive definite whatever the skew one is: rows need no exchange
// beyond a front.
BOOST_AUTO_TEST_CASE(large_skew_parts_are_borne) {
    RandomBlocks random(103);
    for (int k = 0; k < 20; ++k) {
        const int nodes = random.integer(2, 25);
        Twin twin(random_sizes(nodes, random), clique(nodes));
        const int n = twin.lu.size();
        Eigen::MatrixXd a(n, n);
        for (double& x : a.reshaped()) x = random.uniform(-1.0, 1.0);
        twin.dense = 100.0 * (a - a.transpose()) + Eigen::MatrixXd::Identity(n, n);
        twin.lu.set_zero();
        for (int i = 0; i < nodes; ++i)
            for (int j = 0; j < nodes; ++j)
                twin.lu.block(twin.lu.slot(i, j)) =
                    twin.dense.block(twin.offset(i), twin.offset(j), twin.size(i), twin.size(j));
        BOOST_REQUIRE(twin.lu.factorize());
        Eigen::VectorXd b(n);
        for (double& x : b) x = random.uniform(-1.0, 1.0);
        Eigen::VectorXd x = b;
        twin.lu.solve(x);
        // Backward error: that of elimination with growth n at most, far from what would be lost.
        BOOST_TEST((twin.dense * x - b).norm() <= 1e-12 * twin.dense.norm() * x.norm());
    }
}

BOOST_AUTO_TEST_CASE(zero_pivots_and_values_that_are_not_finite_are_reported) {
    RandomBlocks random(104);
    for (const int nodes : {1, 4, 20}) {
        Twin twin(random_sizes(nodes, random), tree(nodes, random));
        for (const int i : {0, nodes / 2, nodes - 1}) {
            twin.fill(random);
            twin.empty_node(i);
            BOOST_TEST(!twin.lu.factorize());
            twin.fill(random);
            twin.lu.block(twin.lu.slot(i, i))(0, 0) = std::numeric_limits<double>::quiet_NaN();
            BOOST_TEST(!twin.lu.factorize());
            twin.fill(random);
            twin.lu.block(twin.lu.slot(i, i))(0, 0) = std::numeric_limits<double>::infinity();
            BOOST_TEST(!twin.lu.factorize());
            // A failure leaves nothing behind.
            twin.fill(random);
            twin.check_solutions(random);
        }
    }
    talus::BlockLu never_filled;
    never_filled.analyze(std::vector<int>{2, 3}, Edges{{0, 1}});
    never_filled.set_zero();
    BOOST_TEST(!never_filled.factorize());
}

BOOST_AUTO_TEST_CASE(one_object_serves_many_patterns) {
    RandomBlocks random(105);
    talus::BlockLu lu;
    for (const int nodes : {30, 3, 60, 1}) {
        Twin twin(random_sizes(nodes, random), tree(nodes, random));
        twin.fill(random);
        std::vector<int> sizes;
        for (int i = 0; i < nodes; ++i) sizes.push_back(twin.size(i));
        Edges edges;
        for (int i = 0; i < nodes; ++i)
            for (int j = 0; j < i; ++j)
                if (!twin.dense.block(twin.offset(i), twin.offset(j), twin.size(i), twin.size(j))
                         .isZero(0.0))
                    edges.emplace_back(i, j);
        lu.analyze(sizes, edges);
        lu.set_zero();
        for (int i = 0; i < nodes; ++i) lu.block(lu.slot(i, i)) = twin.lu.block(twin.lu.slot(i, i));
        for (const auto& [i, j] : edges) {
            lu.block(lu.slot(i, j)) = twin.lu.block(twin.lu.slot(i, j));
            lu.block(lu.slot(j, i)) = twin.lu.block(twin.lu.slot(j, i));
        }
        BOOST_REQUIRE(lu.factorize());
        Eigen::VectorXd x = Eigen::VectorXd::Ones(lu.size());
        lu.solve(x);
        const Eigen::VectorXd b = Eigen::VectorXd::Ones(lu.size());
        BOOST_TEST((twin.dense * x - b).norm() <= 1e-12 * b.norm());
    }
}

BOOST_AUTO_TEST_CASE(empty_matrix_is_factorised) {
    talus::BlockLu lu;
    lu.analyze({}, {});
    BOOST_TEST(lu.size() == 0);
    BOOST_TEST(lu.factorize());
    Eigen::VectorXd x(0);
    lu.solve(x);
    BOOST_TEST(lu.operations() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
