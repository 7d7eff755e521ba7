// SPDX-License-Identifier: BSL-1.0
#include <talus/spatial/tilt.hpp>
#include <talus/stepping/simulation.hpp>
#include <talus/stepping/step_queries.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_step_queries)

using namespace experiment;

/// Floor 0, box 1 on it, ball 2 on the box, ball 3 apart.
template <int Dim>
talus::Simulation<Dim> pair_on_a_floor(double angle = 0.0) {
    talus::Simulation<Dim> sim(law<Dim>(0.5), {.h = 1e-3, .step = {.contact_tolerance = 1e-9}});
    sim.solver().params.tolerance = 1e-12;
    auto& system = sim.system();
    const talus::Rotation<Dim> turned = talus::tilt<Dim>(angle);
    const V<Dim> normal = turned * up<Dim>();
    system.gravity = -g * up<Dim>();
    system.add_obstacle(talus::HalfSpace<Dim>{normal, 0.0});
    system.add(talus::Box<Dim>(V<Dim>(0.5 * V<Dim>::Ones())), 1000.0, {0.5 * normal, turned});
    system.add(talus::Ball<Dim>(0.25), 1000.0, {1.25 * normal, {}});
    system.add(talus::Ball<Dim>(0.25), 1000.0, {9.0 * normal, {}});
    return sim;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impulses_are_those_that_carry_the_weights, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = pair_on_a_floor<Dim>();
    const auto& data = sim.step();
    const auto& bodies = sim.system().bodies;
    const double box = bodies.mass(1) * g * data.h, ball = bodies.mass(2) * g * data.h;
    const auto close = boost::test_tools::tolerance(1e-9);
    BOOST_TEST(talus::contacts_between(data, 0, 1).size() == (Dim == 2 ? 2u : 4u));
    BOOST_TEST(talus::contacts_between(data, 1, 0) == talus::contacts_between(data, 0, 1),
               boost::test_tools::per_element());
    BOOST_TEST(talus::contacts_between(data, 2, 1).size() == 1u);
    BOOST_TEST(talus::contacts_between(data, 0, 3).empty());
    BOOST_TEST(talus::touches(data, 2, 1));
    BOOST_TEST(!talus::touches(data, 2, 0));

    BOOST_TEST(talus::wrench_impulse_on(data, 1).force[Dim - 1] == box, close);
    BOOST_TEST(talus::wrench_impulse_on(data, 2).force[Dim - 1] == ball, close);
    BOOST_TEST(talus::wrench_impulse_on(data, 0).force[Dim - 1] == -(box + ball), close);
    BOOST_TEST(talus::wrench_impulse_on(data, 3).force.isZero(0.0));
    BOOST_TEST(talus::wrench_impulse_between(data, 1, 0).force[Dim - 1] == box + ball, close);
    BOOST_TEST(talus::wrench_impulse_between(data, 1, 2).force[Dim - 1] == -ball, close);
    for (const std::size_t c : talus::contacts_between(data, 1, 0))
        BOOST_TEST(talus::contact_velocity(data, c).norm() < 1e-10);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impulses_and_their_moments_change_the_momentum_of_each_body, D,
                              dimensions) {
    constexpr int Dim = D::value;
    auto sim = pair_on_a_floor<Dim>(-0.2);
    sim.system().bodies.velocity[2] = -2.0 * V<Dim>::Unit(0) - up<Dim>();
    const auto& data = sim.step();
    const auto& bodies = sim.system().bodies;
    for (const talus::BodyIndex i : {1, 2, 3}) {
        const auto k = static_cast<std::size_t>(i);
        const auto given = talus::wrench_impulse_on(data, i);
        const V<Dim> gained = bodies.mass(k) * (data.end[k].linear - data.free[k].linear);
        BOOST_TEST((given.force - gained).norm() <= 1e-9 * bodies.mass(k));
        // A ball's inertia is the same about all axes.
        if (k > 1)
            BOOST_TEST(
                (given.torque - bodies.inertia(k)[0] * (data.end[k].angular - data.free[k].angular))
                    .norm() <= 1e-9 * bodies.mass(k));
    }
    BOOST_TEST(talus::touches(data, 1, 2));
    // Pushed down and forwards: what leaves the ball reaches the box.
    const auto on_box = talus::wrench_impulse_between(data, 1, 2);
    const auto on_ball = talus::wrench_impulse_between(data, 2, 1);
    BOOST_TEST((on_box.force + on_ball.force).norm() == 0.0);
    BOOST_TEST(on_ball.torque.norm() > 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(tilts_are_the_same_picture_in_the_plane_and_in_space, D, dimensions) {
    constexpr int Dim = D::value;
    const auto turned = talus::tilt<Dim>(0.3);
    const V<Dim> first = turned * V<Dim>::Unit(0), last = turned * up<Dim>();
    BOOST_TEST(first[0] == std::cos(0.3), boost::test_tools::tolerance(1e-15));
    BOOST_TEST(first[Dim - 1] == std::sin(0.3), boost::test_tools::tolerance(1e-15));
    BOOST_TEST(last[0] == -std::sin(0.3), boost::test_tools::tolerance(1e-15));
    BOOST_TEST(last[Dim - 1] == std::cos(0.3), boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_body_that_the_step_did_not_have_is_named, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = pair_on_a_floor<Dim>();
    BOOST_CHECK_THROW(talus::touches(sim.data(), 0, 1), talus::input_error);  // there was no step
    const auto& data = sim.step();
    BOOST_TEST(!talus::touches(data, 0, 3));
    BOOST_TEST(talus::wrench_impulse_on(data, 3).force.norm() == 0.0);
    for (const talus::BodyIndex none : {-1, 4}) {
        BOOST_CHECK_THROW(talus::touches(data, none, 1), talus::input_error);
        BOOST_CHECK_THROW(talus::contacts_between(data, 1, none), talus::input_error);
        BOOST_CHECK_THROW(talus::wrench_impulse_on(data, none), talus::input_error);
        BOOST_CHECK_THROW(talus::wrench_impulse_between(data, 1, none), talus::input_error);
        BOOST_CHECK_THROW(talus::wrench_impulse_between(data, none, 1), talus::input_error);
    }
}

BOOST_AUTO_TEST_SUITE_END()
