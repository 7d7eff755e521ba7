// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/newton_polish.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(interior_point)

template <int Dim>
using Law = talus::Coulomb<Dim>;

template <int Dim>
talus::ContactProblem<Dim, Law<Dim>> well_posed(RandomBlocks& random, double mu) {
    auto p =
        RandomProblem<Dim, Law<Dim>>{.bodies = 8, .contacts = 6, .arm = 0.1}.make(random, {mu});
    move_bodies_only<Dim>(p, random);
    return p;
}

/// The report tells the truth of r.
template <int Dim>
void check_report(const talus::ContactProblem<Dim, Law<Dim>>& p,
                  const std::vector<talus::Vector<Dim>>& r, const talus::SolveReport& report,
                  double tolerance) {
    const double eta = talus::residual(p, std::span<const talus::Vector<Dim>>(r)).relative;
    BOOST_TEST(std::abs(eta - report.residual) <= 1e-12 + 1e-6 * eta);
    BOOST_TEST((report.status == talus::SolveStatus::converged) == (report.residual <= tolerance));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(well_posed_problems_are_solved_in_few_iterations, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(95);
    for (const double mu : {0.0, 0.1, 0.5})
        for (int k = 0; k < 20; ++k) {
            BOOST_TEST_INFO_SCOPE("mu = " << mu << ", problem " << k);
            const auto p = well_posed<dim>(random, mu);
            std::vector<talus::Vector<dim>> r(6, talus::Vector<dim>::Zero());
            talus::InteriorPoint<dim, Law<dim>> solver({.max_iterations = 40, .tolerance = 1e-7});
            check_report<dim>(p, r, solver.solve(p, r), 1e-7);
            BOOST_TEST((solver.report().status == talus::SolveStatus::converged));
            talus::NewtonPolish<dim, Law<dim>> polish({.tolerance = 1e-12});
            check_report<dim>(p, r, polish.solve(p, r), 1e-12);
            std::vector<talus::Vector<dim>> oracle(6, talus::Vector<dim>::Zero());
            talus::GaussSeidel<dim, Law<dim>> plain({.max_sweeps = 100000, .tolerance = 1e-13});
            plain.solve(p, oracle);
            // Velocities are unique; the solver's are exact to its residual times the condition.
            const double reached = solver.report().residual;
            BOOST_TEST(distance<dim>(end_velocities(p, r), end_velocities(p, oracle)) <
                       1e3 * reached + 1e-9);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_margin_that_is_not_positive_is_refused, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(96);
    const auto p = well_posed<dim>(random, 0.5);
    std::vector<talus::Vector<dim>> r(6, talus::Vector<dim>::Zero());
    talus::InteriorPoint<dim, Law<dim>> solver({.margin = 0.0});
    BOOST_CHECK_THROW(solver.solve(p, r), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
