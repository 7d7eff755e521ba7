// SPDX-License-Identifier: BSL-1.0
// Validation case E01, and the two forms of the gyroscopic term (E04 in small).
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/momentum.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_free_motion)

using namespace experiment;

BOOST_AUTO_TEST_CASE_TEMPLATE(a_thrown_body_flies_the_exact_parabola, D, dimensions) {
    constexpr int Dim = D::value;
    const double h = 0.37;
    const int steps = 100;
    auto sim = simulation<Dim>(law<Dim>(0.0), h, -g * up<Dim>(), false);
    V<Dim> v0 = in_plane<Dim>(3, 4);
    if constexpr (Dim == 3) v0 = {3, 1, 4};
    W<Dim> w = W<Dim>::Zero();
    w[0] = 2.0;
    if constexpr (Dim == 3) w = V<3>(0.6, -0.64, 0.48) * 2.0;
    sim.system().add(talus::Ball<Dim>{0.1}, round_inertia<Dim>(1.3, 0.1), {}, {v0, w});
    for (int k = 0; k < steps; ++k) sim.step();
    const double t = steps * h;
    const auto& bodies = sim.system().bodies;
    const V<Dim> x = v0 * t - 0.5 * g * t * t * up<Dim>();
    BOOST_CHECK_SMALL(largest(bodies.position[0] - x), steps * 1e-15 * x.norm());
    BOOST_CHECK_SMALL(largest(bodies.velocity[0] - (v0 - g * t * up<Dim>())),
                      steps * 1e-15 * g * t);
    const V<Dim> probe = V<Dim>::Unit(0);
    BOOST_CHECK_SMALL(
        largest(bodies.rotation[0] * probe - talus::Rotation<Dim>::exp(t * w) * probe),
        steps * 1e-14);
}

/// A symmetric top, I = (1, 1, 2), spinning at w0 = (0.3, 0, 1.5) about its body axes.
talus::Simulation<3> top(talus::Gyroscopic gyroscopic, double h) {
    talus::SimulationParams params;
    params.h = h;
    params.step.gyroscopic = gyroscopic;
    talus::Simulation<3> sim(law<3>(0.0), params);
    sim.system().add(talus::Ball<3>{0.1}, talus::Inertia<3>{1.0, {1, 1, 2}}, {},
                     {V<3>::Zero(), {0.3, 0.0, 1.5}});
    return sim;
}

BOOST_AUTO_TEST_CASE(the_papers_gyroscopic_term_gains_the_factor_it_must) {
    const double h = 0.01, rate = 1.5;
    auto sim = top(talus::Gyroscopic::explicit_term, h);
    for (int k = 0; k < 500; ++k) sim.step();
    const V<3> w = sim.system().bodies.spin[0];
    const double gain = w.head<2>().norm() / 0.3;
    BOOST_CHECK_SMALL(gain - std::pow(1 + h * h * rate * rate, 250), 500 * 1e-14);
    BOOST_CHECK_CLOSE(gain, 1.057855423, 1e-6);
    BOOST_CHECK_SMALL(w[2] - 1.5, 500 * 1e-15);
}

BOOST_AUTO_TEST_CASE(the_momentum_preserving_term_keeps_momentum_and_energy_of_the_top) {
    auto sim = top(talus::Gyroscopic::momentum_preserving, 0.01);
    const V<3> before = talus::momentum(sim.system().bodies).angular;
    talus::EnergyLedger<3> ledger(sim.system().bodies, sim.system().gravity);
    for (int k = 0; k < 500; ++k) ledger.record(sim.step(), sim.system().bodies);
    const V<3> after = talus::momentum(sim.system().bodies).angular;
    BOOST_CHECK_SMALL((after - before).norm() / before.norm(), 500 * 1e-14);
    BOOST_CHECK_SMALL(sim.system().bodies.spin[0].head<2>().norm() - 0.3, 1e-12);
    BOOST_CHECK_LT(ledger.closure(), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
