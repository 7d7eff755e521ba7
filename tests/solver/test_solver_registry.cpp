// SPDX-License-Identifier: BSL-1.0
#include <talus/law/bilateral.hpp>
#include <talus/solver/any_solver.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"
#include "common/random_problem.hpp"
#include "registry.hpp"

BOOST_AUTO_TEST_SUITE(solver_registry)

template <int Dim>
using Law = talus::Coulomb<Dim>;
template <int Dim>
using Impulses = std::vector<talus::Vector<Dim>>;

static_assert(talus::ContactSolver<talus::AnySolver<2, Law<2>>, 2, Law<2>>);
static_assert(talus::FormsSolver<talus::AnySolver<3, Law<3>>, 3, Law<3>>);
/// Takes one form of problem only.
struct OfBodies {
    const talus::SolveReport& solve(const talus::ContactProblem<2, Law<2>>&,
                                    std::span<talus::Vector<2>>) {
        return report_;
    }
    const talus::SolveReport& report() const { return report_; }
    talus::SolveReport report_;
};
static_assert(!std::constructible_from<talus::AnySolver<2, Law<2>>, OfBodies>);

/// Two masses on a floor: (2, -0.7) and (1, -0.4) along the first two axes.
template <int Dim, class L>
talus::ContactProblem<Dim, L> two_masses(L law) {
    auto p = stack_of_particles<Dim>({1.0, 1.0}, law);
    p.free_velocity[0].template head<2>() << -1.0, 0.3;
    p.free_velocity[1].template head<2>() << 0.0, 0.1;
    return p;
}

template <int Dim, class L>
void solves_in_all_forms(talus::AnySolver<Dim, L> solver, const talus::ContactProblem<Dim, L>& p) {
    const auto check = [&](auto&& solve) {
        Impulses<Dim> r(2, talus::Vector<Dim>::Zero());
        const talus::SolveReport& report = solve(std::span(r));
        BOOST_TEST((report.status == talus::SolveStatus::converged));
        BOOST_TEST(&report == &solver.report());
        BOOST_TEST((r[0].template head<2>() - Eigen::Vector2d(2.0, -0.7)).norm() < 1e-9);
        BOOST_TEST((r[1].template head<2>() - Eigen::Vector2d(1.0, -0.4)).norm() < 1e-9);
    };
    using R = std::span<talus::Vector<Dim>>;
    check([&](R r) -> const auto& { return solver.solve(p, r); });
    talus::DelassusSparse<Dim> w(p.jacobian, p.inverse_mass);
    check([&](R r) -> const auto& { return solver.solve(w, p.free_velocity, p.laws, r); });
    auto matrices = with_masses<Dim>(p.jacobian, p.inverse_mass);
    check([&](R r) -> const auto& { return solver.solve(matrices, p.free_velocity, p.laws, r); });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_name_solves_a_small_problem, D, dimensions) {
    constexpr int dim = D::value;
    const auto names = talus::solver_names<dim, Law<dim>>();
    BOOST_TEST(names.size() == 10u);
    for (const talus::SolverName& solver : names) {
        BOOST_TEST_INFO_SCOPE(solver.name);
        BOOST_TEST(!solver.description.empty());
        BOOST_TEST(std::count_if(names.begin(), names.end(), [&](const auto& other) {
                       return other.name == solver.name;
                   }) == 1);
        solves_in_all_forms(talus::make_solver<dim, Law<dim>>(
                                solver.name, {.tolerance = 1e-11, .max_iterations = 1000}),
                            two_masses<dim>(Law<dim>{.mu = 0.5}));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_law_without_a_cone_has_sweeps, D, dimensions) {
    constexpr int dim = D::value;
    using Pin = talus::Bilateral<dim>;
    const auto names = talus::solver_names<dim, Pin>();
    BOOST_TEST(names.size() == 4u);
    for (const auto& [name, description] : names)
        solves_in_all_forms(talus::make_solver<dim, Pin>(name, {.tolerance = 1e-11}),
                            two_masses<dim>(Pin{}));
    BOOST_CHECK_THROW((talus::make_solver<dim, Pin>("interior_point")), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(settings_reach_the_solver, D, dimensions) {
    constexpr int dim = D::value;
    const auto p = two_masses<dim>(Law<dim>{.mu = 0.5});
    Impulses<dim> r(2, talus::Vector<dim>::Zero());
    auto solver = talus::make_solver<dim, Law<dim>>("gauss_seidel", {.max_iterations = 3});
    BOOST_TEST(solver.solve(p, r).iterations == 3);
    auto loose = talus::make_solver<dim, Law<dim>>("gauss_seidel", {.tolerance = 0.5});
    BOOST_TEST(loose.solve(p, r).iterations == 0);
    for (const auto& [name, description] : talus::solver_names<dim, Law<dim>>()) {
        BOOST_TEST_INFO_SCOPE(name);
        r.assign(2, talus::Vector<dim>::Zero());
        // Of Automatic each of two limits, and what it looks for beyond is in neither.
        const int limit = name == "automatic" ? 4 : 2;
        auto limited =
            talus::make_solver<dim, Law<dim>>(name, {.tolerance = 0.0, .max_iterations = 2});
        BOOST_TEST(limited.solve(p, r).iterations <= limit);
    }
    BOOST_CHECK_THROW((talus::make_solver<dim, Law<dim>>("automatic", {.tolerance = -1.0})),
                      talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(copies_are_independent, D, dimensions) {
    constexpr int dim = D::value;
    const auto p = two_masses<dim>(Law<dim>{.mu = 0.5});
    Impulses<dim> r(2, talus::Vector<dim>::Zero());
    auto solver = talus::make_solver<dim, Law<dim>>("gauss_seidel", {.max_iterations = 3});
    const auto before = solver;
    solver.solve(p, r);
    BOOST_TEST(before.report().iterations == 0);
    BOOST_TEST(solver.report().iterations == 3);
    solver = before;
    BOOST_TEST(solver.report().iterations == 0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_unknown_name_lists_those_there_are, D, dimensions) {
    constexpr int dim = D::value;
    const auto lists_them = [](const talus::input_error& error) {
        const std::string text = error.what();
        return text.find("'simplex'") != text.npos && text.find("gauss_seidel, ") != text.npos &&
               text.find("enumeration") != text.npos;
    };
    BOOST_CHECK_EXCEPTION((talus::make_solver<dim, Law<dim>>("simplex")), talus::input_error,
                          lists_them);
}

BOOST_AUTO_TEST_SUITE_END()
