// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/spatial/local_frame.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(automatic)

template <int Dim>
using Law = talus::Coulomb<Dim>;

/// A ball between two obstacles that come towards each other with speed 1 each.
template <int Dim>
talus::ContactProblem<Dim, Law<Dim>> squeezed_ball() {
    auto p = stack_of_particles<Dim>({1.0, 1.0}, Law<Dim>{.mu = 0.5});
    // Bodies 0 and 1 of the stack and an obstacle below: make the upper body an obstacle too.
    p.inverse_mass.linear[1] = 0.0;
    for (auto& u : p.free_velocity) u = -talus::Vector<Dim>::Unit(0);
    return p;
}

/// A triangular heap of discs of radius and mass 1 on a floor, under gravity, about to flow: the
/// interior point's path folds in it.
talus::ContactProblem<2, Law<2>> lattice_heap(int base) {
    talus::ContactProblem<2, Law<2>> p;
    std::vector<talus::Vector<2>> centre;
    for (int row = 0; row < base; ++row)
        for (int k = 0; k + row < base; ++k)
            centre.emplace_back(2.0 * k + row, std::sqrt(3.0) * row);
    const int discs = static_cast<int>(centre.size());
    p.inverse_mass.resize(centre.size() + 1);
    for (std::size_t i = 0; i <= centre.size(); ++i) {
        p.inverse_mass.linear[i] = i < centre.size() ? 1.0 : 0.0;
        p.inverse_mass.angular[i].setConstant(2.0 * p.inverse_mass.linear[i]);
    }
    std::vector<std::array<int, 2>> pairs;
    for (int i = 0; i < discs; ++i) {
        if (i < base) pairs.push_back({i, discs});
        for (int j = 0; j < i; ++j)
            if ((centre[static_cast<std::size_t>(i)] - centre[static_cast<std::size_t>(j)]).norm() <
                2.1)
                pairs.push_back({i, j});
    }
    p.jacobian.resize(pairs.size());
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        const auto [a, b] = pairs[c];
        talus::Vector<2> n = talus::Vector<2>::Unit(1);
        if (b < discs)
            n = 0.5 * (centre[static_cast<std::size_t>(a)] - centre[static_cast<std::size_t>(b)]);
        p.jacobian.a[c] = a;
        p.jacobian.b[c] = b;
        p.jacobian.frame[c] = talus::local_frame<2>(n);
        p.jacobian.arm_a[c] = -n;
        p.jacobian.arm_b[c] = n;
        // Among discs nothing moves yet: they all fall alike.
        p.free_velocity.push_back((b == discs ? -1.0 : 0.0) * talus::Vector<2>::Unit(0));
        p.laws.push_back(Law<2>{0.5});
    }
    return p;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(it_is_a_contact_solver, D, dimensions) {
    test_solver<D::value>([]<class L>(double tolerance, int max_sweeps) {
        return talus::Automatic<D::value, L>({.tolerance = tolerance, .max_sweeps = max_sweeps});
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(hyperstatic_problems_are_solved_to_rounding, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(80);
    for (int k = 0; k < 40; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        auto p = RandomProblem<dim, Law<dim>>{.bodies = 6, .contacts = 20, .arm = 0.1}.make(random,
                                                                                            {0.5});
        move_bodies_only<dim>(p, random);
        std::vector<talus::Vector<dim>> r(20, talus::Vector<dim>::Zero());
        talus::Automatic<dim, Law<dim>> solver({.tolerance = 1e-10});
        const auto& report = solver.solve(p, r);
        BOOST_TEST((report.status == talus::SolveStatus::converged));
        BOOST_TEST(talus::residual(p, std::span<const talus::Vector<dim>>(r)).relative <= 1e-10);
        BOOST_TEST(!report.stages.empty());
        int iterations = 0;
        for (const auto& stage : report.stages) iterations += stage.iterations;
        BOOST_TEST(iterations == report.iterations);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(factors_take_no_more_memory_than_allowed, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(84);
    auto p =
        RandomProblem<dim, Law<dim>>{.bodies = 6, .contacts = 20, .arm = 0.1}.make(random, {0.5});
    move_bodies_only<dim>(p, random);
    const auto factorises = [&](double bytes) {
        std::vector<talus::Vector<dim>> r(20, talus::Vector<dim>::Zero());
        talus::Automatic<dim, Law<dim>> solver({.tolerance = 1e-15, .max_factor_bytes = bytes});
        for (const auto& stage : solver.solve(p, r).stages)
            if (stage.engine == "interior_point" || stage.engine == "newton_polish") return true;
        return false;
    };
    BOOST_TEST(factorises(1e6));
    BOOST_TEST(!factorises(100.0));
    BOOST_CHECK_THROW(factorises(-1.0), talus::input_error);
}

/// Also not for a proof that nothing solves the problem: a squeezed chain, from impulses beside
/// which its loads are small.
BOOST_AUTO_TEST_CASE_TEMPLATE(limits_hold_for_proofs_too, D, dimensions) {
    constexpr int dim = D::value;
    constexpr std::size_t n = 200;
    auto p = stack_of_particles<dim>(std::vector<double>(n, 1.0), Law<dim>{.mu = 0.5});
    p.inverse_mass.linear[n - 1] = 0.0;
    for (auto& u : p.free_velocity) u = -talus::Vector<dim>::Unit(0);
    const auto is_proven = [&](talus::AutomaticParams params) {
        params.tolerance = 1e-2;
        std::vector<talus::Vector<dim>> r(n, 1e12 * talus::Vector<dim>::Unit(0));
        talus::Automatic<dim, Law<dim>> solver(params);
        return solver.solve(p, r).status == talus::SolveStatus::no_solution;
    };
    BOOST_TEST(is_proven({}));
    BOOST_TEST(!is_proven({.max_factorizations = 0}));
    BOOST_TEST(!is_proven({.max_factor_bytes = 0.0}));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(blocks_and_bodies_lead_to_the_same_velocities, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(81);
    for (int k = 0; k < 10; ++k) {
        auto p = RandomProblem<dim, Law<dim>>{.bodies = 8, .contacts = 6, .arm = 0.1}.make(random,
                                                                                           {0.3});
        move_bodies_only<dim>(p, random);
        std::vector<talus::Vector<dim>> by_bodies(6, talus::Vector<dim>::Zero());
        auto by_blocks = by_bodies;
        talus::Automatic<dim, Law<dim>> solver({.tolerance = 1e-13});
        solver.solve(p, by_bodies);
        talus::AssembledProblem<dim, Law<dim>> assembled{
            {p.jacobian, p.inverse_mass}, p.free_velocity, p.laws};
        solver.solve(assembled, by_blocks);
        BOOST_TEST(distance<dim>(end_velocities(p, by_bodies), end_velocities(p, by_blocks)) <
                   1e-9);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_squeezed_by_obstacles_have_no_solution, D, dimensions) {
    constexpr int dim = D::value;
    auto p = squeezed_ball<dim>();
    std::vector<talus::Vector<dim>> r(2, talus::Vector<dim>::Zero());
    talus::Automatic<dim, Law<dim>> solver;
    BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::no_solution));
    for (const auto& x : r) BOOST_TEST(x.allFinite());
    // Impulses beside which the obstacles' motion is small are no jam: a jam balances.
    r.assign(2, 1e12 * talus::Vector<dim>::Unit(0));
    const auto& report = solver.solve(p, r);
    BOOST_TEST((report.status == talus::SolveStatus::no_solution));
    BOOST_TEST(report.residual > solver.params.tolerance);
    r.assign(2, 1e12 * talus::Vector<dim>::Unit(0));
    BOOST_TEST(talus::residual(p, std::span<const talus::Vector<dim>>(r)).relative >= 1.0);
    // One obstacle that gives way as fast as the other comes: the ball moves with them.
    r.assign(2, talus::Vector<dim>::Zero());
    p.free_velocity[1] *= -1.0;
    BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::converged));
}

/// Nothing of a solve stays behind in the solver: no verdict, no rate, no factor.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_solver_used_before_answers_like_a_new_one, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(85);
    talus::Automatic<dim, Law<dim>> used({.tolerance = 1e-12});
    for (int k = 0; k < 6; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        auto squeezed = squeezed_ball<dim>();
        std::vector<talus::Vector<dim>> r(2, talus::Vector<dim>::Zero());
        BOOST_TEST((used.solve(squeezed, r).status == talus::SolveStatus::no_solution));
        auto p = RandomProblem<dim, Law<dim>>{.bodies = 6, .contacts = 20, .arm = 0.1}.make(random,
                                                                                            {0.5});
        move_bodies_only<dim>(p, random);
        std::vector<talus::Vector<dim>> by_used(20, talus::Vector<dim>::Zero()), by_new = by_used;
        talus::Automatic<dim, Law<dim>> fresh({.tolerance = 1e-12});
        const auto status = fresh.solve(p, by_new).status;
        BOOST_TEST((used.solve(p, by_used).status == status));
        for (std::size_t i = 0; i < by_new.size(); ++i) BOOST_TEST((by_used[i] == by_new[i]));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_between_obstacles_cannot_be_pushed_apart, D, dimensions) {
    constexpr int dim = D::value;
    auto p = stack_of_particles<dim>({1.0}, Law<dim>{.mu = 0.5});
    p.inverse_mass.linear[0] = 0.0;
    std::vector<talus::Vector<dim>> r(1, talus::Vector<dim>::Zero());
    talus::Automatic<dim, Law<dim>> solver;
    p.free_velocity[0] = -talus::Vector<dim>::Unit(0);
    BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::no_solution));
    p.free_velocity[0] = talus::Vector<dim>::Unit(0);
    BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::converged));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(laws_without_a_cone_are_left_to_sweeps, D, dimensions) {
    constexpr int dim = D::value;
    using Any = talus::AnyLaw<dim, talus::Coulomb<dim>, talus::Bilateral<dim>>;
    RandomBlocks random(82);
    auto p = RandomProblem<dim, Any>{.bodies = 8, .contacts = 6, .arm = 0.1}.make(
        random, Any{talus::Coulomb<dim>{0.3}});
    p.laws[2].law = talus::Bilateral<dim>{};
    move_bodies_only<dim>(p, random);
    std::vector<talus::Vector<dim>> r(6, talus::Vector<dim>::Zero());
    talus::Automatic<dim, Any> solver({.tolerance = 1e-10});
    const auto& report = solver.solve(p, r);
    BOOST_TEST((report.status == talus::SolveStatus::converged));
    for (const auto& stage : report.stages)
        BOOST_TEST((stage.engine != "interior_point" && stage.engine != "newton_polish"));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(laws_that_never_have_a_cone_are_solved, D, dimensions) {
    constexpr int dim = D::value;
    using Pin = talus::Bilateral<dim>;
    auto p = stack_of_particles<dim>({1.0, 1.0}, Pin{});
    p.free_velocity[0] = -talus::Vector<dim>::Unit(0);
    std::vector<talus::Vector<dim>> r(2, talus::Vector<dim>::Zero());
    talus::Automatic<dim, Pin> solver({.tolerance = 1e-12});
    BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::converged));
}

BOOST_AUTO_TEST_CASE(where_no_engine_arrives_all_take_turns_and_the_best_impulses_are_returned) {
    const auto p = lattice_heap(26);
    std::vector<talus::Vector<2>> r(p.contact_count(), talus::Vector<2>::Zero());
    talus::Automatic<2, Law<2>> solver({.tolerance = 1e-12, .max_sweeps = 3000});
    const auto& report = solver.solve(p, r);
    BOOST_TEST((report.status == talus::SolveStatus::iteration_limit));
    const double residual = talus::residual(p, std::span<const talus::Vector<2>>(r)).relative;
    BOOST_TEST(std::abs(residual - report.residual) <= 1e-6 * residual);
    int iterations = 0;
    for (const auto& stage : report.stages) {
        iterations += stage.iterations;
        BOOST_TEST(report.residual <= stage.residual * (1.0 + 1e-6), stage.engine);
    }
    BOOST_TEST(iterations == report.iterations);
    for (const std::string_view engine :
         {"gauss_seidel", "anderson", "nesterov", "interior_point", "proximal_newton",
          "spectral_gradient", "accelerated_gradient"}) {
        const auto is_it = [&](const talus::SolveStage& stage) { return stage.engine == engine; };
        BOOST_TEST(std::any_of(report.stages.begin(), report.stages.end(), is_it), engine);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(same_input_same_bits, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(83);
    auto p =
        RandomProblem<dim, Law<dim>>{.bodies = 6, .contacts = 20, .arm = 0.1}.make(random, {0.5});
    move_bodies_only<dim>(p, random);
    std::vector<talus::Vector<dim>> once(20, talus::Vector<dim>::Zero());
    auto again = once, fresh = once;
    talus::Automatic<dim, Law<dim>> solver({.tolerance = 1e-10});
    solver.solve(p, once);
    solver.solve(p, again);
    talus::Automatic<dim, Law<dim>>({.tolerance = 1e-10}).solve(p, fresh);
    BOOST_TEST(distance<dim>(once, again) == 0.0);
    BOOST_TEST(distance<dim>(once, fresh) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
