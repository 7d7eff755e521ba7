// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/signorini.hpp>
#include <talus/law/weighted_mean.hpp>

#include <cmath>

#include "common/dimensions.hpp"
#include "common/law_tester.hpp"

BOOST_AUTO_TEST_SUITE(cohesive)

/// r_n >= -c and |r_t| <= mu (r_n + c), to the rounding of r_n + c.
template <int Dim>
auto in_shifted_cone(double mu) {
    return [mu](const auto& law, const talus::Vector<Dim>& r) {
        const double c = law.cohesion, rounding = 1e-15 * (std::abs(r[0]) + c);
        return r[0] >= -c &&
               r.template tail<Dim - 1>().norm() <= mu * (r[0] + c + rounding) * (1.0 + 1e-15);
    };
}

constexpr double g = 9.81, m = 2.0;  // [m/s^2], [kg]

BOOST_AUTO_TEST_CASE_TEMPLATE(cohesive_coulomb_is_a_law, D, dimensions) {
    constexpr int dim = D::value;
    for (const double c : {0.0, 1e-3, 0.5, 20.0})
        for (const double mu : {0.0, 0.3, 1.0}) {
            BOOST_TEST_CONTEXT("c = " << c << ", mu = " << mu)
            test_law<dim>(talus::CohesiveCoulomb<dim>{{mu}, c},
                          {.friction = mu, .unique_coupling = mu > 0.0 ? 0.9 / mu : 1e9},
                          in_shifted_cone<dim>(mu), 31);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(cohesion_adapts_other_laws, D, dimensions) {
    constexpr int dim = D::value;
    using Mean = talus::WeightedMean<dim, talus::Coulomb<dim>>;
    test_law<dim>(talus::Cohesive<dim, talus::Signorini<dim>>{{}, 0.7}, {}, in_shifted_cone<dim>(0),
                  32);
    using Bouncing = talus::Cohesive<dim, Mean>;
    static_assert(talus::RestitutionLaw<Bouncing, dim>);
    const Bouncing law{{{.mu = 0.4}, 0.5, 0.2}, 0.7};
    test_law<dim>(law, {.friction = 0.4, .unique_coupling = 2.0}, in_shifted_cone<dim>(0.4), 33);
    const talus::Vector<dim> u = -talus::Vector<dim>::Ones();
    BOOST_TEST((law.restitution_shift(u) - law.law.restitution_shift(u)).norm() == 0.0);
    using Any = talus::AnyLaw<dim, talus::Bilateral<dim>, talus::CohesiveCoulomb<dim>>;
    static_assert(talus::PreparableLaw<Any, dim>);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(without_cohesion_it_is_the_law_itself, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(34);
    // Not a constant: Clang folds 1 + mu * mu of a constant with one rounding, and computes it with
    // two.
    const talus::Coulomb<dim> plain{random.uniform(0.1, 1.0)};
    const talus::CohesiveCoulomb<dim> law{plain, 0.0};
    for (int k = 0; k < 100; ++k) {
        const talus::LocalProblem<dim> p{random.well_conditioned<dim>(), random.normal<dim>()};
        const talus::Vector<dim> r = random.normal<dim>();
        BOOST_TEST((law.solve(p, r) - plain.solve(p, r)).norm() == 0.0);
        BOOST_TEST((law.natural_map(p.b, r, 0.7) - plain.natural_map(p.b, r, 0.7)).norm() == 0.0);
    }
}

// A ball under a ceiling, normal downwards: the weight m g h hangs on the contact. It holds up to
// c, and beyond falls with the surplus, g - c / (m h), for as long as the contact is there.
BOOST_AUTO_TEST_CASE_TEMPLATE(ball_hangs_by_its_cohesion, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    const talus::Matrix<dim> w = talus::Matrix<dim>::Identity() / m;
    for (const double h : {1e-2, 1e-3})
        for (const double part : {0.0, 0.5, 0.999, 1.001, 2.0}) {
            const double c = part * m * g * h;
            const talus::CohesiveCoulomb<dim> law{{0.3}, c};
            Vec u = Vec::Zero();
            for (int step = 1; step <= 20; ++step) {
                const talus::LocalProblem<dim> p{w, u + g * h * Vec::Unit(0)};
                const Vec r = law.solve(p, Vec::Zero());
                u = p.velocity(r);
                const double falling = std::max(0.0, g - c / (m * h)) * h * step;
                BOOST_TEST(std::abs(u[0] - falling) < 1e-15 * step);
                BOOST_TEST(std::abs(r[0] + std::min(c, m * g * h)) < 1e-15);
            }
        }
}

// A block on a level floor, pushed by F: it stays up to F = mu (m g + c / h), and beyond slides
// with the surplus over m.
BOOST_AUTO_TEST_CASE_TEMPLATE(cohesion_adds_to_the_force_that_a_block_resists, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    const double h = 1e-3, mu = 0.3, cohesion_force = 5.0;
    const talus::Matrix<dim> w = talus::Matrix<dim>::Identity() / m;
    const talus::CohesiveCoulomb<dim> law{{mu}, cohesion_force * h};
    const double threshold = mu * (m * g + cohesion_force);
    for (const double force : {0.5 * threshold, 0.999 * threshold, 1.001 * threshold, 20.0}) {
        Vec u = Vec::Zero();
        for (int step = 1; step <= 20; ++step) {
            Vec load = -g * h * Vec::Unit(0) + force * h / m * Vec::Unit(dim - 1);
            u = talus::LocalProblem<dim>{w, u + load}.velocity(law.solve({w, u + load}, u));
            const double sliding = std::max(0.0, force - threshold) / m * h * step;
            BOOST_TEST((u - sliding * Vec::Unit(dim - 1)).norm() < 1e-15 * step);
        }
    }
}

BOOST_AUTO_TEST_CASE(bad_cohesion_is_named) {
    const auto says = [](const char* text) {
        return [text](const talus::input_error& e) {
            return std::string(e.what()).find(text) != std::string::npos;
        };
    };
    using Law = talus::CohesiveCoulomb<3>;
    BOOST_CHECK_EXCEPTION((Law{{0.3}, -1.0}.require_valid("glue")), talus::input_error,
                          says("glue.cohesion is -1"));
    BOOST_CHECK_EXCEPTION((Law{{-0.3}, 1.0}.require_valid("glue")), talus::input_error,
                          says("glue.mu is -0.3"));
    Law{{0.3}, 1.0}.require_valid("glue");
}

BOOST_AUTO_TEST_SUITE_END()
