// SPDX-License-Identifier: BSL-1.0
// Validation cases B02, B04, B05 and B09: what the weighted mean makes of collisions.
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/momentum.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_collisions)

using namespace experiment;

// --- B02: restitution-from-weight ----------------------------------------------------------------

BOOST_AUTO_TEST_CASE_TEMPLATE(the_weight_of_the_mean_gives_newtons_restitution, D, dimensions) {
    constexpr int Dim = D::value;
    for (double theta : {1.0 / 2, 5.0 / 9, 2.0 / 3, 0.8, 1.0}) {
        const double e = (1 - theta) / theta;
        auto wall = simulation<Dim>(law<Dim>(0.0, e), 1e-2, V<Dim>::Zero());
        wall.system().add(talus::Ball<Dim>{0.1}, round_inertia<Dim>(1.0, 0.1),
                          {0.1 * up<Dim>(), {}}, {-up<Dim>(), W<Dim>::Zero()});
        wall.step();
        BOOST_CHECK_SMALL(largest(wall.system().bodies.velocity[1] - e * up<Dim>()), class_r);

        auto pair = simulation<Dim>(law<Dim>(0.0, e), 1e-2, V<Dim>::Zero(), false);
        const V<Dim> x = V<Dim>::Unit(0);
        pair.system().add(talus::Ball<Dim>{0.1}, round_inertia<Dim>(1.0, 0.1), {-0.1 * x, {}},
                          {x, W<Dim>::Zero()});
        pair.system().add(talus::Ball<Dim>{0.1}, round_inertia<Dim>(3.0, 0.1), {0.1 * x, {}});
        pair.step();
        const auto& v = pair.system().bodies.velocity;
        BOOST_CHECK_SMALL(v[1][0] - v[0][0] - e, class_r);
        BOOST_CHECK_SMALL(v[0][0] + 3 * v[1][0] - 1, class_r);
    }
}

// --- B04: elastic-bounce-energy ------------------------------------------------------------------

BOOST_AUTO_TEST_CASE_TEMPLATE(an_elastic_ball_bounces_without_loss_for_ever, D, dimensions) {
    constexpr int Dim = D::value;
    const double radius = 0.1, height = 1.0;
    for (double h : {1e-2, 1e-3}) {
        auto sim = simulation<Dim>(law<Dim>(0.0, 1.0), h, -g * up<Dim>());
        sim.system().add(talus::Ball<Dim>{radius}, round_inertia<Dim>(1.0, radius),
                         {(radius + height) * up<Dim>(), {}});
        const double e0 = g * (radius + height);
        double worst = 0.0, apex = 0.0;
        int bounces = 0;
        sim.run(50.0, [&](const auto& s) {
            const auto& b = s.system().bodies;
            const double e =
                talus::kinetic_energy(b) + talus::potential_energy(b, s.system().gravity);
            worst = std::max(worst, std::abs(e - e0) / e0);
            if (s.time() > 1.0) apex = std::max(apex, b.position[1][Dim - 1]);
            if (s.data().contact_count() > 0) ++bounces;
        });
        BOOST_CHECK_LT(worst, 1e-12);
        BOOST_CHECK_GT(bounces, 50);
        BOOST_CHECK_SMALL(apex - radius - height, g * h * h);
    }
}

// --- B05: cradle-touching ------------------------------------------------------------------------

/// One step of touching balls on a line; returns the velocities along it.
template <int Dim>
std::vector<double> cradle(const std::vector<double>& masses, const std::vector<double>& before,
                           double e) {
    auto sim = simulation<Dim>(law<Dim>(0.0, e), 1e-3, V<Dim>::Zero(), false);
    for (std::size_t i = 0; i < masses.size(); ++i) {
        // Compensates the drift to the midpoint, so that the balls touch there: the catalogue's
        // state.
        const double x = 0.2 * static_cast<double>(i) - 0.5e-3 * before[i];
        sim.system().add(talus::Ball<Dim>{0.1}, round_inertia<Dim>(masses[i], 0.1),
                         {x * V<Dim>::Unit(0), {}}, {before[i] * V<Dim>::Unit(0), W<Dim>::Zero()});
    }
    sim.step();
    std::vector<double> after;
    for (const auto& v : sim.system().bodies.velocity) after.push_back(v[0]);
    return after;
}

void check_all(const std::vector<double>& seen, const std::vector<double>& expected) {
    BOOST_REQUIRE_EQUAL(seen.size(), expected.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
        BOOST_CHECK_SMALL(seen[i] - expected[i], 100 * solver_tolerance);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_touching_cradle_does_what_moreaus_law_says, D, dimensions) {
    constexpr int Dim = D::value;
    for (std::size_t n = 2; n <= 5; ++n)
        for (double e : {0.0, 0.5, 1.0}) {
            std::vector<double> before(n, 0.0);
            std::vector<double> after(n, (1 + e) / static_cast<double>(n));
            before[0] = 1.0;
            after[0] -= e;
            check_all(cradle<Dim>(std::vector<double>(n, 1.0), before, e), after);
        }
    check_all(cradle<Dim>({1, 1, 1, 1, 1}, {1, 1, 0, 0, 0}, 1.0), {-.2, -.2, .8, .8, .8});
    check_all(cradle<Dim>({1, 2, 3}, {1, 0, 0}, 1.0), {-2. / 3, 1. / 3, 1. / 3});
    check_all(cradle<Dim>({1, 1, 1}, {1, 0, -1}, 0.5), {-.5, 0, .5});
}

// --- B09: oblique-impact-sphere
// -------------------------------------------------------------------

/// Impact of a round body on the floor with velocity `v` in the plane of the first and last axis,
/// turned by `azimuth` about the last; returns the end velocity turned back and the rolling spin.
template <int Dim>
std::pair<V<Dim>, double> oblique_impact(const talus::DefaultLaw<Dim>& contact_law,
                                         double azimuth) {
    const double m = 1.3, r = 0.2;
    talus::Rotation<Dim> turn;
    if constexpr (Dim == 3) turn = talus::Rotation<3>::exp({0, 0, azimuth});
    const double h = 1e-3;
    auto sim = simulation<Dim>(contact_law, h, V<Dim>::Zero());
    const V<Dim> v = turn * in_plane<Dim>(3, -2);
    // Touches at the midpoint, where the step takes its geometry.
    sim.system().add(talus::Ball<Dim>{r}, round_inertia<Dim>(m, r),
                     {r * up<Dim>() - 0.5 * h * v, {}}, {v, W<Dim>::Zero()});
    sim.step();
    const auto twist = sim.system().bodies.twist(1);
    const W<Dim> spin = [&] {
        if constexpr (Dim == 3)
            return W<3>(turn.transpose_times(twist.angular));
        else
            return twist.angular;
    }();
    const double w = spin.dot(rolling_spin<Dim>(1.0));
    BOOST_CHECK_SMALL(largest(spin - rolling_spin<Dim>(w)), class_r * 20);
    return {turn.transpose_times(twist.linear), w};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_oblique_impact_sticks_or_slips_by_the_closed_form, D, dimensions) {
    constexpr int Dim = D::value;
    const double m = 1.3, r = 0.2, e_n = 0.8, k = kap<Dim>;
    for (double mu : {0.1, 0.9})
        for (double e_t : {0.0, 0.5})
            for (int step = 0; step < (Dim == 3 ? 10 : 1); ++step) {
                const auto [v, w] = oblique_impact<Dim>(law<Dim>(mu, e_n, e_t), 0.6 * step);
                const double p_n = m * (1 + e_n) * 2;
                const double p_stick = -m * k / (1 + k) * (1 + e_t) * 3;
                const double p_t = std::max(p_stick, -mu * p_n);
                BOOST_CHECK_SMALL(largest(v - in_plane<Dim>(3 + p_t / m, e_n * 2)), 10 * class_r);
                BOOST_CHECK_SMALL(w - -p_t * r / (k * m * r * r), 100 * class_r);
            }
    // The catalogue's numbers.
    BOOST_CHECK_SMALL(oblique_impact<Dim>(law<Dim>(0.1, e_n), 0).first[0] - 2.64, 10 * class_r);
    BOOST_CHECK_SMALL(oblique_impact<Dim>(law<Dim>(0.1, e_n), 0).second - (Dim == 2 ? 3.6 : 4.5),
                      100 * class_r);
    BOOST_CHECK_SMALL(
        oblique_impact<Dim>(law<Dim>(0.9, e_n), 0).first[0] - (Dim == 2 ? 2.0 : 15.0 / 7.0),
        10 * class_r);
}

BOOST_AUTO_TEST_SUITE_END()
