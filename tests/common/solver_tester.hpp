// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/coulomb.hpp>
#include <talus/law/signorini.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/concepts.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <vector>

#include "common/random_problem.hpp"

/// Relative velocities at the end, W r + u_free.
template <int Dim, class Law>
std::vector<talus::Vector<Dim>> end_velocities(const talus::ContactProblem<Dim, Law>& p,
                                               const std::vector<talus::Vector<Dim>>& r) {
    std::vector<talus::Vector<Dim>> u(r.size());
    talus::DelassusProduct<Dim>(p.jacobian, p.inverse_mass).multiply(r, u);
    for (std::size_t i = 0; i < r.size(); ++i) u[i] += p.free_velocity[i];
    return u;
}

/// Largest difference of two lists of vectors.
template <int Dim>
double distance(const std::vector<talus::Vector<Dim>>& x,
                const std::vector<talus::Vector<Dim>>& y) {
    double d = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) d = std::max(d, (x[i] - y[i]).norm());
    return d;
}

/// What every ContactSolver must do. `make.template operator()<Law>(tolerance, max_sweeps)` returns
/// a solver for that law.
template <int Dim, class Make>
class SolverTester {
  public:
    explicit SolverTester(Make make) : make_(make) {}

    void run() {
        two_stacked_masses_rest_and_stick();
        random_problems_are_solved();
        light_on_heavy_is_solved();
        extreme_masses_are_reported_truly();
        infeasible_contact_is_reported();
        empty_problem_is_converged();
        solved_warm_start_is_left_alone();
        input_that_is_not_finite_leaves_the_impulses_alone();
    }

  private:
    using Vec = talus::Vector<Dim>;
    using Coulomb = talus::Coulomb<Dim>;

    /// Solves and checks that the report tells the truth.
    template <class Law>
    talus::SolveReport solve(const talus::ContactProblem<Dim, Law>& p, std::vector<Vec>& r,
                             double tolerance, int max_sweeps = 100000) {
        auto solver = make_.template operator()<Law>(tolerance, max_sweeps);
        static_assert(talus::ContactSolver<decltype(solver), Dim, Law>);
        const talus::SolveReport report = solver.solve(p, r);
        for (const Vec& x : r) BOOST_TEST(x.allFinite());
        const double eta = talus::residual(p, std::span<const Vec>(r)).relative;
        BOOST_TEST(std::abs(report.residual - eta) <= 1e-12 + 1e-6 * eta);
        BOOST_TEST((report.status == talus::SolveStatus::converged) ==
                   (report.residual <= tolerance));
        BOOST_TEST(report.iterations <= max_sweeps);
        BOOST_REQUIRE(!report.history.empty());
        BOOST_TEST(report.history.back().residual == report.residual);
        return report;
    }
    template <class Law>
    void must_converge(const talus::ContactProblem<Dim, Law>& p, double tolerance) {
        std::vector<Vec> r(p.contact_count(), Vec::Zero());
        const auto report = solve(p, r, tolerance);
        BOOST_TEST((report.status == talus::SolveStatus::converged));
        const double reached = report.residual;
        BOOST_TEST(reached <= tolerance);
    }

    // W = (1 -1; -1 2) times the identity: both masses come to rest, sticking.
    void two_stacked_masses_rest_and_stick() {
        auto p = stack_of_particles<Dim>({1.0, 1.0}, Coulomb{.mu = 0.5});
        p.free_velocity[0].template head<2>() << -1.0, 0.3;
        p.free_velocity[1].template head<2>() << 0.0, 0.1;
        std::vector<Vec> r(2, Vec::Zero());
        solve(p, r, 1e-13);
        std::vector<Vec> exact(2, Vec::Zero());
        exact[0].template head<2>() << 2.0, -0.7;
        exact[1].template head<2>() << 1.0, -0.4;
        BOOST_TEST(distance<Dim>(r, exact) < 1e-11);
    }
    void random_problems_are_solved() {
        RandomBlocks random(51);
        for (int k = 0; k < 10; ++k)
            for (const double mu : {0.0, 0.3, 1.0, 1e3}) {
                BOOST_TEST_INFO_SCOPE("problem " << k << ", mu = " << mu);
                // Without arms, as with any mu large, W_tn must vanish: no catastrophes of
                // friction.
                const double arm = mu <= 1.0 ? 0.1 : 0.0;
                auto determined =
                    RandomProblem<Dim, Coulomb>{.bodies = 8, .contacts = 5, .arm = arm}.make(random,
                                                                                             {mu});
                move_bodies_only<Dim>(determined, random);
                must_converge(determined, 1e-9);
                auto hyperstatic =
                    RandomProblem<Dim, Coulomb>{.bodies = 5, .contacts = 16, .arm = arm}.make(
                        random, {mu});
                move_bodies_only<Dim>(hyperstatic, random);
                must_converge(hyperstatic, 1e-5);
            }
    }
    void light_on_heavy_is_solved() {
        auto p = stack_of_particles<Dim>({1e6, 1.0}, Coulomb{.mu = 0.5});
        p.free_velocity[0][0] = -1.0;
        must_converge(p, 1e-12);
    }
    // One solve may need 1e7 sweeps; what counts here is that `solve` above finds the report true.
    void extreme_masses_are_reported_truly() {
        RandomBlocks random(52);
        for (int k = 0; k < 5; ++k) {
            auto p =
                RandomProblem<Dim, Coulomb>{.contacts = 12, .mass_ratio = 1e6}.make(random, {0.5});
            move_bodies_only<Dim>(p, random);
            std::vector<Vec> r(p.contact_count(), Vec::Zero());
            solve(p, r, 1e-8, 1000);
        }
    }
    void infeasible_contact_is_reported() {
        auto p = twice(stack_of_particles<Dim>({1.0}, Coulomb{.mu = 0.5}));
        for (Vec& u : p.free_velocity) u = -Vec::Unit(0);
        p.inverse_mass.linear[0] = 0.0;
        std::vector<Vec> r(2, Vec::Zero());
        const auto status = solve(p, r, 1e-8).status;
        BOOST_TEST((status == talus::SolveStatus::iteration_limit ||
                    status == talus::SolveStatus::no_solution));
        // Where the solver gives up at its limit, the other contact is solved none the less.
        if (status == talus::SolveStatus::iteration_limit)
            BOOST_TEST((r[1] - Vec::Unit(0)).norm() < 1e-7);
    }
    void empty_problem_is_converged() {
        std::vector<Vec> r;
        const auto report = solve(talus::ContactProblem<Dim, Coulomb>{}, r, 0.0);
        BOOST_TEST(report.iterations == 0);
        BOOST_TEST(report.residual == 0.0);
    }
    void solved_warm_start_is_left_alone() {
        RandomBlocks random(53);
        auto p = RandomProblem<Dim, Coulomb>{.contacts = 5}.make(random, {0.5});
        move_bodies_only<Dim>(p, random);
        std::vector<Vec> r(p.contact_count(), Vec::Zero());
        const auto cold = solve(p, r, 1e-10);
        BOOST_TEST(cold.iterations > 0);
        auto again = r;
        BOOST_TEST(solve(p, again, 1e-10).iterations == 0);
        BOOST_TEST(distance<Dim>(r, again) == 0.0);
    }
    void input_that_is_not_finite_leaves_the_impulses_alone() {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        const auto check = [&](auto spoil) {
            RandomBlocks random(54);
            auto p = RandomProblem<Dim, Coulomb>{}.make(random, {0.5});
            spoil(p);
            std::vector<Vec> r(p.contact_count(), Vec::Ones());
            auto solver = make_.template operator()<Coulomb>(1e-8, 10);
            BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::not_finite));
            BOOST_TEST(distance<Dim>(r, std::vector<Vec>(r.size(), Vec::Ones())) == 0.0);
        };
        check([&](auto& p) { p.free_velocity[1][0] = nan; });
        check([&](auto& p) { p.inverse_mass.linear[0] = nan; });
        check([&](auto& p) { p.inverse_mass.linear[0] = std::numeric_limits<double>::infinity(); });
        check([&](auto& p) { p.jacobian.frame[2](0, 0) = nan; });
        check([&](auto& p) { p.laws[2].mu = nan; });
    }

    Make make_;
};

template <int Dim, class Make>
void test_solver(Make make) {
    SolverTester<Dim, Make>(make).run();
}
