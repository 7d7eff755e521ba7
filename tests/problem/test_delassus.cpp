// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>
#include <talus/problem/delassus_product.hpp>
#include <talus/problem/delassus_sparse.hpp>

#include "common/delassus_tester.hpp"
#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(delassus)

BOOST_AUTO_TEST_CASE_TEMPLATE(operators_equal_the_dense_matrix, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(31);
    for (int k = 0; k < 20; ++k) {
        const RandomProblem<dim, talus::Coulomb<dim>> kind{
            .bodies = 3 + k, .contacts = 1 + 2 * k, .mass_ratio = 100.0, .guided = k % 2 == 1};
        const auto p = kind.make(random, {.mu = 0.5});
        const Eigen::MatrixXd dense = dense_delassus<dim>(p.jacobian, p.inverse_mass);
        talus::DelassusProduct<dim> product(p.jacobian, p.inverse_mass);
        test_delassus<dim>(product, dense, random);
        talus::DelassusSparse<dim> sparse(p.jacobian, p.inverse_mass);
        test_delassus<dim>(sparse, dense, random);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(scalar_inertia_kernel_equals_the_plain_one, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(32);
    const RandomProblem<dim, talus::Coulomb<dim>> kind{
        .bodies = 10, .contacts = 30, .scalar_inertia = true};
    const auto p = kind.make(random, {.mu = 0.5});
    BOOST_TEST(talus::has_scalar_inertia(p.inverse_mass));
    talus::DelassusProduct<dim, double> scalar(p.jacobian, p.inverse_mass);
    test_delassus<dim>(scalar, dense_delassus<dim>(p.jacobian, p.inverse_mass), random);

    auto turned = p.inverse_mass;
    turned.angular[0](0, 0) *= 1.0 + 1e-15;
    BOOST_TEST(talus::has_scalar_inertia(turned) == (dim == 2));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sparse_operator_sums_blocks_of_equal_place, D, dimensions) {
    constexpr int dim = D::value;
    using Block = talus::DelassusBlock<dim>;
    const talus::Matrix<dim> one = talus::Matrix<dim>::Identity();
    talus::DelassusSparse<dim> w(
        3, {Block{0, 0, one}, Block{2, 1, 3.0 * one}, Block{1, 2, one}, Block{1, 2, 2.0 * one}});
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * dim, 3 * dim);
    dense.topLeftCorner<dim, dim>() = one;
    dense.block<dim, dim>(dim, 2 * dim) = dense.block<dim, dim>(2 * dim, dim) = 3.0 * one;
    BOOST_TEST(w.block_count() == 5U);
    RandomBlocks random(33);
    test_delassus<dim>(w, dense, random);
    BOOST_CHECK_THROW(talus::DelassusSparse<dim>(2, {Block{0, 2, one}}), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
