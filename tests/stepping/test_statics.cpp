// SPDX-License-Identifier: BSL-1.0
// Validation cases D03 and D04: pyramids of round bodies, equilibrium found in one step.
#include <talus/stepping/equilibrium.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_statics)

using namespace experiment;

constexpr talus::MaterialIndex floor_material = 0, grain_material = 1;

/// n touching balls of unit weight on the floor in a ring (two in the plane), one more on top of
/// them.
template <int Dim>
talus::System<Dim> pyramid(int n, double mu_grain, double mu_floor) {
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(2);
    laws.set(grain_material, grain_material, law<Dim>(mu_grain));
    laws.set(grain_material, floor_material, law<Dim>(mu_floor));
    laws.set(floor_material, floor_material, law<Dim>(0.0));
    talus::System<Dim> system(laws);
    system.gravity = -g * up<Dim>();
    const double r = 0.5;
    system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0}, {}, floor_material);
    const double ring = r / std::sin(pi / n);  // of the centres
    const auto add = [&](const V<Dim>& centre) {
        system.add(talus::Ball<Dim>{r}, round_inertia<Dim>(1.0 / g, r), {centre, {}}, {},
                   grain_material);
    };
    for (int k = 0; k < n; ++k) {
        V<Dim> centre = r * up<Dim>();
        centre[0] = ring * std::cos(2 * pi * k / n);
        if constexpr (Dim == 3) centre[1] = ring * std::sin(2 * pi * k / n);
        add(centre);
    }
    add((r + std::sqrt(4 * r * r - ring * ring)) * up<Dim>());
    return system;
}

template <int Dim>
talus::EquilibriumReport<Dim, talus::DefaultLaw<Dim>> test_pyramid(int n, double mu_grain,
                                                                   double mu_floor, double h) {
    talus::GaussSeidel<Dim, talus::DefaultLaw<Dim>> solver;
    solver.params.tolerance = 1e-12;
    solver.params.max_sweeps = 1000000;
    return talus::equilibrium(pyramid<Dim>(n, mu_grain, mu_floor),
                              {.h = h, .contact_tolerance = touching}, solver);
}

template <int Dim>
void check_thresholds(int n, double mu_grain, double mu_floor) {
    const double enough = 1.0;
    for (double h : {1e-2, 1e-4}) {
        const auto verdict = [&](double grain, double floor) {
            const auto report = test_pyramid<Dim>(n, grain, floor, h);
            if (report.verdict == talus::Verdict::moving)
                BOOST_CHECK_GE(report.speed, 1e-4 * g * h);
            return report.verdict;
        };
        BOOST_TEST_CONTEXT("n = " << n << ", h = " << h) {
            BOOST_CHECK(verdict(1.01 * mu_grain, enough) == talus::Verdict::equilibrium);
            BOOST_CHECK(verdict(0.99 * mu_grain, enough) == talus::Verdict::moving);
            BOOST_CHECK(verdict(enough, 1.01 * mu_floor) == talus::Verdict::equilibrium);
            BOOST_CHECK(verdict(enough, 0.99 * mu_floor) == talus::Verdict::moving);
        }
    }
}

BOOST_AUTO_TEST_CASE(three_discs_stand_by_two_thresholds) {
    check_thresholds<2>(2, 2 - std::sqrt(3.0), (2 - std::sqrt(3.0)) / 3);
}

BOOST_AUTO_TEST_CASE(four_and_five_balls_stand_by_two_thresholds) {
    const double three = std::sqrt(3.0) - std::sqrt(2.0), four = std::sqrt(2.0) - 1;
    check_thresholds<3>(3, three, three / 4);
    check_thresholds<3>(4, four, four / 5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_top_ball_weighs_equally_on_the_others, D, dimensions) {
    constexpr int Dim = D::value;
    const int n = Dim;  // two discs, three balls
    const double enough = 1.0;
    const auto report = test_pyramid<Dim>(n, enough, enough, 1e-3);
    BOOST_REQUIRE(report.verdict == talus::Verdict::equilibrium);
    double on_floor = 0.0, on_top = 0.0;
    const auto top = static_cast<talus::BodyIndex>(n + 1);
    for (std::size_t c = 0; c < report.data.contact_count(); ++c) {
        const auto& key = report.data.contacts.key[c];
        const V<Dim> force =
            report.data.problem.jacobian.frame[c].transpose() * report.mean_reaction(c);
        if (key.a == 0) on_floor += std::abs(force[Dim - 1]);
        if (key.b == top) {
            on_top += std::abs(force[Dim - 1]);
            BOOST_CHECK_CLOSE(std::abs(force[Dim - 1]), 1.0 / n, 1e-7);
        }
    }
    BOOST_CHECK_CLOSE(on_floor, n + 1.0, 1e-8);
    BOOST_CHECK_CLOSE(on_top, 1.0, 1e-8);
}

BOOST_AUTO_TEST_CASE(an_unfinished_solve_gives_no_verdict) {
    talus::GaussSeidel<2, talus::DefaultLaw<2>> solver;
    solver.params.tolerance = 1e-15;
    solver.params.max_sweeps = 2;
    const auto report = talus::equilibrium(pyramid<2>(2, 1.0, 1.0),
                                           {.h = 1e-2, .contact_tolerance = touching}, solver);
    BOOST_CHECK(report.verdict == talus::Verdict::undecided);
}

BOOST_AUTO_TEST_SUITE_END()
