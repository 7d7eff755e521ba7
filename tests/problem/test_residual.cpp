// SPDX-License-Identifier: BSL-1.0
#include <talus/law/bilateral.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/signorini.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/problem/residual.hpp>

#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <limits>

#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(residual)

constexpr double rounding = 1e-12;  // relative, of sums over some ten contacts

template <int Dim>
std::vector<talus::Vector<Dim>> random_impulses(RandomBlocks& random, std::size_t n) {
    std::vector<talus::Vector<Dim>> r(n);
    for (auto& x : r) x = random.normal<Dim>();
    return r;
}

/// One unit mass, a particle, on an obstacle.
template <int Dim, class Law>
talus::ContactProblem<Dim, Law> particle(const talus::Vector<Dim>& free_velocity, const Law& law) {
    RandomBlocks random(0);
    auto p =
        RandomProblem<Dim, Law>{.bodies = 2, .contacts = 1, .mass_ratio = 1.0, .arm = 0.0}.make(
            random, law);
    p.free_velocity[0] = free_velocity;
    return p;
}

// W = 1, so rho = 1: every number can be written down.
BOOST_AUTO_TEST_CASE_TEMPLATE(residual_of_a_particle_is_the_hand_computed_one, D, dimensions) {
    using Vec = talus::Vector<D::value>;
    const auto p = particle<D::value, talus::Coulomb<D::value>>(
        -3.0 * Vec::Unit(0) + 4.0 * Vec::Unit(1), {.mu = 0.5});
    std::vector<Vec> r{Vec::Zero()};
    // f = P_K(-u - 2 n) with u = (-3, 4): P_K(1, -4) = (1 + 2) / 1.25 (1, -0.5), scale |u_free|
    // = 5.
    BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).relative == 2.4 * std::sqrt(1.25) / 5.0,
               boost::test_tools::tolerance(1e-14));
    r[0] = 3.0 * Vec::Unit(0) - 1.5 * Vec::Unit(1);  // stops u_n, slides on: the solution
    const talus::Residual solved = talus::residual(p, std::span<const Vec>(r));
    BOOST_TEST(solved.relative < 1e-15);
    BOOST_TEST(solved.finite());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(residual_does_not_depend_on_units, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    RandomBlocks random(41);
    const auto p =
        RandomProblem<dim, talus::Coulomb<dim>>{.mass_ratio = 1e3}.make(random, {.mu = 0.5});
    auto r = random_impulses<dim>(random, p.contact_count());
    const double eta = talus::residual(p, std::span<const Vec>(r)).relative;
    BOOST_TEST(eta > 0.01);
    for (const double length : {1e-6, 1e3})
        for (const double mass : {1e-15, 1.0, 1e9})
            for (const double time : {1e-3, 1e4}) {
                auto scaled = r;
                for (auto& x : scaled) x *= mass * length / time;
                const auto q = in_other_units(p, length, mass, time);
                BOOST_TEST(talus::residual(q, std::span<const Vec>(scaled)).relative == eta,
                           boost::test_tools::tolerance(rounding));
            }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(residual_does_not_depend_on_duplication, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    RandomBlocks random(42);
    auto p = RandomProblem<dim, talus::Coulomb<dim>>{}.make(random, {.mu = 0.5});
    p.jacobian.a[3] = p.jacobian.b[3] = 5;  // W_cc = 0 must not spoil it
    auto r = random_impulses<dim>(random, p.contact_count());
    const auto once = talus::residual(p, std::span<const Vec>(r));
    const std::size_t n = r.size();
    for (std::size_t i = 0; i < n; ++i) r.push_back(r[i]);
    const auto both = talus::residual(twice(p), std::span<const Vec>(r));
    BOOST_TEST(both.relative == once.relative, boost::test_tools::tolerance(rounding));
    BOOST_TEST(both.worst_share == once.worst_share, boost::test_tools::tolerance(rounding));
    BOOST_TEST(both.worst_contact % n == once.worst_contact);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(worst_contact_is_the_one_that_is_off, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = particle<dim, talus::Signorini<dim>>(-Vec::Unit(0), {});
    for (int k = 0; k < 3; ++k) p = twice(p);
    std::vector<Vec> r(8, Vec::Unit(0));
    r[5] *= 0.9;
    const auto res = talus::residual(p, std::span<const Vec>(r));
    BOOST_TEST(res.worst_contact == 5U);
    BOOST_TEST(res.worst_share == 0.1, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(res.relative == 0.1 / std::sqrt(8.0), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contact_between_obstacles_stays_visible, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = particle<dim, talus::Signorini<dim>>(-Vec::Unit(0), {});
    p.inverse_mass.linear[0] = 0.0;
    p.inverse_mass.angular[0].setZero();
    std::vector<Vec> r{Vec::Zero()};
    BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).relative == 1.0);
    p.free_velocity[0] = Vec::Unit(0);
    BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).relative == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_over_nothing_is_zero, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    const auto p = particle<dim, talus::Coulomb<dim>>(Vec::Zero(), {.mu = 0.5});
    const std::vector<Vec> r{Vec::Zero()};
    BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).relative == 0.0);
    const talus::ContactProblem<dim, talus::Coulomb<dim>> empty;
    BOOST_TEST(talus::residual(empty, std::span<const Vec>()).relative == 0.0);
    BOOST_CHECK_THROW(talus::residual(empty, std::span<const Vec>(r)), talus::input_error);
}

// A mass on a mass on the floor, W = (1/m + 1/M, -1/m; -1/m, 1/m): the floor carries both.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_heavy_mass_that_falls_onto_a_light_one_is_seen, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    using Law = talus::Signorini<dim>;
    for (const double ratio : {1.0, 1e3, 1e6, 1e9}) {
        auto p = stack_of_particles<dim>({1.0, ratio}, Law{});
        p.free_velocity[0] = -Vec::Unit(0);  // both fall at 1 m/s
        p.free_velocity[1] = Vec::Zero();
        std::vector<Vec> r{(1.0 + ratio) * Vec::Unit(0), ratio * Vec::Unit(0)};
        BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).contact < 1e-6);
        // The light one stands, the heavy one falls on as if there were nothing.
        r = {Vec(1.04 * Vec::Unit(0)), Vec(0.04 * Vec::Unit(0))};
        const auto wrong = talus::residual(p, std::span<const Vec>(r));
        BOOST_TEST(wrong.contact > 0.9);
        BOOST_TEST(wrong.velocity > 0.9);
        BOOST_TEST(wrong.worst_contact == 1U);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_fast_elsewhere_hides_nothing, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = twice(particle<dim, talus::Signorini<dim>>(-Vec::Unit(0), {}));
    p.free_velocity[1] = -1e6 * Vec::Unit(0);
    std::vector<Vec> r{0.5 * Vec::Unit(0), 1e6 * Vec::Unit(0)};
    const auto slow = talus::residual(p, std::span<const Vec>(r));
    BOOST_TEST(slow.whole < 1e-6);
    // What the rounding of the fast one may explain is not counted.
    BOOST_TEST(slow.contact == 0.5, boost::test_tools::tolerance(1e-7));
    BOOST_TEST(slow.velocity == 0.5, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(slow.worst_contact == 0U);
    BOOST_TEST(slow.fastest_contact == 0U);
    // The worst one by its own scale, and the one that is off by the largest velocity.
    r[1] -= 10.0 * Vec::Unit(0);
    const auto both = talus::residual(p, std::span<const Vec>(r));
    BOOST_TEST(both.worst_contact == 0U);
    BOOST_TEST(both.fastest_contact == 1U);
    BOOST_TEST(both.velocity == 10.0, boost::test_tools::tolerance(1e-9));
    r[1] += 10.0 * Vec::Unit(0);
    r[0] = Vec::Unit(0);
    BOOST_TEST(talus::residual(p, std::span<const Vec>(r)).contact < 1e-12);
}

// A unit mass between two walls: W = (1, -1; -1, 1) along the normals.
template <int Dim>
talus::ContactProblem<Dim, talus::Signorini<Dim>> between_walls(double closing) {
    using Vec = talus::Vector<Dim>;
    auto p = twice(particle<Dim, talus::Signorini<Dim>>(-closing * Vec::Unit(0), {}));
    p.jacobian.a[1] = p.jacobian.a[0];
    p.jacobian.b[1] = p.jacobian.b[0];
    p.jacobian.frame[1] = -p.jacobian.frame[0];
    return p;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impulses_that_hide_a_violation_in_their_last_digits_are_refused, D,
                              dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    const auto p = between_walls<dim>(0.02);
    for (const double large : {0.0, 1.0, 1e6, 1e9, 1e12, 1e15, 1e16, 3e17}) {
        const std::vector<Vec> r(2, large * Vec::Unit(0));
        const auto found = talus::residual(p, std::span<const Vec>(r));
        BOOST_TEST_INFO_SCOPE("impulses of " << large);
        BOOST_TEST(found.contact > 0.99);
        BOOST_TEST(found.relative > 0.099);
    }
}

// A mass that a floor holds, at V = 1, while walls close at a thousandth of that: however large the
// impulses between the walls, what they hide is never called solved at the usual tolerance.
BOOST_AUTO_TEST_CASE_TEMPLATE(no_impulse_hides_a_thousandth_of_the_loads, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = twice(between_walls<dim>(1e-3));
    p.jacobian.a[2] = p.jacobian.a[0];
    p.jacobian.b[2] = p.jacobian.b[0];
    p.jacobian.frame[2] = p.jacobian.frame[0];
    p.jacobian.frame[2].row(0).swap(p.jacobian.frame[2].row(1));
    p.free_velocity[2] = -Vec::Unit(0);
    // The fourth contact is of a body of its own, in no difficulty: never the worst one.
    p.free_velocity[3] = -Vec::Unit(0);
    for (const double large : {1.0, 1e6, 1e9, 1e10, 2e10, 1e11, 2e11, 1e12, 1e14}) {
        std::vector<Vec> r(4, large * Vec::Unit(0));
        r[2] = r[3] = Vec::Unit(0);
        const auto found = talus::residual(p, std::span<const Vec>(r));
        BOOST_TEST_INFO_SCOPE("impulses of " << large);
        BOOST_TEST(found.relative > 0.75e-4);
        BOOST_TEST(found.worst_contact < 2U);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_jam_that_a_solve_begins_with_is_no_violation, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    const auto p = between_walls<dim>(1e-16);  // which is what rounding makes of the jam
    const std::vector<Vec> r(2, Vec::Unit(0));
    talus::DelassusProduct<dim> w(p.jacobian, p.inverse_mass);
    w.start(std::span<const Vec>(r));
    const auto judge = [&](std::span<const Vec> start) {
        talus::ResidualMeasure<dim> measure;
        measure.template prepare<talus::DelassusProduct<dim>, talus::Signorini<dim>>(
            w, p.free_velocity, p.laws, start);
        return measure
            .template evaluate<talus::Signorini<dim>>(p.free_velocity, p.laws, r,
                                                      [&](std::size_t i) { return w.velocity(i); })
            .relative;
    };
    BOOST_TEST(judge(r) == 0.0);
    BOOST_TEST(judge({}) >= 1.0);
    const std::vector<Vec> small(2, 1e-6 * Vec::Unit(0));
    BOOST_TEST(judge(small) >= 1.0);
    // The same from scratch.
    const std::span<const Vec> jam(r);
    BOOST_TEST(talus::residual(p, jam, jam).relative == 0.0);
    BOOST_TEST(talus::residual(p, jam).relative >= 1.0);
    // Loads beyond the rounding of such impulses are no jam: neither solved nor in between.
    for (const double closing : {1e-13, 1e-12, 3.9e-12, 4.1e-12, 3.9e-11, 4.1e-11, 1e-9})
        BOOST_TEST(talus::residual(between_walls<dim>(closing), jam, jam).relative > 2e-4,
                   "closing at " << closing);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(islands_are_the_same_by_bodies_and_by_blocks, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(43);
    auto p =
        RandomProblem<dim, talus::Coulomb<dim>>{.bodies = 30, .contacts = 9}.make(random, {0.5});
    const talus::DelassusProduct<dim> product(p.jacobian, p.inverse_mass);
    const talus::DelassusSparse<dim> blocks(p.jacobian, p.inverse_mass);
    std::vector<std::uint32_t> by_bodies(9), by_blocks(9);
    product.islands(by_bodies);
    blocks.islands(by_blocks);
    std::size_t together = 0;
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            BOOST_TEST((by_bodies[i] == by_bodies[j]) == (by_blocks[i] == by_blocks[j]));
            together += by_bodies[i] == by_bodies[j] ? 1 : 0;
        }
    BOOST_TEST(together > 0U);
    BOOST_TEST(together < 36U);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_not_finite_shows, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()})
        for (int component = 0; component < dim; ++component) {
            RandomBlocks random(43);
            const auto good = RandomProblem<dim, talus::Signorini<dim>>{}.make(random, {});
            auto r = random_impulses<dim>(random, good.contact_count());
            auto p = good;
            p.free_velocity[2][component] = bad;
            BOOST_TEST(!talus::residual(p, std::span<const Vec>(r)).finite());
            p = good;
            p.jacobian.frame[2](component, 0) = bad;
            BOOST_TEST(!talus::residual(p, std::span<const Vec>(r)).finite());
            r[3][component] = bad;
            BOOST_TEST(!talus::residual(good, std::span<const Vec>(r)).finite());
        }
}

BOOST_AUTO_TEST_SUITE_END()
