// SPDX-License-Identifier: BSL-1.0
// Problems with a periodic cell that a stress drives: solvers on body velocities and solvers on
// BodyMap find the same velocities.
#include <talus/law/coulomb.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(driven_problems)

template <int Dim>
using Law = talus::Coulomb<Dim>;

/// u = W r + u_free of what a solver finds.
template <int Dim, class Solver>
std::vector<talus::Vector<Dim>> velocities(const talus::ContactProblem<Dim, Law<Dim>>& p,
                                           Solver solver) {
    std::vector<talus::Vector<Dim>> r(p.contact_count(), talus::Vector<Dim>::Zero()), u(r);
    const auto& report = solver.solve(p, r);
    BOOST_TEST((report.status == talus::SolveStatus::converged));
    talus::DelassusProduct<Dim>(p.jacobian, p.inverse_mass).multiply(r, u);
    for (std::size_t c = 0; c < u.size(); ++c) u[c] += p.free_velocity[c];
    return u;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(all_solvers_find_the_same_velocities, D, dimensions) {
    constexpr int Dim = D::value;
    RandomBlocks random(91);
    constexpr double tolerance = 1e-11;
    for (int k = 0; k < 20; ++k) {
        // Light friction and no more contacts than bodies: one solution.
        const auto p =
            RandomProblem<Dim, Law<Dim>>{.bodies = 9, .contacts = 8, .driven = true}.make(
                random, {.mu = 0.2});
        const auto swept = velocities<Dim>(
            p, talus::GaussSeidel<Dim, Law<Dim>>({.max_sweeps = 100000, .tolerance = tolerance}));
        const auto handed = velocities<Dim>(p, talus::Automatic<Dim, Law<Dim>>({
                                                   .tolerance = tolerance,
                                               }));
        // By itself it ends between 1e-8 and 1e-7 in space, with a driven cell and without.
        const auto inner =
            velocities<Dim>(p, talus::InteriorPoint<Dim, Law<Dim>>({.tolerance = 1e-6}));
        for (std::size_t c = 0; c < swept.size(); ++c) {
            BOOST_TEST((handed[c] - swept[c]).norm() < 1e-7);
            BOOST_TEST((inner[c] - swept[c]).norm() < 1e-4);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
