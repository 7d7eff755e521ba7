// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/signorini.hpp>
#include <talus/law/weighted_mean.hpp>

#include "common/dimensions.hpp"
#include "common/law_tester.hpp"

BOOST_AUTO_TEST_SUITE(laws)

BOOST_AUTO_TEST_CASE_TEMPLATE(signorini_is_a_law, D, dimensions) {
    test_law<D::value>(
        talus::Signorini<D::value>{}, {},
        [](const talus::Vector<D::value>& r) {
            return r[0] >= 0.0 && r.template tail<D::value - 1>().norm() == 0.0;
        },
        1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bilateral_is_a_law, D, dimensions) {
    test_law<D::value>(
        talus::Bilateral<D::value>{}, {.unilateral = false},
        [](const talus::Vector<D::value>&) { return true; }, 2);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(coulomb_is_a_law, D, dimensions) {
    for (const double mu : {0.0, 1e-9, 0.1, 0.5, 1.0, 3.0, 1e3}) {
        BOOST_TEST_CONTEXT("mu = " << mu)
        test_law<D::value>(
            talus::Coulomb<D::value>{mu},
            {.friction = mu, .unique_coupling = mu > 0.0 ? 0.9 / mu : 1e9},
            [mu](const talus::Vector<D::value>& r) {
                return r[0] >= 0.0 &&
                       r.template tail<D::value - 1>().norm() <= mu * r[0] * (1.0 + 1e-15);
            },
            3);
    }
}

/// Whether a weighted mean may adapt a law: it would ignore a restitution within it.
template <int Dim, class Law>
constexpr bool has_mean = requires {
    typename talus::WeightedMean<Dim, Law>;
};
template <int Dim>
constexpr bool means_are_told_apart() {
    using Coulomb = talus::Coulomb<Dim>;
    using Pin = talus::Bilateral<Dim>;
    using Mean = talus::WeightedMean<Dim, Coulomb>;
    static_assert(has_mean<Dim, Coulomb> && has_mean<Dim, talus::Cohesive<Dim, Coulomb>>);
    static_assert(has_mean<Dim, talus::AnyLaw<Dim, Coulomb, Pin>>);
    static_assert(!talus::RestitutionLaw<talus::AnyLaw<Dim, Coulomb, Pin>, Dim>);
    static_assert(!has_mean<Dim, Mean> && !has_mean<Dim, talus::AnyLaw<Dim, Pin, Mean>>);
    static_assert(!has_mean<Dim, talus::Cohesive<Dim, Mean>>);
    using Inner = talus::AnyLaw<Dim, Coulomb, Pin>;
    static_assert(talus::RestitutionLaw<talus::WeightedMean<Dim, Inner>, Dim>);
    static_assert(talus::RestitutionLaw<talus::Cohesive<Dim, Mean>, Dim>);
    return true;
}
static_assert(means_are_told_apart<2>() && means_are_told_apart<3>());

BOOST_AUTO_TEST_CASE_TEMPLATE(adaptors_are_laws, D, dimensions) {
    constexpr int dim = D::value;
    using Mean = talus::WeightedMean<dim, talus::Coulomb<dim>>;
    using Any = talus::AnyLaw<dim, talus::Bilateral<dim>, Mean, talus::Signorini<dim>>;
    static_assert(talus::RestitutionLaw<Mean, dim> && talus::RestitutionLaw<Any, dim>);
    const auto in_cone = [](const talus::Vector<dim>& r) {
        return talus::FrictionCone<dim>{0.4 * (1.0 + 1e-15)}.contains(r);
    };
    const Mean mean{{.mu = 0.4}, 0.5, 0.2};
    test_law<dim>(mean, {.friction = 0.4, .unique_coupling = 2.0}, in_cone, 4);
    test_law<dim>(Any{mean}, {.friction = 0.4, .unique_coupling = 2.0}, in_cone, 5);
    test_law<dim>(
        Any{talus::Bilateral<dim>{}}, {.unilateral = false},
        [](const talus::Vector<dim>&) { return true; }, 6);
}

// Validation case B02: theta = 1, 0.8, 2/3, 5/9, 1/2 gives e = 0, 0.25, 0.5, 0.8, 1.
BOOST_AUTO_TEST_CASE_TEMPLATE(weighted_mean_returns_the_normal_velocity_times_e, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    for (const double e : {0.0, 0.25, 0.5, 0.8, 1.0}) {
        const talus::WeightedMean<dim, talus::Coulomb<dim>> law{{.mu = 10.0}, e, 0.5 * e};
        Vec u_begin = Vec::Unit(1) * 0.7;
        u_begin[0] = -1.3;
        const talus::LocalProblem<dim> shifted{talus::Matrix<dim>::Identity(),
                                               u_begin + law.restitution_shift(u_begin)};
        const Vec u_end = u_begin + law.solve(shifted, Vec::Zero());
        BOOST_TEST(u_end[0] == 1.3 * e, boost::test_tools::tolerance(1e-15));
        BOOST_TEST(u_end[1] == -0.35 * e, boost::test_tools::tolerance(1e-14));
    }
}

// Validation case B17: unequal restitutions create energy, by exactly this much.
BOOST_AUTO_TEST_CASE(weighted_mean_has_the_kane_levinson_gain) {
    const talus::WeightedMean<2, talus::Coulomb<2>> law{{.mu = 1.0}, 1.0, 0.0};
    const talus::Vector<2> u_begin(-1.0, 0.6);
    talus::LocalProblem<2> p;
    p.W << 2.5, -1.5, -1.5, 2.5;
    p.b = u_begin + law.restitution_shift(u_begin);
    const talus::Vector<2> r = law.solve(p, p.b);
    const talus::Vector<2> u_end = u_begin + p.W * r;
    BOOST_TEST((r - talus::Vector<2>(1.025, 0.375)).norm() < 1e-14);
    BOOST_TEST(r.dot(u_begin + u_end) / 2.0 == 0.1125, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(problem_without_an_answer_shows_in_the_natural_map, D, dimensions) {
    constexpr int dim = D::value;
    const talus::LocalProblem<dim> fixed{talus::Matrix<dim>::Zero(), -talus::Vector<dim>::Ones()};
    // The correction mu |u_t| takes the share of u_n in the error down, to the order of 1 / mu.
    const auto check = [&](const auto& law, double mu = 0.0) {
        const talus::Vector<dim> r = law.solve(fixed, talus::Vector<dim>::Zero());
        BOOST_TEST(r.allFinite());
        BOOST_TEST(law_error<dim>(law, fixed, r) > 0.2 / (1.0 + mu));
    };
    check(talus::Signorini<dim>{});
    check(talus::Bilateral<dim>{});
    for (const double mu : {0.0, 0.5, 100.0}) check(talus::Coulomb<dim>{mu}, mu);
}

// W of rank one with mu |W_tn| > W_nn: u_n = 0 leaves u_t = 1 whatever r, which slips along -t
// only if r_t < 0, while W_nn r_n + W_nt r_t = 1 and |r_t| = mu r_n ask for r_t > 0.
BOOST_AUTO_TEST_CASE_TEMPLATE(singular_painleve_block_without_answer_shows_it, D, dimensions) {
    constexpr int dim = D::value;
    talus::LocalProblem<dim> p{talus::Matrix<dim>::Zero(), -talus::Vector<dim>::Unit(0)};
    p.W.template topLeftCorner<2, 2>().setOnes();
    const talus::Coulomb<dim> law{2.0};
    const talus::Vector<dim> r = law.solve(p, p.b);
    BOOST_TEST(r.allFinite());
    BOOST_TEST(law_error<dim>(law, p, r) > 0.01);
}

BOOST_AUTO_TEST_SUITE_END()
