// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

using talus::Acceleration;

BOOST_AUTO_TEST_SUITE(accelerated_gauss_seidel)

BOOST_AUTO_TEST_CASE_TEMPLATE(it_is_a_contact_solver, D, dimensions) {
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson})
        test_solver<D::value>([acceleration]<class Law>(double tolerance, int max_iterations) {
            return talus::AcceleratedGaussSeidel<D::value, Law>({.max_iterations = max_iterations,
                                                                 .tolerance = tolerance,
                                                                 .acceleration = acceleration});
        });
}

// A tower: sweeps grow with the square of its height, accelerated ones with the height.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_tower_takes_far_fewer_passes_than_plain_sweeps, D, dimensions) {
    constexpr int dim = D::value;
    using Law = talus::Coulomb<dim>;
    auto p = stack_of_particles<dim>(std::vector<double>(60, 1.0), Law{.mu = 0.5});
    p.free_velocity[0][0] = -1.0;
    std::vector<talus::Vector<dim>> r(60, talus::Vector<dim>::Zero());
    talus::GaussSeidel<dim, Law> plain({.max_sweeps = 100000, .tolerance = 1e-8});
    const int sweeps = plain.solve(p, r).iterations;
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson}) {
        std::fill(r.begin(), r.end(), talus::Vector<dim>::Zero());
        talus::AcceleratedGaussSeidel<dim, Law> solver(
            {.max_iterations = 10000, .tolerance = 1e-8, .acceleration = acceleration});
        const auto& report = solver.solve(p, r);
        BOOST_TEST((report.status == talus::SolveStatus::converged));
        BOOST_TEST(2 * report.iterations < sweeps / 4);
    }
}

BOOST_AUTO_TEST_CASE(a_depth_out_of_range_is_refused) {
    using Law = talus::Coulomb<2>;
    auto p = stack_of_particles<2>({1.0}, Law{.mu = 0.5});
    std::vector<talus::Vector<2>> r(1, talus::Vector<2>::Zero());
    for (const int depth : {0, 21}) {
        talus::AcceleratedGaussSeidel<2, Law> solver({.depth = depth});
        BOOST_CHECK_THROW(solver.solve(p, r), talus::input_error);
    }
}

BOOST_AUTO_TEST_SUITE_END()
