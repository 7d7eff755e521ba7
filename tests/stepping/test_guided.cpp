// SPDX-License-Identifier: BSL-1.0
// Bodies whose axes are locked, walls that press, and bodies that do not touch each other: against
// closed forms.
#include <talus/dynamics/servo.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/solver/solver_registry.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/step_queries.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

#include "common/dimensions.hpp"
#include "heap.hpp"

using namespace experiment;

BOOST_AUTO_TEST_SUITE(stepping_guided)

template <int Dim>
V<Dim> x_axis() {
    return V<Dim>::Unit(0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_hits_a_body_on_a_rail, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.0), 1e-3, V<Dim>::Zero(), false);
    auto& system = sim.system();
    // The rail leads along the first axis, the blow comes at 45 degrees.
    const V<Dim> n = (x_axis<Dim>() + up<Dim>()).normalized();
    const double m = 2.0, M = 3.0, v = 1.5;
    const auto rail = system.add(talus::Ball<Dim>(0.1), round_inertia<Dim>(M, 0.1), {});
    const auto ball = system.add(talus::Ball<Dim>(0.1), round_inertia<Dim>(m, 0.1),
                                 {V<Dim>(0.2 * n), {}}, {V<Dim>(-v * n), {}});
    auto locked = talus::LockedAxes<Dim>::all_but_translation(0);
    system.bodies.lock(rail, locked);
    sim.step();
    // Plastic: p n on the ball, -p n on the other, of which the rail takes the part across.
    const double along = n[0];
    const double p = v / (1.0 / m + along * along / M);
    BOOST_TEST((system.bodies.velocity[ball] - (p / m - v) * n).norm() < 1e-12);
    BOOST_TEST((system.bodies.velocity[rail] + p * along / M * x_axis<Dim>()).norm() < 1e-12);
    BOOST_TEST(system.bodies.spin[rail].is_zero());
    sim.step();
    BOOST_TEST(system.bodies.position[rail][Dim - 1] == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gravity_along_a_locked_axis_does_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim =
        simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>(2.0 * x_axis<Dim>() - 9.81 * up<Dim>()), false);
    auto& system = sim.system();
    const auto body = system.add(talus::Ball<Dim>(0.1), 1000.0, {});
    talus::LockedAxes<Dim> locked;
    locked.translation[Dim - 1] = true;
    system.bodies.lock(body, locked);
    BOOST_TEST(sim.run(1.0).certified());
    BOOST_TEST(system.bodies.position[body][Dim - 1] == 0.0);
    BOOST_CHECK_CLOSE(system.bodies.position[body][0], 1.0, 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_hinge_turns_by_its_moment_about_its_axis, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>::Zero(), false);
    auto& system = sim.system();
    // A box that stands askew on its hinge, so that all products of inertia count.
    V<Dim> half = V<Dim>::Constant(0.2);
    half[0] = 0.5;
    W<Dim> askew = W<Dim>::Constant(0.4);
    const auto rotation = talus::Rotation<Dim>::exp(askew);
    const auto door = system.add(talus::Box<Dim>(half), 700.0, {V<Dim>::Zero(), rotation});
    const int axis = talus::rotation_dof<Dim> - 1;
    system.bodies.lock(door, talus::LockedAxes<Dim>::all_but_rotation(axis));
    const talus::AngularMatrix<Dim> inertia =
        talus::tensor_world<Dim>(rotation, system.bodies.inertia(door));
    const double moment = 3.0;
    system.forces.push_back([&](double, const auto&, std::span<talus::Wrench<Dim>> wrenches) {
        wrenches[0].torque = W<Dim>::Constant(moment);
        wrenches[0].force = V<Dim>::Constant(100.0);
    });
    talus::EnergyLedger<Dim> books(system.bodies, system.gravity);
    for (int k = 0; k < 500; ++k) {
        sim.step();
        books.record(sim.data(), system.bodies);
    }
    const W<Dim> spin = system.bodies.twist(door).angular;
    BOOST_CHECK_CLOSE(spin[axis], moment * 0.5 / inertia(axis, axis), 1e-9);
    BOOST_TEST((spin - spin[axis] * W<Dim>::Unit(axis)).norm() < 1e-12 * spin.norm());
    BOOST_TEST(system.bodies.position[door].is_zero());
    BOOST_TEST(books.closure() < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_needle_on_a_hinge_turns_as_its_length_says) {
    for (const double radius : {1e-2, 1e-5, 1e-8}) {
        auto sim = simulation<3>(law<3>(0.3), 1e-3, V<3>::Zero(), false);
        auto& system = sim.system();
        const auto rotation = talus::Rotation<3>::exp(W<3>(0.0, 0.7, 0.4));
        const auto needle = system.add(talus::Capsule<3>(0.5, radius), 1.0 / (radius * radius),
                                       {V<3>::Zero(), rotation});
        system.bodies.lock(needle, talus::LockedAxes<3>::all_but_rotation(2));
        const double inertia =
            talus::tensor_world<3>(rotation, system.bodies.inertia(needle))(2, 2);
        system.forces.push_back(
            [](double, const auto&, auto wrenches) { wrenches[0].torque = W<3>(0.0, 0.0, 0.1); });
        for (int k = 0; k < 100; ++k) sim.step();
        BOOST_CHECK_CLOSE(system.bodies.twist(needle).angular[2], 0.01 / inertia, 1e-7);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_held_fast_carries_whatever_it_weighs, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double held : {1e-12, 1e-6, 1.0, 1e6})
        for (const double carried : {1e-3, 1e3, 1e9}) {
            auto sim = simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>(-g * up<Dim>()), false);
            auto& system = sim.system();
            const auto ball = system.add(talus::Ball<Dim>(0.01),
                                         talus::Inertia<Dim>{held, W<Dim>::Constant(held)}, {});
            system.bodies.lock(ball, talus::LockedAxes<Dim>::all());
            const auto box = system.add(talus::Box<Dim>(V<Dim>::Constant(0.1)),
                                        talus::Inertia<Dim>{carried, W<Dim>::Constant(carried)},
                                        {0.11 * up<Dim>(), {}});
            BOOST_TEST(sim.run(0.1).certified());
            BOOST_TEST(std::abs(system.bodies.velocity[box][Dim - 1]) < 1e-6);
        }
}

BOOST_AUTO_TEST_CASE(work_about_the_axes_that_turn_is_booked) {
    auto sim = simulation<3>(law<3>(0.0), 1e-3, V<3>::Zero(), false);
    auto& system = sim.system();
    const double never = std::numeric_limits<double>::infinity();
    const auto rotation = talus::Rotation<3>::exp(W<3>(0.3, -0.8, 0.5));
    const auto top =
        system.add(talus::Ball<3>(0.1), talus::Inertia<3>{1.0, W<3>(2.0, never, never)},
                   {V<3>::Zero(), rotation});
    system.forces.push_back([&](double, const auto& bodies, auto wrenches) {
        // 4 N m about the axis that turns, and as much across, to no effect.
        wrenches[0].torque = bodies.rotation[top] * W<3>(4.0, 4.0, -4.0);
    });
    talus::EnergyLedger<3> books(system.bodies, system.gravity);
    for (int k = 0; k < 1000; ++k) {
        sim.step();
        books.record(sim.data(), system.bodies);
    }
    BOOST_CHECK_CLOSE(system.bodies.spin[top][0], 2.0, 1e-9);
    BOOST_CHECK_CLOSE(books.flows().applied, 4.0, 1e-9);
    BOOST_TEST(books.closure() < 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_cannot_be_driven_is_refused_by_the_step, D, dimensions) {
    constexpr int Dim = D::value;
    for (const int which : {0, 1, 2}) {
        auto sim = simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>::Zero(), false);
        auto& system = sim.system();
        system.add_obstacle(talus::Ball<Dim>(0.1));
        system.add(talus::Ball<Dim>(0.1), 1000.0, {V<Dim>(up<Dim>()), {}});
        const talus::BodyId driven = which == 0   ? system.bodies.id[0]
                                     : which == 1 ? talus::BodyId{7}
                                                  : talus::BodyId{};
        system.forces.push_back(
            talus::servo<Dim>(driven, {.force = [](double, const auto&) { return 1.0; }}));
        BOOST_CHECK_THROW(sim.step(), talus::input_error);
        system.forces.clear();
        // An obstacle that was given a mass would be moved by impulses and put back.
        system.bodies.inverse_mass[0] = 1.0;
        BOOST_CHECK_THROW(sim.step(), talus::input_error);
        system.bodies.inverse_mass[0] = 0.0;
        BOOST_CHECK_NO_THROW(sim.step());
        BOOST_CHECK_THROW(system.ignored.insert({-1}, {0}), talus::input_error);
        BOOST_CHECK_THROW(system.ignored.insert({1}, {1}), talus::input_error);
    }
}

BOOST_AUTO_TEST_CASE(a_top_on_a_rail_keeps_its_angular_momentum) {
    auto sim = simulation<3>(law<3>(0.0), 1e-3, V<3>::Zero(), false);
    auto& bodies = sim.system().bodies;
    const W<3> moments(1.0, 2.0, 2.5), spin(1.0, 2.0, 0.5);
    const auto top = sim.system().add(talus::Ball<3>(0.1), talus::Inertia<3>{1.0, moments}, {},
                                      {V<3>::Zero(), spin});
    talus::LockedAxes<3> rail;
    rail.translation.fill(true);
    bodies.lock(top, rail);
    BOOST_TEST(sim.run(2.0).certified());
    const W<3> momentum = bodies.rotation[top] * W<3>(moments.cwiseProduct(bodies.spin[top]));
    BOOST_TEST((momentum - moments.cwiseProduct(spin)).norm() < 1e-9);
    BOOST_TEST(sim.data().end[top].linear.is_zero());
}

/// Hung on a pin.
template <int Dim>
struct Pinned : talus::SimulationTypes<Dim> {
    using Law = talus::Bilateral<Dim>;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_pin_holds_a_body_on_a_rail_across_it, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim, Pinned<Dim>> sim(talus::Bilateral<Dim>{}, {.h = 1e-3});
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    system.add_obstacle(talus::Ball<Dim>(0.1));
    const auto body = system.add(talus::Ball<Dim>(0.1), 1000.0, {V<Dim>(0.2 * x_axis<Dim>()), {}});
    // The normal is along the locked axis; what hangs is held by the tangents.
    auto rail = talus::LockedAxes<Dim>::all_but_translation(Dim - 1);
    system.bodies.lock(body, rail);
    for (int k = 0; k < 50; ++k) sim.step();
    BOOST_TEST(std::abs(system.bodies.position[body][Dim - 1]) < 1e-6);
}

/// With the law for which talus::compiled has all solvers.
template <int Dim>
struct AnySolverTypes : talus::SimulationTypes<Dim> {
    using Law = talus::Coulomb<Dim>;
    using Solver = talus::AnySolver<Dim, Law>;
};

/// A piston on a box that stands on the floor, between walls that it touches.
template <int Dim>
void a_piston_hands_its_load_on(typename AnySolverTypes<Dim>::Solver solver) {
    talus::Simulation<Dim, AnySolverTypes<Dim>> sim(talus::Coulomb<Dim>{.mu = 0.3}, {.h = 1e-3},
                                                    std::move(solver));
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    const auto floor = system.add_obstacle(talus::HalfSpace<Dim>(up<Dim>(), 0.0));
    system.add_obstacle(talus::HalfSpace<Dim>(x_axis<Dim>(), -0.5));
    system.add_obstacle(talus::HalfSpace<Dim>(-x_axis<Dim>(), -0.5));
    const auto box =
        system.add(talus::Box<Dim>(V<Dim>::Constant(0.2)), 1000.0, {V<Dim>(0.2 * up<Dim>()), {}});
    const auto piston =
        system.add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 100.0, {V<Dim>(0.9 * up<Dim>()), {}});
    system.bodies.lock(piston, talus::LockedAxes<Dim>::all_but_translation(Dim - 1));
    const double load = 500.0;
    system.forces.push_back(talus::servo<Dim>(
        system.bodies.id[piston],
        {.direction = -up<Dim>(), .force = [=](double, const auto&) { return load; }}));
    const talus::RunSummary run = sim.run(0.2);
    BOOST_TEST(run.certified(), to_string(run));
    const double weights = g * (system.bodies.mass(box) + system.bodies.mass(piston));
    const V<Dim> push = talus::wrench_impulse_on(sim.data(), floor).force / sim.params().h;
    BOOST_CHECK_CLOSE(-push[Dim - 1], weights + load, 0.1);
    BOOST_TEST(std::abs(system.bodies.position[piston][Dim - 1] - 0.9) < 1e-5);
    BOOST_TEST(!talus::touches(sim.data(), 1, piston));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_solver_bears_a_piston, D, dimensions) {
    constexpr int Dim = D::value;
    using Law = talus::Coulomb<Dim>;
    for (const talus::SolverName& name : talus::solver_names<Dim, Law>()) {
        if (name.name == "enumeration") continue;  // for the smallest problems
        BOOST_TEST_CONTEXT(name.name) {
            a_piston_hands_its_load_on<Dim>(
                talus::make_solver<Dim, Law>(name.name, {.tolerance = 1e-6}));
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_servo_wall_reaches_its_pressure, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(4, 4, law<Dim>(0.2), 2e-3);
    BOOST_TEST(sim.run(0.4).certified());
    auto& system = sim.system();
    // A lid of no extent of its own: a half-space that may move up and down.
    const auto lid =
        system.add(talus::HalfSpace<Dim>(-up<Dim>(), 0.0),
                   talus::Inertia<Dim>{5.0, W<Dim>::Constant(1.0)}, {V<Dim>(1.0 * up<Dim>()), {}});
    system.bodies.lock(lid, talus::LockedAxes<Dim>::all_but_translation(Dim - 1));
    const double load = 2e3;
    talus::ServoParams<Dim> params{.direction = -up<Dim>(),
                                   .force = [=](double, const auto&) { return load; },
                                   .damping = 20.0,
                                   .top_speed = 0.5};
    const talus::BodyId name = system.bodies.id[lid];
    system.forces.push_back(talus::servo<Dim>(name, params));
    double fastest = 0.0;
    BOOST_TEST(sim.run(2.0,
                       [&](const auto& s) {
                           fastest = std::max(fastest, s.system().bodies.velocity[lid].norm());
                       })
                   .certified());
    BOOST_TEST(fastest > 0.3);
    // It accelerates by load / mass and gravity for one step beyond its top speed at most.
    BOOST_TEST(fastest < 0.5 + 2e-3 * (load / 5.0 + g) + g * 1.0);
    const V<Dim> on_lid = talus::wrench_impulse_on(sim.data(), lid).force / sim.params().h;
    BOOST_CHECK_CLOSE(on_lid[Dim - 1], load + 5.0 * g, 1.0);
    system.remove(name);
    BOOST_TEST(sim.run(0.01).certified());  // a servo of nobody does nothing

    for (auto change : {+[](talus::ServoParams<Dim>& p) { p.damping = -1.0; },
                        +[](talus::ServoParams<Dim>& p) { p.direction = V<Dim>::Zero(); },
                        +[](talus::ServoParams<Dim>& p) { p.top_speed = 0.0; },
                        +[](talus::ServoParams<Dim>& p) { p.limit = std::nan(""); },
                        +[](talus::ServoParams<Dim>& p) { p.force = nullptr; }}) {
        talus::ServoParams<Dim> bad = params;
        change(bad);
        BOOST_CHECK_THROW(talus::servo<Dim>(name, bad), talus::input_error);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(locks_that_cannot_be_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>::Zero());
    auto& bodies = sim.system().bodies;
    const auto ball = sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {V<Dim>(up<Dim>()), {}},
                                       {V<Dim>(x_axis<Dim>()), W<Dim>::Constant(1.0)});
    using Locked = talus::LockedAxes<Dim>;
    BOOST_CHECK_THROW(bodies.lock(0, Locked::all()), talus::input_error);  // an obstacle
    BOOST_CHECK_THROW(bodies.lock(7, Locked::all()), talus::input_error);
    BOOST_CHECK_THROW(bodies.lock(ball, Locked::rotations()), talus::input_error);  // it turns
    BOOST_CHECK_THROW(bodies.lock(ball, Locked::all()), talus::input_error);
    BOOST_CHECK_THROW(Locked::all_but_translation(Dim), talus::input_error);
    BOOST_CHECK_THROW(Locked::all_but_rotation(-1), talus::input_error);
    if constexpr (Dim == 3) {
        Locked one;
        one.rotation[0] = true;
        bodies.spin[ball].setZero();
        BOOST_CHECK_THROW(bodies.lock(ball, one), talus::input_error);
    }
    BOOST_TEST(!bodies.locked[ball].any());
    bodies.spin[ball].setZero();
    bodies.lock(ball, Locked::all_but_translation(0));
    sim.step();
    bodies.velocity[ball][1] = 1.0;
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(groups_and_pairs_that_do_not_meet_pass_through, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.3), 1e-3, V<Dim>(-g * up<Dim>()));
    auto& system = sim.system();
    // Four balls in a row fall onto the floor, each overlapping the next by half.
    std::vector<talus::BodyIndex> balls;
    for (int k = 0; k < 4; ++k)
        balls.push_back(system.add(talus::Ball<Dim>(0.1), 1000.0,
                                   {V<Dim>(0.1 * k * x_axis<Dim>() + 0.101 * up<Dim>()), {}}));
    system.ignored.insert(system.bodies.id[balls[1]], system.bodies.id[balls[0]]);
    system.bodies.groups[balls[2]] = {.member = 2, .meets = 1 | 4};
    system.bodies.groups[balls[3]] = {.member = 2, .meets = 1 | 4};
    for (int k = 0; k < 30; ++k) sim.step();
    const auto touch = [&](std::size_t i, std::size_t j) {
        return talus::touches(sim.data(), balls[i], balls[j]);
    };
    BOOST_TEST(!touch(0, 1));  // a pair ignored
    BOOST_TEST(touch(1, 2));   // group 1 meets group 2
    BOOST_TEST(!touch(2, 3));  // group 2 does not meet itself
    for (const auto ball : balls) BOOST_TEST(talus::touches(sim.data(), 0, ball));
    // What is changed is noticed at the next step.
    system.bodies.groups[balls[3]] = {};
    system.ignored.erase(system.bodies.id[balls[0]], system.bodies.id[balls[1]]);
    sim.step();
    BOOST_TEST(touch(0, 1));
    BOOST_TEST(touch(2, 3));
    system.ignored.insert(system.bodies.id[balls[0]], system.bodies.id[balls[1]]);
    system.remove(system.bodies.id[balls[0]]);
    BOOST_TEST(system.ignored.empty());
}

BOOST_AUTO_TEST_SUITE_END()
