// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/oracle/enumeration.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <cmath>
#include <numbers>
#include <string_view>

#include "common/coulomb_enumeration.hpp"
#include "common/dimensions.hpp"
#include "common/effort.hpp"
#include "common/gallery_tester.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(enumeration)

template <int Dim>
using Law = talus::Coulomb<Dim>;
template <int Dim>
using Oracle = talus::Enumeration<Dim, Law<Dim>>;
template <int Dim>
using Impulses = std::vector<talus::Vector<Dim>>;
using Status = talus::ContactStatus;

constexpr int most = 100000;  // combinations

template <int Dim>
auto with_tolerance() {
    return [](double tolerance) {
        return Oracle<Dim>({.max_iterations = most, .tolerance = tolerance});
    };
}

template <int Dim>
std::vector<GalleryProblem<Dim>> tiny_problems(std::size_t contacts) {
    std::vector<GalleryProblem<Dim>> tiny;
    for (const auto& entry : gallery_problems<Dim>(200, 3))
        if (entry.problem.contact_count() <= contacts) tiny.push_back(entry);
    return tiny;
}

template <int Dim>
double residual(const talus::ContactProblem<Dim, Law<Dim>>& p, const Impulses<Dim>& r) {
    return talus::residual(p, std::span<const talus::Vector<Dim>>(r)).relative;
}

/// One contact with any block W, as a rod's end has it: in space the rod moves in one plane.
template <int Dim>
talus::DelassusSparse<Dim> one_block(double nn, double nt, double tt) {
    talus::DelassusBlock<Dim> block{0, 0};
    block.value = tt * talus::Matrix<Dim>::Identity();
    block.value(0, 0) = nn;
    block.value(0, 1) = block.value(1, 0) = nt;
    return {1, {block}};
}

template <int Dim>
talus::Vector<Dim> velocity(double normal, double along) {
    talus::Vector<Dim> u = normal * talus::Vector<Dim>::Unit(0);
    u[1] = along;
    return u;
}

template <int Dim>
int count(const Oracle<Dim>& oracle, Status status) {
    int n = 0;
    for (const auto& s : oracle.solutions()) n += s.status[0] == status;
    return n;
}

BOOST_AUTO_TEST_CASE(is_robust_on_tiny_problems_of_the_gallery_in_the_plane) {
    auto promises = SolverPromises::robust();
    promises.stiff = 1e-6;
    const int rounds = repetitions(6, 2);
    const auto problems = tiny_problems<2>(rounds);
    BOOST_TEST(problems.size() > 9u * static_cast<unsigned>(rounds));
    test_on_problems<2>(of_bodies<2>(with_tolerance<2>(), promises, most), problems);
    test_on_problems<2>(of_blocks<2>(with_tolerance<2>(), promises, most), problems);
}

BOOST_AUTO_TEST_CASE(is_true_on_tiny_problems_of_the_gallery_in_space) {
    test_on_problems<3>(of_bodies<3>(with_tolerance<3>(), {.well_posed = 1e-10}, most),
                        tiny_problems<3>(3));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(agrees_with_sweeps_where_the_solution_is_unique, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(161);
    for (int k = 0; k < 60; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        const auto p = RandomProblem<dim, Law<dim>>{.bodies = 6, .contacts = 3, .arm = 0.1}.make(
            random, Law<dim>{0.1 * (k % 5)});
        Impulses<dim> sweeps(3, talus::Vector<dim>::Zero()), automatic = sweeps;
        talus::GaussSeidel<dim, Law<dim>> gauss_seidel({.max_sweeps = 100000, .tolerance = 1e-13});
        talus::Automatic<dim, Law<dim>> any({.tolerance = 1e-12});
        const bool solved = gauss_seidel.solve(p, sweeps).status == talus::SolveStatus::converged &&
                            any.solve(p, automatic).status == talus::SolveStatus::converged;
        BOOST_REQUIRE(solved);
        Oracle<dim> oracle;
        const auto& solutions = oracle.enumerate(p);
        BOOST_REQUIRE(solutions.size() == 1u);
        BOOST_TEST((distance<dim>(solutions[0].impulses, sweeps)) < 1e-9);
        BOOST_TEST((distance<dim>(solutions[0].impulses, automatic)) < 1e-8);
        BOOST_TEST(residual<dim>(p, solutions[0].impulses) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(all_solutions_of_one_contact, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(162);
    std::size_t several = 0;
    for (int k = 0; k < 400; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        const talus::Matrix<dim> g = random.normal<dim, dim>();
        const talus::Matrix<dim> w = g * g.transpose() + 0.05 * talus::Matrix<dim>::Identity();
        const Impulses<dim> b{random.normal<dim>()};
        const std::vector<Law<dim>> laws{{random.uniform(0.1, 3.0)}};
        Oracle<dim> oracle;
        const auto& solutions =
            oracle.enumerate(talus::DelassusSparse<dim>(1, {{0, 0, w}}), b, laws);
        BOOST_TEST(oracle.complete());
        const CoulombEnumeration<dim> plain({w, b[0]}, laws[0].mu);
        BOOST_TEST(solutions.size() == plain.solutions.size());
        // Positive definite: there is always one.
        BOOST_TEST(!solutions.empty());
        for (const auto& s : solutions) {
            const double size = 1.0 + s.impulses[0].norm();
            BOOST_TEST(plain.distance_to(s.impulses[0]) < 1e-7 * size);
        }
        several += solutions.size() > 1;
    }
    BOOST_TEST(several > 5u);
}

// W_nn - mu W_nt < 0: sliding forwards, an impulse presses the rod down instead of lifting it.
// Where the end rises freely, it may open, slide or stick.
BOOST_AUTO_TEST_CASE_TEMPLATE(painleve_rod_has_several_solutions, D, dimensions) {
    constexpr int dim = D::value;
    const auto w = one_block<dim>(1.0, 1.5, 3.0);
    const std::vector<Law<dim>> laws{{2.0}};
    const Impulses<dim> rising{velocity<dim>(0.2, 2.0)};
    Oracle<dim> oracle;
    const auto& solutions = oracle.enumerate(w, rising, laws);
    BOOST_TEST(oracle.complete());
    // By hand: sliding forwards, r = p (1, -2), u_n = 0.2 - 2 p = 0, u_t = 2 - 4.5 p = 1.55.
    BOOST_TEST(count<dim>(oracle, Status::open) == 1);
    BOOST_TEST(count<dim>(oracle, Status::sliding) == 1);
    BOOST_REQUIRE(solutions.size() >= 2u);
    for (const auto& s : solutions)
        if (s.status[0] == Status::sliding)
            BOOST_TEST((s.impulses[0] - velocity<dim>(0.1, -0.2)).norm() < 1e-12);
    // By hand: stuck needs W r = -b, r = (3.2, -2.2667) with |r_t| <= 2 r_n.
    BOOST_TEST(count<dim>(oracle, Status::stuck) == 1);

    // As a solver: the nearest to the warm start.
    for (const auto& s : solutions) {
        Impulses<dim> r{1.01 * s.impulses[0] + 1e-4 * talus::Vector<dim>::Ones()};
        Oracle<dim> solver({.tolerance = 1e-10});
        BOOST_TEST((solver.solve(w, rising, laws, r).status == talus::SolveStatus::converged));
        BOOST_TEST((r[0] - s.impulses[0]).norm() < 1e-10);
        BOOST_TEST(solver.solutions().size() == solutions.size());
    }
}

// W alone is not the mobility of bodies here (not positive definite): what such data do is certain.
BOOST_AUTO_TEST_CASE_TEMPLATE(no_solution_is_certified, D, dimensions) {
    constexpr int dim = D::value;
    // u_n = -1 - r_n +- 0.3 r_t falls with any r of the cone.
    const auto w = one_block<dim>(-1.0, 0.3, 3.0);
    const std::vector<Law<dim>> laws{{0.5}};
    const Impulses<dim> sinking{velocity<dim>(-1.0, 0.5)};
    Oracle<dim> oracle;
    BOOST_TEST(oracle.enumerate(w, sinking, laws).empty());
    BOOST_TEST(oracle.complete());
}

BOOST_AUTO_TEST_CASE(no_solution_of_two_contacts_is_reported) {
    // Between obstacles that approach each other, beside a particle that lands.
    auto p = twice(stack_of_particles<2>({1.0}, Law<2>{0.5}));
    for (auto& u : p.free_velocity) u = -talus::Vector<2>::Unit(0);
    p.inverse_mass.linear[0] = 0.0;
    Impulses<2> r(2, talus::Vector<2>::Zero());
    Oracle<2> oracle;
    BOOST_TEST((oracle.solve(p, r).status == talus::SolveStatus::no_solution));
    p.free_velocity[0] *= -1.0;
    BOOST_TEST((oracle.solve(p, r).status == talus::SolveStatus::converged));
    BOOST_TEST((r[1] - talus::Vector<2>::Unit(0)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impulses_that_are_not_unique_are_marked, D, dimensions) {
    constexpr int dim = D::value;
    // The same contact twice: only the sum of the two impulses is determined.
    auto p = stack_of_particles<dim>({1.0}, Law<dim>{0.5});
    p.free_velocity[0] = velocity<dim>(-1.0, 0.1);
    p.jacobian.resize(2);
    p.jacobian.a[1] = p.jacobian.a[0];
    p.jacobian.b[1] = p.jacobian.b[0];
    p.jacobian.frame[1] = p.jacobian.frame[0];
    p.jacobian.arm_a[1] = p.jacobian.arm_a[0];
    p.jacobian.arm_b[1] = p.jacobian.arm_b[0];
    p.free_velocity.push_back(p.free_velocity[0]);
    p.laws.push_back(p.laws[0]);
    Oracle<dim> oracle;
    bool halves = false;
    for (const auto& s : oracle.enumerate(p)) {
        BOOST_TEST(residual<dim>(p, s.impulses) < 1e-10);
        const talus::Vector<dim> sum = s.impulses[0] + s.impulses[1];
        BOOST_TEST((sum - velocity<dim>(1.0, -0.1)).norm() < 1e-10);
        if (s.status[0] == Status::stuck && s.status[1] == Status::stuck) {
            halves = true;
            BOOST_TEST(!s.isolated);
            BOOST_TEST((s.impulses[0] - s.impulses[1]).norm() < 1e-10);
        }
    }
    BOOST_TEST(halves);
}

BOOST_AUTO_TEST_CASE(trigonometric_roots_are_found) {
    RandomBlocks random(163);
    const auto values = [](auto f) {
        std::array<double, 5> v;
        for (int k = 0; k < 5; ++k)
            v[static_cast<std::size_t>(k)] = f(2.0 * std::numbers::pi * k / 5.0);
        return v;
    };
    for (int k = 0; k < 200; ++k) {
        // A product with the roots a, a + pi shifted, b, b + pi shifted.
        const double a = random.uniform(-3.0, 3.0), b = random.uniform(-3.0, 3.0);
        const auto f = [&](double x) { return (std::sin(x - a) + 0.3) * (std::cos(x - b) - 0.2); };
        const auto roots = talus::trigonometric_roots(values(f), 0.0);
        BOOST_REQUIRE(roots.has_value());
        BOOST_TEST(roots->size() == 4u);
        for (const double x : *roots) BOOST_TEST(std::abs(f(x)) < 1e-6);
    }
    const auto none =
        talus::trigonometric_roots(values([](double x) { return 3.0 + std::sin(2.0 * x); }), 0.0);
    BOOST_REQUIRE(none.has_value());
    BOOST_TEST(none->empty());
    const auto two =
        talus::trigonometric_roots(values([](double x) { return std::cos(x) - 0.5; }), 0.0);
    BOOST_REQUIRE(two.has_value());
    BOOST_TEST(two->size() == 2u);
    BOOST_TEST(!talus::trigonometric_roots({}, 0.0).has_value());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(input_out_of_range_is_refused, D, dimensions) {
    constexpr int dim = D::value;
    const auto p = stack_of_particles<dim>(std::vector<double>(Oracle<dim>::max_contacts + 1, 1.0),
                                           Law<dim>{0.5});
    Oracle<dim> oracle;
    const std::string limit = std::to_string(Oracle<dim>::max_contacts);
    BOOST_CHECK_EXCEPTION(oracle.enumerate(p), talus::input_error, [&](const auto& error) {
        const std::string text = error.what();
        return text.find("number of contacts") != std::string::npos &&
               text.find("[0, " + limit + "]") != std::string::npos;
    });
    auto q = stack_of_particles<dim>({1.0}, Law<dim>{0.5});
    BOOST_CHECK_THROW(Oracle<dim>({.starts = 0}).enumerate(q), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_has_one_solution, D, dimensions) {
    Oracle<D::value> oracle;
    BOOST_TEST(oracle.enumerate(stack_of_particles<D::value>({}, Law<D::value>{})).size() == 1u);
    BOOST_TEST(oracle.complete());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_limit_is_reported, D, dimensions) {
    constexpr int dim = D::value;
    auto p = stack_of_particles<dim>({1.0, 1.0}, Law<dim>{0.5});
    p.free_velocity[0] = -talus::Vector<dim>::Unit(0);
    Impulses<dim> r(2, talus::Vector<dim>::Zero());
    Oracle<dim> oracle({.max_iterations = 2});
    BOOST_TEST((oracle.solve(p, r).status == talus::SolveStatus::iteration_limit));
    BOOST_TEST(oracle.report().iterations == 2);
    BOOST_TEST(!oracle.complete());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_contact_without_a_cone_is_refused_by_name, D, dimensions) {
    constexpr int dim = D::value;
    using Any = talus::AnyLaw<dim, talus::Coulomb<dim>, talus::Bilateral<dim>>;
    auto p = stack_of_particles<dim>({1.0, 1.0}, Any{talus::Coulomb<dim>{0.3}});
    p.free_velocity[0] = -talus::Vector<dim>::Unit(0);
    p.laws[1].law = talus::Bilateral<dim>{};
    const auto names_the_contact = [](const talus::input_error& error) {
        const std::string_view text = error.what();
        return text.find("contact 1 ") != text.npos && text.find("Automatic") != text.npos;
    };
    talus::Enumeration<dim, Any> oracle;
    std::vector<talus::Vector<dim>> r(2, talus::Vector<dim>::Constant(0.5));
    const auto before = r;
    BOOST_CHECK_EXCEPTION(oracle.solve(p, r), talus::input_error, names_the_contact);
    BOOST_CHECK_EXCEPTION(oracle.enumerate(p), talus::input_error, names_the_contact);
    BOOST_TEST((r == before));
    p.laws[1].law = talus::Coulomb<dim>{0.3};
    BOOST_TEST((oracle.solve(p, r).status == talus::SolveStatus::converged));
}

BOOST_AUTO_TEST_SUITE_END()
