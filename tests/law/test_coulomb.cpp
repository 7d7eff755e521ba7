// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>

#include <cmath>
#include <numbers>

#include "common/coulomb_enumeration.hpp"
#include "common/dimensions.hpp"
#include "common/law_tester.hpp"

BOOST_AUTO_TEST_SUITE(coulomb)

/// Answers are compared to the enumeration's: rounding times condition number (10) times 1 / (1 -
/// mu |W_tn| / W_nn) (at most 50).
constexpr double same_answer = 1e-12;

double degrees(double x) { return x * std::numbers::pi / 180.0; }

/// Tip of a rod of unit mass and length at angle `th` to the floor, the sliding direction first.
template <int Dim>
talus::Matrix<Dim> rod_tip(double th) {
    talus::Matrix<Dim> w = talus::Matrix<Dim>::Identity();
    const double c = std::cos(th), s = std::sin(th);
    w.template topLeftCorner<2, 2>() << 1 + 3 * c * c, -3 * s * c, -3 * s * c, 1 + 3 * s * s;
    return w;
}
double critical_friction(double th) { return (std::tan(th) + 4.0 / std::tan(th)) / 3.0; }

BOOST_AUTO_TEST_CASE_TEMPLATE(unique_answer_equals_the_enumerated_one, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(21);
    int slips = 0, sticks = 0;
    for (int k = 0; k < 500; ++k) {
        const talus::LocalProblem<dim> p{random.well_conditioned<dim>(), random.normal<dim>()};
        const double coupling = p.W.template bottomLeftCorner<dim - 1, 1>().norm();
        const talus::Coulomb<dim> law{
            random.uniform(0.0, std::min(2.0, 0.95 * p.W(0, 0) / coupling))};
        const CoulombEnumeration<dim> all(p, law.mu);
        BOOST_REQUIRE(all.solutions.size() == 1U);
        const talus::Vector<dim> r = law.solve(p, p.b);
        BOOST_TEST((r - all.solutions[0]).norm() <= same_answer * (1.0 + r.norm()));
        slips += p.velocity(r).norm() > 1e-6 && r.norm() > 0.0;
        sticks += p.velocity(r).norm() <= 1e-6;
    }
    BOOST_TEST(slips > 50);
    BOOST_TEST(sticks > 10);
}

// Beyond the range of uniqueness the answer is one of the enumerated ones.
BOOST_AUTO_TEST_CASE_TEMPLATE(answer_in_the_painleve_range_is_one_of_the_enumerated, D,
                              dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(22);
    int several = 0;
    for (int k = 0; k < 500; ++k) {
        const talus::LocalProblem<dim> p{random.well_conditioned<dim>(), random.normal<dim>()};
        const double coupling = p.W.template bottomLeftCorner<dim - 1, 1>().norm();
        const talus::Coulomb<dim> law{random.uniform(1.2, 3.0) * p.W(0, 0) / coupling};
        const CoulombEnumeration<dim> all(p, law.mu);
        several += all.solutions.size() > 1;
        const talus::Vector<dim> r = law.solve(p, p.b);
        // Slips close to the pole of r_n are ill-conditioned in r but not in the residual.
        if (all.distance_to(r) > 1e-8 * (1.0 + r.norm()))
            BOOST_TEST(law_error<dim>(law, p, r) <= 1e-13 * (1.0 + law.mu));
        BOOST_TEST(law_error<dim>(law, p, r) <= 1e-12 * (1.0 + law.mu));
    }
    BOOST_TEST(several > 0);
}

// Validation case C01: where the sign of W_nn - mu |W_nt| changes.
BOOST_AUTO_TEST_CASE(rod_has_the_known_critical_friction) {
    const double angle[] = {30.0, 45.0, 60.0, 63.43494882292201, 75.0};
    const double critical[] = {2.501851166, 1.666666667, 1.347150628, 4.0 / 3.0, 1.601282526};
    for (int k = 0; k < 5; ++k) {
        const talus::Matrix<2> w = rod_tip<2>(degrees(angle[k]));
        BOOST_TEST(w.determinant() == 4.0, boost::test_tools::tolerance(1e-14));
        BOOST_TEST(w(0, 0) / std::abs(w(0, 1)) == critical[k], boost::test_tools::tolerance(1e-9));
    }
}

// Validation case C02: no continuous solution; the step has exactly one, a stick of order one.
BOOST_AUTO_TEST_CASE_TEMPLATE(painleve_inconsistent_rod_sticks_by_an_impact, D, dimensions) {
    constexpr int dim = D::value;
    const double th = degrees(60.0);
    const talus::Coulomb<dim> law{2.0};
    for (const double h : {1e-2, 1e-3, 1e-4}) {
        talus::LocalProblem<dim> p{rod_tip<dim>(th), -talus::Vector<dim>::Unit(1)};
        p.b[0] = -9.81 * h;
        const CoulombEnumeration<dim> all(p, law.mu);
        BOOST_TEST(all.solutions.size() == 1U);
        const talus::Vector<dim> r = law.solve(p, p.b);
        BOOST_TEST(p.velocity(r).norm() < 1e-14);
        BOOST_TEST(std::abs(r[0] - 0.324759526) < 100.0 * h);
        BOOST_TEST(std::abs(r[1] - 0.4375) < 100.0 * h);
    }
}

// Validation case C03: open, slip and stick all obey the law; the selection rule says open.
BOOST_AUTO_TEST_CASE(painleve_indeterminate_rod_opens) {
    talus::LocalProblem<2> p{rod_tip<2>(degrees(60.0)), {25.26e-3, -1.0}};
    const CoulombEnumeration<2> all(p, 2.0);
    BOOST_TEST(all.solutions.size() == 3U);
    for (const auto& r : all.solutions)
        BOOST_TEST(law_error<2>(talus::Coulomb<2>{2.0}, p, r) < 1e-14);
    BOOST_TEST(talus::Coulomb<2>{2.0}.solve(p, all.solutions[1]).norm() == 0.0);
}

// Validation case C05: one solution for every b iff mu |W_tn| < W_nn; always at least one.
BOOST_AUTO_TEST_CASE(one_contact_is_unique_below_the_critical_friction) {
    RandomBlocks random(23);
    for (const double angle : {20.0, 45.0, 60.0, 75.0}) {
        const double th = degrees(angle);
        for (const double part : {0.98, 1.02}) {
            const talus::Coulomb<2> law{part * critical_friction(th)};
            int three = 0;
            for (int k = 0; k < 4000; ++k) {
                const talus::LocalProblem<2> p{rod_tip<2>(th), random.unit<2>()};
                const CoulombEnumeration<2> all(p, law.mu);
                const talus::Vector<2> r = law.solve(p, p.b);
                BOOST_REQUIRE(!all.solutions.empty());
                BOOST_TEST(all.distance_to(r) <= same_answer * (1.0 + r.norm()) * 50.0);
                if (part < 1.0) BOOST_TEST(all.solutions.size() == 1U);
                three += all.solutions.size() == 3U;
            }
            BOOST_TEST((three > 0) == (part > 1.0));
        }
    }
}

// Validation case A09 at the level of the law: the block slides straight on, at any azimuth and
// with the tangents turned at random, which a faceted cone does not do.
BOOST_AUTO_TEST_CASE(sliding_has_no_preferred_direction) {
    RandomBlocks random(24);
    const talus::Coulomb<3> law{0.3};
    for (int azimuth = 0; azimuth <= 90; ++azimuth) {
        const double phi = degrees(azimuth);
        const talus::Matrix<3> q = random.change_of_tangents<3>();
        talus::Matrix<3> w = talus::Matrix<3>::Identity();
        const talus::Vector<3> b(-9.81e-3, 2.0 * std::cos(phi), 2.0 * std::sin(phi));
        const talus::Vector<3> r = q.transpose() * law.solve({w, q * b}, b);
        BOOST_TEST(std::abs(r.tail<2>().norm() - 0.3 * 9.81e-3) < 1e-17);
        BOOST_TEST(std::abs(r[1] * std::sin(phi) - r[2] * std::cos(phi)) < 1e-17);
        BOOST_TEST(r.tail<2>().dot(b.tail<2>()) < 0.0);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(short_way_for_diagonal_blocks_equals_the_general_one, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(25);
    for (int k = 0; k < 2000; ++k) {
        talus::Matrix<dim> w = talus::Matrix<dim>::Identity() * random.log_uniform(1e-3, 1e3);
        w(0, 0) = random.log_uniform(1e-3, 1e3);
        const talus::CoulombBlock<dim> block(w);
        BOOST_REQUIRE(block.diagonal());
        const talus::Vector<dim> u = random.normal<dim>(), r = random.normal<dim>();
        const double mu = random.log_uniform(1e-2, 1e2);
        const talus::Vector<dim> general = block.general_solution(mu, u - w * r);
        // b = u - W r loses digits where the terms cancel: an error of W r in u, over W in r.
        const double scale = r.norm() + u.norm() / w.diagonal().minCoeff();
        const double spread = w.diagonal().maxCoeff() / w.diagonal().minCoeff();
        BOOST_TEST((block.improved(mu, u, r) - general).norm() <=
                   1e-14 * (1.0 + mu) * spread * scale);
    }
    talus::Matrix<dim> coupled = talus::Matrix<dim>::Identity();
    coupled(0, 1) = coupled(1, 0) = 1e-10;
    BOOST_TEST(!talus::CoulombBlock<dim>(coupled).diagonal());
}

BOOST_AUTO_TEST_SUITE_END()
