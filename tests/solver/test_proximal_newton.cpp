// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(proximal_newton)

template <int Dim>
using Law = talus::Coulomb<Dim>;
template <int Dim>
using Solver = talus::ProximalNewton<Dim, Law<Dim>>;

constexpr int most = 300;  // factorisations

template <int Dim>
auto with_tolerance() {
    return [](double tolerance) {
        return Solver<Dim>({.max_iterations = most, .tolerance = tolerance});
    };
}
constexpr SolverPromises promises{.well_posed = 1e-10,
                                  .hyperstatic = 1e-8,
                                  .stiff = 1e-8,
                                  .rough = 1e-10,
                                  .knows_infeasible = true};

/// Far more contacts than the bodies can determine impulses for; u = 0 is within reach.
template <int Dim>
talus::ContactProblem<Dim, Law<Dim>> hyperstatic(RandomBlocks& random, double mu) {
    auto p =
        RandomProblem<Dim, Law<Dim>>{.bodies = 5, .contacts = 30, .arm = 0.1}.make(random, {mu});
    move_bodies_only<Dim>(p, random);
    return p;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(does_what_solvers_do, D, dimensions) {
    test_solver<D::value>([]<class L>(double tolerance, int max_iterations) {
        return talus::ProximalNewton<D::value, L>(
            {.max_iterations = max_iterations, .tolerance = tolerance});
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(is_robust_on_the_gallery, D, dimensions) {
    test_on_gallery(of_bodies<D::value>(with_tolerance<D::value>(), promises, most));
    test_on_gallery(of_blocks<D::value>(with_tolerance<D::value>(), promises, most));
    test_on_gallery(of_matrices<D::value>(with_tolerance<D::value>(), promises, most));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(forms_agree, D, dimensions) {
    constexpr int dim = D::value;
    test_forms_agree<dim>({of_bodies<dim>(with_tolerance<dim>(), {}, most),
                           of_blocks<dim>(with_tolerance<dim>(), {}, most),
                           of_matrices<dim>(with_tolerance<dim>(), {}, most)},
                          1e-12, 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(hyperstatic_problems_take_few_factorisations, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(151);
    int factorisations = 0;
    for (const double mu : {0.0, 0.2, 0.6})
        for (int k = 0; k < 20; ++k) {
            BOOST_TEST_INFO_SCOPE("mu = " << mu << ", problem " << k);
            const auto p = hyperstatic<dim>(random, mu);
            std::vector<talus::Vector<dim>> r(p.contact_count(), talus::Vector<dim>::Zero());
            Solver<dim> solver({.max_iterations = 300, .tolerance = 1e-12});
            BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::converged));
            BOOST_TEST((talus::residual(p, std::span<const talus::Vector<dim>>(r)).relative) <=
                       2e-12);
            factorisations += solver.report().iterations;
        }
    BOOST_TEST(factorisations < 60 * 60);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(velocities_are_those_of_sweeps, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(152);
    for (int k = 0; k < 20; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        auto p = RandomProblem<dim, Law<dim>>{.bodies = 8, .contacts = 6, .arm = 0.1}.make(
            random, Law<dim>{0.3});
        std::vector<talus::Vector<dim>> r(6, talus::Vector<dim>::Zero()), oracle = r;
        Solver<dim> solver({.tolerance = 1e-12});
        solver.solve(p, r);
        talus::GaussSeidel<dim, Law<dim>> sweeps({.max_sweeps = 100000, .tolerance = 1e-12});
        BOOST_REQUIRE((sweeps.solve(p, oracle).status == talus::SolveStatus::converged));
        BOOST_TEST((solver.report().status == talus::SolveStatus::converged));
        BOOST_TEST(distance<dim>(end_velocities(p, r), end_velocities(p, oracle)) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_limit_keeps_the_best_impulses, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(153);
    const auto p = hyperstatic<dim>(random, 0.5);
    double last = 1e300;
    for (int limit = 0; limit <= 6; ++limit) {
        std::vector<talus::Vector<dim>> r(p.contact_count(), talus::Vector<dim>::Zero());
        Solver<dim> solver({.max_iterations = limit, .tolerance = 1e-14});
        const auto& report = solver.solve(p, r);
        BOOST_TEST(report.iterations <= limit);
        if (report.residual > 1e-14)
            BOOST_TEST((report.status == talus::SolveStatus::iteration_limit));
        BOOST_TEST(report.residual <= last);
        last = report.residual;
    }
    BOOST_TEST(last < 0.02);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(input_out_of_range_is_refused, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(154);
    const auto p = hyperstatic<dim>(random, 0.5);
    std::vector<talus::Vector<dim>> r(p.contact_count(), talus::Vector<dim>::Zero());
    for (const double proximal : {0.0, -1.0, double(NAN)})
        BOOST_CHECK_THROW(Solver<dim>({.proximal = proximal}).solve(p, r), talus::input_error);
    BOOST_CHECK_THROW(Solver<dim>({.max_iterations = -1}).solve(p, r), talus::input_error);
    r.pop_back();
    BOOST_CHECK_THROW(Solver<dim>().solve(p, r), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
