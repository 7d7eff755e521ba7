// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

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

// A tower from nothing, with a tolerance, an aim and what may be spent on that.
template <int Dim>
struct Aimed {
    using Law = talus::Coulomb<Dim>;
    talus::ContactProblem<Dim, Law> problem;
    std::vector<talus::Vector<Dim>> r;
    talus::SolveReport report;

    static constexpr std::size_t contacts = 60;

    Aimed(Acceleration acceleration, double tolerance, double aim, double effort,
          int max_iterations = 10000)
        : problem(stack_of_particles<Dim>(std::vector<double>(contacts, 1.0), Law{.mu = 0.5})),
          r(contacts, talus::Vector<Dim>::Zero()) {
        problem.free_velocity[0][0] = -1.0;
        talus::AcceleratedGaussSeidel<Dim, Law> solver({.max_iterations = max_iterations,
                                                        .tolerance = tolerance,
                                                        .acceleration = acceleration,
                                                        .aim = aim,
                                                        .effort = effort});
        report = solver.solve(problem, r);
    }
    double residual() const { return talus::residual<Dim, Law>(problem, r).relative; }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(it_goes_on_to_the_aim_while_that_is_cheap, D, dimensions) {
    constexpr int dim = D::value;
    constexpr double none = std::numeric_limits<double>::infinity();
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson}) {
        const Aimed<dim> rough(acceleration, 1e-2, none, 1e6), fine(acceleration, 1e-8, none, 1e6);
        BOOST_TEST(rough.report.iterations < fine.report.iterations);
        BOOST_TEST(rough.residual() > 1e-4);

        const Aimed<dim> aimed(acceleration, 1e-2, 1e-8, 1e6);
        BOOST_TEST((aimed.report.status == talus::SolveStatus::converged));
        BOOST_TEST(aimed.report.iterations == fine.report.iterations);
        BOOST_TEST((aimed.r == fine.r));
        // A tolerance below the aim is what counts.
        const Aimed<dim> strict(acceleration, 1e-8, 1e-2, 1e6);
        BOOST_TEST((strict.r == fine.r));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_aim_too_far_costs_its_effort_and_no_more, D, dimensions) {
    constexpr int dim = D::value;
    constexpr double unreachable = 0.0;
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson}) {
        for (const int passes : {55, 60, 70, 85, 100}) {
            const double effort = 2.0 * Aimed<dim>::contacts * passes;
            const Aimed<dim> aimed(acceleration, 1e-2, unreachable, effort);
            BOOST_TEST((aimed.report.status == talus::SolveStatus::converged));
            BOOST_TEST(aimed.report.iterations == passes);
            // What is returned is the best that was measured, and what the report says of it.
            BOOST_TEST(aimed.residual() == aimed.report.residual);
            for (const auto& sample : aimed.report.history)
                BOOST_TEST(aimed.report.residual <= sample.residual);
        }
        // Never less than 50 double sweeps, within the limit.
        BOOST_TEST(Aimed<dim>(acceleration, 1e-2, unreachable, 0.0).report.iterations == 50);
        // Before the tolerance is met, effort is no limit.
        const Aimed<dim> hard(acceleration, 1e-12, unreachable, 0.0);
        BOOST_TEST(hard.report.iterations > 50);
        BOOST_TEST((hard.report.status == talus::SolveStatus::converged));
        BOOST_TEST(hard.residual() <= 1e-12);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_aim_never_makes_a_converged_solve_a_missed_one, D, dimensions) {
    constexpr int dim = D::value;
    constexpr double none = std::numeric_limits<double>::infinity();
    int converged = 0, better_before = 0;  // than at the last look
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson})
        for (int limit = 0; limit < 150; ++limit) {
            const Aimed<dim> plain(acceleration, 1e-4, none, 1e6, limit);
            const Aimed<dim> aimed(acceleration, 1e-4, 0.0, 1e6, limit);
            if (plain.report.status != talus::SolveStatus::converged) continue;
            ++converged;
            BOOST_TEST((aimed.report.status == talus::SolveStatus::converged), "limit " << limit);
            BOOST_TEST(aimed.report.residual <= plain.report.residual);
            for (const auto& sample : aimed.report.history)
                better_before +=
                    sample.residual > aimed.report.residual && sample.iteration == limit;
            BOOST_TEST(aimed.residual() == aimed.report.residual);
        }
    BOOST_TEST(converged > 10);
    BOOST_TEST(better_before > 0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(without_an_aim_effort_changes_no_bit, D, dimensions) {
    constexpr int dim = D::value;
    constexpr double none = std::numeric_limits<double>::infinity();
    for (const auto acceleration : {Acceleration::nesterov, Acceleration::anderson}) {
        const Aimed<dim> one(acceleration, 1e-10, none, 0.0), other(acceleration, 1e-10, none, 1e9);
        BOOST_TEST((one.r == other.r));
        BOOST_TEST(one.report.history.size() == other.report.history.size());
    }
}

// A contact that answers with no number after so many visits, long after the tolerance was met.
struct BreaksLater {
    talus::Coulomb<2> law;
    std::shared_ptr<int> visits = std::make_shared<int>(0);

    talus::Vector<2> solve(const talus::LocalProblem<2>& p, const talus::Vector<2>& r) const {
        constexpr int most = 30;
        if (++*visits > most)
            return talus::Vector<2>::Constant(std::numeric_limits<double>::quiet_NaN());
        return law.solve(p, r);
    }
    talus::Vector<2> natural_map(const talus::Vector<2>& u, const talus::Vector<2>& r,
                                 double rho) const {
        return law.natural_map(u, r, rho);
    }
};

BOOST_AUTO_TEST_CASE(what_met_the_tolerance_survives_a_law_that_breaks_later) {
    using talus::SolveStatus;
    for (const bool met : {true, false}) {
        auto p = stack_of_particles<2>(std::vector<double>(20, 1.0), BreaksLater{{.mu = 0.5}});
        for (auto& law : p.laws) law.visits = std::make_shared<int>(0);
        p.free_velocity[0][0] = -1.0;
        std::vector<talus::Vector<2>> r(p.contact_count(), talus::Vector<2>::Zero());
        talus::AcceleratedGaussSeidel<2, BreaksLater> solver(
            {.tolerance = met ? 0.5 : 1e-13, .aim = 1e-14});
        const auto& report = solver.solve(p, r);
        BOOST_TEST((report.status == (met ? SolveStatus::converged : SolveStatus::not_finite)));
        BOOST_TEST((talus::residual<2, BreaksLater>(p, r).relative == report.residual));
    }
}

BOOST_AUTO_TEST_CASE(an_aim_or_effort_out_of_range_is_refused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [aim, effort] : {std::pair{nan, 1.0}, {-1.0, 1.0}, {1.0, nan}, {1.0, -1.0}}) {
        BOOST_CHECK_THROW(Aimed<2>(Acceleration::nesterov, 1e-4, aim, effort), talus::input_error);
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
