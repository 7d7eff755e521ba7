// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/linear/dense_solve.hpp>

#include <cmath>
#include <tuple>
#include <vector>

#include "common/law_tester.hpp"

BOOST_AUTO_TEST_SUITE(rolling_friction)

/// Rows of contacts with rolling friction: those of the plane and those of space.
template <int N>
struct Rows {
    static constexpr int value = N;
};
using rolling_rows = std::tuple<Rows<3>, Rows<5>>;

/// Answers of well-conditioned problems: rounding times condition number and the margin of
/// uniqueness.
constexpr double same_answer = 1e-11;

template <int N>
double tangent(const talus::Vector<N>& x) {
    return x.template segment<(N - 1) / 2>(1).norm();
}
template <int N>
double rolling(const talus::Vector<N>& x) {
    return x.template tail<(N - 1) / 2>().norm();
}
/// |W_qn| / W_nn, q all rows but the first.
template <int N>
double coupling(const talus::Matrix<N>& w) {
    return w.template bottomLeftCorner<N - 1, 1>().norm() / w(0, 0);
}

/// All impulses that obey the law of the plane: nine statuses, each a linear system.
std::vector<talus::Vector<3>> enumerated(const talus::RollingCoulomb<3>& law,
                                         const talus::LocalProblem<3>& p) {
    std::vector<talus::Vector<3>> found;
    if (p.b[0] >= 0.0) found.push_back(talus::Vector<3>::Zero());
    for (const int slide : {0, -1, 1})
        for (const int roll : {0, -1, 1}) {
            talus::Matrix<3> system = p.W;
            talus::Vector<3> right = -p.b;
            const auto saturate = [&](int row, int sign, double slope) {
                if (sign == 0) return;
                system.row(row) =
                    talus::Vector<3>::Unit(row) - sign * slope * talus::Vector<3>::Unit(0);
                right[row] = 0.0;
            };
            saturate(1, slide, law.mu);
            saturate(2, roll, law.mu_r);
            const talus::Vector<3> r(talus::solved_dense(system, right));
            const talus::Vector<3> u = p.velocity(r);
            const bool allowed = r[0] > 0.0 && std::abs(r[1]) <= law.mu * r[0] * (1 + 1e-14) &&
                                 std::abs(r[2]) <= law.mu_r * r[0] * (1 + 1e-14);
            if (allowed && slide * u[1] <= 0.0 && roll * u[2] <= 0.0) found.push_back(r);
        }
    return found;
}

// y in K, x - y in the polar cone, the two orthogonal.
BOOST_AUTO_TEST_CASE_TEMPLATE(cone_projection_has_its_defining_properties, R, rolling_rows) {
    constexpr int n = R::value;
    constexpr double rounding = 1e-14;
    RandomBlocks random(41);
    for (const double mu : {0.0, 1e-9, 0.3, 7.0, 1e9})
        for (const double mu_r : {0.0, 1e-9, 0.2, 1.0, 1e9}) {
            const talus::RollingCone<n> cone{mu, mu_r};
            for (int k = 0; k < 1000; ++k) {
                const talus::Vector<n> x = random.unit<n>();
                const talus::Vector<n> y = cone.project(x), z = y - x;
                BOOST_TEST(tangent<n>(y) <= mu * y[0] * (1.0 + rounding) + 1e-300);
                BOOST_TEST(rolling<n>(y) <= mu_r * y[0] * (1.0 + rounding) + 1e-300);
                BOOST_TEST(mu * tangent<n>(z) + mu_r * rolling<n>(z) <=
                           z[0] + rounding * (1.0 + mu + mu_r));
                BOOST_TEST(std::abs(y.dot(z)) <= rounding);
                BOOST_TEST((cone.project_dual(x) - (x + cone.project(-x))).norm() == 0.0);
                if (cone.contains(x)) BOOST_TEST((y - x).norm() == 0.0);
                if (cone.dual_contains(-x)) BOOST_TEST(y.norm() == 0.0);
            }
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rolling_coulomb_is_a_law, R, rolling_rows) {
    constexpr int n = R::value;
    using Law = talus::RollingCoulomb<n>;
    for (const Law law : {Law{0.0, 0.0}, Law{0.0, 0.1}, Law{0.3, 0.0}, Law{0.3, 1e-9},
                          Law{0.3, 0.1}, Law{1.0, 1.0}, Law{0.1, 1e3}, Law{1e3, 0.1}}) {
        const double friction = law.mu + law.mu_r;
        BOOST_TEST_CONTEXT("mu = " << law.mu << ", mu_r = " << law.mu_r)
        test_law<n>(
            law,
            {.friction = friction, .unique_coupling = 0.5 / (friction + 1e-9), .rolling = true},
            [law](const talus::Vector<n>& r) {
                return r[0] >= 0.0 && tangent<n>(r) <= law.mu * r[0] * (1.0 + 1e-15) &&
                       rolling<n>(r) <= law.mu_r * r[0] * (1.0 + 1e-15);
            },
            42);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(adaptors_take_rolling_friction, R, rolling_rows) {
    constexpr int n = R::value;
    using Law = talus::RollingCoulomb<n>;
    using Any = talus::AnyLaw<n, talus::Bilateral<n>, Law>;
    static_assert(talus::has_rolling_rows<Any> && talus::has_rolling_rows<talus::Cohesive<n, Law>>);
    static_assert(!talus::has_rolling_rows<talus::Bilateral<n>>);
    const auto any = [](const talus::Vector<n>&) { return true; };
    const LawTraits<n> traits{.friction = 0.5, .unique_coupling = 1.0, .rolling = true};
    test_law<n>(Any{Law{0.3, 0.2}}, traits, any, 43);
    test_law<n>(talus::Cohesive<n, Law>{{0.3, 0.2}, 0.7}, traits, any, 44);
}

BOOST_AUTO_TEST_CASE(answer_in_the_plane_is_the_enumerated_one) {
    RandomBlocks random(45);
    int sliding = 0, turning = 0, both = 0, neither = 0, several = 0;
    for (int k = 0; k < 20000; ++k) {
        const talus::LocalProblem<3> p{random.well_conditioned<3>(), random.normal<3>()};
        const talus::RollingCoulomb<3> law{random.uniform(0.0, 2.0), random.uniform(0.0, 2.0)};
        const auto all = enumerated(law, p);
        const talus::Vector<3> r = law.solve(p, p.b), u = p.velocity(r);
        double distance = INFINITY;
        for (const auto& x : all) distance = std::min(distance, (x - r).norm());
        BOOST_TEST(distance <= same_answer * (1.0 + r.norm()));
        several += all.size() > 1;
        if ((law.mu + law.mu_r) * coupling<3>(p.W) < 0.9) BOOST_TEST(all.size() == 1U);
        if (r[0] == 0.0) continue;
        const bool slides = std::abs(u[1]) > 1e-9, turns = std::abs(u[2]) > 1e-9;
        sliding += slides && !turns;
        turning += turns && !slides;
        both += slides && turns;
        neither += !slides && !turns;
    }
    for (const int count : {sliding, turning, both, neither}) BOOST_TEST(count > 100);
    BOOST_TEST(several > 0);
}

// The natural map itself, repeated, from anywhere: slow, and without a line of RollingBlock.
BOOST_AUTO_TEST_CASE_TEMPLATE(answer_is_where_the_natural_map_leads, R, rolling_rows) {
    constexpr int n = R::value;
    RandomBlocks random(46);
    int slips = 0;
    for (int k = 0; k < 100; ++k) {
        const talus::LocalProblem<n> p{random.well_conditioned<n>(), random.normal<n>()};
        const double limit = 0.4 / coupling<n>(p.W);
        const talus::RollingCoulomb<n> law{random.uniform(0.0, std::min(1.0, limit)),
                                           random.uniform(0.0, std::min(1.0, limit))};
        const talus::Vector<n> r = law.solve(p, p.b);
        talus::Vector<n> x = random.normal<n>();
        for (int i = 0; i < 5000; ++i) x = law.natural_map(p.velocity(x), x, 0.5);
        BOOST_TEST((x - r).norm() <= same_answer * (1.0 + r.norm()));
        slips += r[0] > 0.0 && p.velocity(r).norm() > 1e-6;
    }
    BOOST_TEST(slips > 30);
}

// Rods and points on which several impulses have one effect: any of the answers will do, but one
// there is.
BOOST_AUTO_TEST_CASE_TEMPLATE(singular_blocks_are_solved_where_answers_are_not_unique, R,
                              rolling_rows) {
    constexpr int n = R::value;
    RandomBlocks random(48);
    for (int k = 0; k < 20000; ++k) {
        const talus::Matrix<n> w = random.semidefinite<n>(random.integer(1, n - 1));
        const talus::LocalProblem<n> p{w, w * random.normal<n>()};
        const double limit = 0.25 / coupling<n>(w);
        const talus::RollingCoulomb<n> law{limit * random.log_uniform(1e-3, 1.0),
                                           limit * random.log_uniform(1e-3, 1.0)};
        const double friction = law.mu + law.mu_r;
        BOOST_TEST(law_error<n>(law, p, law.solve(p, p.b)) <= 1e-13 * (1.0 + friction));
    }
}

// The same bodies with moments in N m or in N nm.
BOOST_AUTO_TEST_CASE_TEMPLATE(units_of_moments_do_not_matter, R, rolling_rows) {
    constexpr int n = R::value, half = (n - 1) / 2;
    RandomBlocks random(49);
    for (int k = 0; k < 2000; ++k) {
        const talus::LocalProblem<n> p{random.well_conditioned<n>(), random.normal<n>()};
        const double limit = 0.25 / coupling<n>(p.W);
        const talus::RollingCoulomb<n> law{random.uniform(0.0, limit), random.uniform(0.0, limit)};
        const double length = random.log_uniform(1e-12, 1e12);
        talus::Vector<n> unit = talus::Vector<n>::Ones();
        unit.template tail<half>().setConstant(length);
        const talus::RollingCoulomb<n> other{law.mu, law.mu_r / length};
        const talus::Vector<n> r = law.solve(p, p.b);
        const talus::Vector<n> scaled = unit.asDiagonal() * p.b;
        const talus::Vector<n> same =
            unit.asDiagonal() *
            other.solve({unit.asDiagonal() * p.W * unit.asDiagonal(), scaled}, scaled);
        BOOST_TEST((same - r).norm() <= same_answer * (1.0 + r.norm()));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(without_or_apart_from_rolling_it_is_coulombs_law, R, rolling_rows) {
    constexpr int n = R::value, dim = (n + 1) / 2;
    RandomBlocks random(47);
    for (int k = 0; k < 1000; ++k) {
        talus::LocalProblem<n> p{random.well_conditioned<n>(), random.normal<n>()};
        const talus::LocalProblem<dim> contact{p.W.template topLeftCorner<dim, dim>(),
                                               p.b.template head<dim>()};
        const talus::Coulomb<dim> coulomb{0.45 / coupling<dim>(contact.W)};
        const talus::Vector<dim> expected = coulomb.solve(contact, contact.b);
        const double bound = same_answer * (1.0 + expected.norm());
        const auto same = [&](const talus::Vector<n>& r) {
            return (r.template head<dim>() - expected).norm() <= bound;
        };
        BOOST_TEST(same(talus::RollingCoulomb<n>{coulomb.mu, 0.0}.solve(p, p.b)));
        p.W.template topRightCorner<dim, n - dim>().setZero();
        p.W.template bottomLeftCorner<n - dim, dim>().setZero();
        BOOST_TEST(same(talus::RollingCoulomb<n>{coulomb.mu, 0.3}.solve(p, p.b)));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(problem_without_an_answer_shows_in_the_natural_map, R, rolling_rows) {
    constexpr int n = R::value;
    const talus::LocalProblem<n> fixed{talus::Matrix<n>::Zero(), -talus::Vector<n>::Ones()};
    const talus::RollingCoulomb<n> law{0.5, 0.1};
    const talus::Vector<n> r = law.solve(fixed, fixed.b);
    BOOST_TEST(r.allFinite());
    BOOST_TEST(law_error<n>(law, fixed, r) > 0.1);
}

BOOST_AUTO_TEST_CASE(bad_rolling_friction_is_named) {
    using Law = talus::RollingCoulomb<5>;
    const auto says = [](const char* text) {
        return [text](const talus::input_error& e) {
            return std::string(e.what()).find(text) != std::string::npos;
        };
    };
    BOOST_CHECK_EXCEPTION((Law{0.3, -1.0}.require_valid("ball")), talus::input_error,
                          says("ball.mu_r is -1"));
    BOOST_CHECK_EXCEPTION((Law{NAN, 1.0}.require_valid("ball")), talus::input_error,
                          says("ball.mu is nan"));
}

BOOST_AUTO_TEST_SUITE_END()
