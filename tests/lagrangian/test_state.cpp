// SPDX-License-Identifier: BSL-1.0
// A run with stops makes the bits of one without.
#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <string>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_state)

using namespace machines;
using talus::LagrangianState;
using talus::VelocityForces;

namespace {

/// A double pendulum with a damper in each joint, which strikes a wall with friction.
struct DampedPendulum : DoublePendulum {
    void force(double t, const auto& q, const auto& u, auto& f) const {
        DoublePendulum::force(t, q, u, f);
        f -= 0.3 * u;
    }
};

template <class System, class Coordinates>
void goes_on(const System& system, const Coordinates& q, talus::LagrangianParams params) {
    const Coordinates u = 0.1 * q;
    talus::LagrangianSimulation whole(system, q, u, 0.7, params);
    BOOST_TEST(whole.run(2.0).certified());
    const Coordinates elsewhere = 0.5 * q;
    LagrangianState state = talus::LagrangianSimulation(system, q, u, 0.7, params).state();
    for (const int steps : {0, 1, 700, 299, 1000}) {
        talus::LagrangianSimulation part(system, elsewhere, params);
        BOOST_TEST(part.run(0.003).certified());
        part.restore(talus::from_record<LagrangianState>(talus::record_of(state)));
        BOOST_TEST((part.state() == state));
        BOOST_TEST(part.data().contact_count() == 0u);
        for (int k = 0; k < steps; ++k) part.step();
        state = part.state();
    }
    BOOST_TEST((state == whole.state()));
    BOOST_TEST(!state.impulse.empty());
    BOOST_TEST(state.step_count == 2000);
}
template <class Sim>
std::string complaint(Sim& sim, const LagrangianState& state) {
    const LagrangianState before = sim.state();
    std::string text = "nothing";
    try {
        sim.restore(state);
    } catch (const talus::input_error& e) {
        text = e.what();
        BOOST_TEST((sim.state() == before));
    }
    return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_with_stops_makes_the_bits_of_one_without) {
    for (const auto forces : {VelocityForces::explicit_begin, VelocityForces::implicit_midpoint}) {
        const talus::LagrangianParams params{.h = 1e-3, .velocity_forces = forces};
        DampedPendulum pendulum;
        pendulum.wall = 0.5;
        pendulum.law = {{0.3}, 0.4, 0.0};
        goes_on(pendulum, Two(1.0, -1.0), params);
        goes_on(Stack{0.5}, Eigen::VectorXd(Eigen::Vector3d(0.05, 0.2, 0.4)), params);
    }
}

BOOST_AUTO_TEST_CASE(states_of_others_are_refused) {
    const Eigen::VectorXd three = Eigen::Vector3d(0.0, 0.1, 0.2), two = Eigen::Vector2d(0.0, 0.1);
    talus::LagrangianSimulation sim(Stack{}, three, {.h = 1e-3});
    BOOST_TEST(sim.run(0.01).certified());
    const LagrangianState good = sim.state();
    BOOST_TEST(complaint(sim, good) == "nothing");
    BOOST_TEST(complaint(sim, talus::LagrangianSimulation(Stack{}, three, {.h = 2e-3}).state()) ==
               "step size h of the state is 0.002, but must be that of the simulation, 0.001");
    BOOST_TEST(complaint(sim, talus::LagrangianSimulation(Stack{}, two, {.h = 1e-3}).state()) ==
               "number of coordinates of the state is 2, but must be that of the simulation, 3");
    const auto spoilt = [&](auto change) {
        LagrangianState state = good;
        change(state);
        return complaint(sim, state);
    };
    BOOST_TEST(spoilt([](auto& s) { s.q[1] = NAN; }) ==
               "q of the state[1] is nan, but must be finite");
    BOOST_TEST(spoilt([](auto& s) { s.u.pop_back(); }) ==
               "number of velocities of the state is 2, but must be that of coordinates, 3");
    BOOST_TEST(spoilt([](auto& s) { s.rows = 3; }) ==
               "number of rows of the state is 3, but must be that of the system, 2");
    BOOST_TEST(spoilt([](auto& s) { s.impulse.pop_back(); }) ==
               "number of impulses of the state is 5, but must be a multiple of 2");
    BOOST_TEST(spoilt([](auto& s) { s.step_count = -1; }) ==
               "steps of the state is -1, but must be finite and not negative");
    talus::NumberRecord record = talus::record_of(good);
    record.reals.pop_back();
    BOOST_CHECK_THROW(talus::from_record<LagrangianState>(record), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
