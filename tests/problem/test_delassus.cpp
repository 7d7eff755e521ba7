// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>
#include <talus/problem/delassus_product.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/problem/rigid_body_operators.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

BOOST_AUTO_TEST_CASE_TEMPLATE(a_driven_cell_is_one_more_body, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(34);
    for (int k = 0; k < 10; ++k) {
        const RandomProblem<dim, talus::Coulomb<dim>> kind{
            .bodies = 3 + k, .contacts = 1 + 2 * k, .guided = k % 2 == 1, .driven = true};
        const auto p = kind.make(random, {.mu = 0.5});
        talus::DelassusProduct<dim> product(p.jacobian, p.inverse_mass);
        test_delassus<dim>(product, dense_delassus<dim>(p.jacobian, p.inverse_mass), random);
        const auto is_refusal = [](const talus::input_error& error) {
            return std::string(error.what()) ==
                   "periodic cell is driven by a stress, but must be imposed: W assembled has no "
                   "room for it";
        };
        BOOST_CHECK_EXCEPTION((talus::DelassusSparse<dim>(p.jacobian, p.inverse_mass)),
                              talus::input_error, is_refusal);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_driven_cell_connects_what_pushes_it, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(35);
    // Contacts of: two that do not move, with a lever; a free one and an obstacle, with a lever;
    // the same without; two that do not move, without; another free one, with a lever.
    const RandomProblem<dim, talus::Coulomb<dim>> kind{.bodies = 6, .contacts = 5, .driven = true};
    auto p = kind.make(random, {.mu = 0.5});
    for (const std::size_t still : {0u, 1u, 5u}) {
        p.inverse_mass.linear[still] = 0.0;
        p.inverse_mass.angular[still].setZero();
    }
    const talus::BodyIndex a[] = {0, 2, 3, 0, 4}, b[] = {1, 5, 5, 1, 5};
    for (std::size_t c = 0; c < 5; ++c) {
        p.jacobian.a[c] = a[c];
        p.jacobian.b[c] = b[c];
        p.jacobian.cell_lever[c] = c == 2 || c == 3
                                       ? talus::Vector<dim>(talus::Vector<dim>::Zero())
                                       : talus::Vector<dim>(talus::Vector<dim>::Ones());
    }
    const talus::DelassusProduct<dim> w(p.jacobian, p.inverse_mass);
    std::vector<std::uint32_t> label(5);
    w.islands(label);
    const std::vector<std::uint32_t> expected{0, 0, 2, 3, 0};
    BOOST_TEST(label == expected, boost::test_tools::per_element());
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
