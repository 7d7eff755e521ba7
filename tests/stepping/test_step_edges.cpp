// SPDX-License-Identifier: BSL-1.0
// Where a step borders on what is not the step: obstacles that move, copies taken within it, its
// two halves, laws that pull, states at the end of numbers.
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/stepping/equilibrium.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "experiment.hpp"

using namespace experiment;

BOOST_AUTO_TEST_SUITE(stepping_step_edges)

template <int Dim>
talus::Simulation<Dim> with_floor(double mu, talus::PrescribedMotion<Dim> motion,
                                  talus::SimulationParams params = {}) {
    talus::Simulation<Dim> sim(law<Dim>(mu), params);
    sim.system().gravity = -g * up<Dim>();
    sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0}, std::move(motion));
    return sim;
}
template <int Dim>
talus::BodyIndex add_box(talus::Simulation<Dim>& sim, double height) {
    return sim.system().add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1000.0,
                            {(height + 0.5) * up<Dim>(), {}});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_equilibrium_test_knows_obstacles_that_move, D, dimensions) {
    constexpr int Dim = D::value;
    const auto belt = talus::PrescribedMotion<Dim>::belt({}, {V<Dim>::Unit(0), W<Dim>::Zero()});
    auto smooth = with_floor<Dim>(0.0, belt), rough = with_floor<Dim>(0.5, belt);
    add_box(smooth, 0.0);
    add_box(rough, 0.0);
    BOOST_TEST(to_string(talus::equilibrium(smooth.system()).verdict) == "equilibrium");
    BOOST_TEST(to_string(talus::equilibrium(rough.system()).verdict) == "moving");
    // Raised by a metre in the first second: what stands on it stands where it is then.
    auto raised = with_floor<Dim>(
        0.5,
        talus::PrescribedMotion<Dim>::of_displacements({}, {0.0, 1.0}, {V<Dim>::Zero(), up<Dim>()}),
        {.h = 1e-2});
    BOOST_TEST(raised.run(2.0).certified());
    add_box(raised, 1.0);
    BOOST_TEST(to_string(talus::equilibrium(raised.system()).verdict) == "equilibrium");
    BOOST_TEST(raised.system().time() == 2.0, boost::test_tools::tolerance(1e-12));
}

// Columns of balls that are not solved well tell nothing of a ball in the air.
BOOST_AUTO_TEST_CASE_TEMPLATE(errors_elsewhere_do_not_hide_what_falls, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = with_floor<Dim>(0.5, {});
    for (int column = 0; column < 12; ++column)
        for (int k = 0; k < 12; ++k)
            sim.system().add(talus::Ball<Dim>(0.1), 1000.0,
                             {0.5 * column * V<Dim>::Unit(0) + (0.2 * k + 0.1) * up<Dim>(), {}});
    const auto verdict = [&] {
        return talus::equilibrium<Dim>(sim.system(), {},
                                       talus::GaussSeidel<Dim, talus::DefaultLaw<Dim>>(
                                           {.max_sweeps = 2000, .tolerance = 3e-4}));
    };
    const auto standing = verdict();
    BOOST_TEST(to_string(standing.verdict) == "undecided");
    BOOST_TEST(standing.data.report.contact_error > 1e-4);
    sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {-3.0 * V<Dim>::Unit(0) + up<Dim>(), {}});
    BOOST_TEST(to_string(verdict().verdict) == "moving");
}

/// Takes a copy of the system whenever it is called, as observers may.
struct Copies : talus::NoHooks {
    int taken = 0;
    std::string verdict;

    void at_midpoint(auto& system, auto&) { take(system); }
    void finished(auto& system, auto&) {
        take(system);
        verdict = to_string(talus::equilibrium(system).verdict);
    }
    template <int Dim, class Law, class Shape>
    void take(const talus::System<Dim, Law, Shape>& system) {
        auto copy = system;
        copy.add(talus::Ball<Dim>(0.1), 1000.0, {9.0 * up<Dim>(), {}});
        copy.set_shape(1, talus::Ball<Dim>(0.2));
        ++taken;
    }
};
template <int Dim>
struct Copying : talus::SimulationTypes<Dim> {
    using Hooks = Copies;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_copy_of_a_system_is_in_no_step, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim, Copying<Dim>> sim(law<Dim>(0.5));
    sim.system().gravity = -g * up<Dim>();
    sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    sim.system().add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1000.0, {0.5 * up<Dim>(), {}});
    sim.step();
    BOOST_TEST(sim.hooks().taken == 2);
    BOOST_TEST(sim.hooks().verdict == "equilibrium");
    BOOST_TEST(sim.system().bodies.count() == 2u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(short_of_the_aim_is_a_word_on_the_last_solve, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = with_floor<Dim>(0.5, {});
    for (int k = 0; k < 30; ++k)
        sim.system().add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1000.0,
                         {(k + 0.5) * up<Dim>(), {}});
    sim.solver().params.tolerance = 1e-2;
    sim.solver().params.aim = 1e-12;
    sim.solver().params.effort = 0.0;
    sim.step();
    BOOST_TEST(sim.data().report.short_of_aim);
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        if (!sim.system().bodies.is_obstacle(i)) sim.system().bodies.position[i] += 5.0 * up<Dim>();
    sim.system().gravity.setZero();
    for (auto& v : sim.system().bodies.velocity) v.setZero();
    for (auto& w : sim.system().bodies.spin) w.setZero();
    for (std::size_t i = 1; i < sim.system().bodies.count(); ++i)
        sim.system().bodies.position[i] = 3.0 * static_cast<double>(i) * up<Dim>();
    sim.step();
    BOOST_TEST(sim.data().contact_count() == 0u);
    BOOST_TEST(!sim.data().report.short_of_aim);
}

template <int Dim, class L>
struct Of : talus::SimulationTypes<Dim> {
    using Law = L;
};
/// Two balls of radius 0.1 on the first axis, `gap` apart, the second one coming at `speed`.
template <int Dim, class L>
talus::Simulation<Dim, Of<Dim, L>> two_balls(const L& contact_law, double gap, double speed,
                                             const talus::SimulationParams& params) {
    talus::Simulation<Dim, Of<Dim, L>> sim(contact_law, params);
    for (const double x : {0.0, 0.2 + gap})
        sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {x * V<Dim>::Unit(0), {}},
                         {(x > 0.0 ? -speed : 0.0) * V<Dim>::Unit(0), W<Dim>::Zero()});
    return sim;
}

// A gap that counts as closed by rounding is no way for a pin to go.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_pin_is_held_as_it_is, D, dimensions) {
    constexpr int Dim = D::value;
    using Pin = talus::Bilateral<Dim>;
    using Any = talus::AnyLaw<Dim, talus::Coulomb<Dim>, Pin>;
    const auto speed_after_a_step = [](auto sim) {
        sim.step();
        BOOST_TEST(sim.data().contact_count() == 1u);
        return sim.system().bodies.velocity[1].norm();
    };
    for (const auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        const talus::SimulationParams params{.h = 1e-6, .step = {.scheme = scheme}};
        BOOST_TEST(speed_after_a_step(two_balls<Dim>(Pin{}, 5e-7, 0.0, params)) <= 1e-15);
        BOOST_TEST(speed_after_a_step(two_balls<Dim>(Any{Pin{}}, 5e-7, 0.0, params)) <= 1e-15);
    }
}

// Cohesion is of bodies in touch: what is on its way is not drawn nearer.
BOOST_AUTO_TEST_CASE_TEMPLATE(cohesion_does_not_reach_across_a_gap, D, dimensions) {
    constexpr int Dim = D::value;
    using Sticky = talus::CohesiveCoulomb<Dim>;
    auto sim = two_balls<Dim>(Sticky{{0.3}, 0.5}, 1e-3, 0.15,
                              {.h = 1e-2, .step = {.scheme = talus::Scheme::gap_anticipating}});
    sim.step();
    BOOST_TEST(sim.system().bodies.velocity[1][0] == -0.15);
    for (int k = 0; k < 5; ++k) sim.step();
    BOOST_TEST((sim.system().bodies.velocity[1] - sim.system().bodies.velocity[0]).norm() <= 1e-4);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_that_a_force_adds_are_taken_off_again, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = with_floor<Dim>(0.5, {});
    add_box(sim, 0.0);
    bool adds = true;
    sim.system().forces.push_back([&](double, const auto&, auto) {
        if (adds) sim.system().bodies.add(round_inertia<Dim>(7.0, 1.0), {});
    });
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    adds = false;
    const auto& bodies = sim.system().bodies;
    BOOST_TEST(bodies.count() == 2u);
    BOOST_TEST(bodies.inverse_mass.size() == 2u);
    BOOST_TEST(bodies.inverse_inertia.size() == 2u);
    BOOST_TEST(bodies.material.size() == 2u);
    const auto next = sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {5.0 * up<Dim>(), {}});
    BOOST_TEST(bodies.mass(next) < 40.0);
    sim.step();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(between_its_halves_a_step_is_under_way, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = with_floor<Dim>(0.5, {});
    add_box(sim, 0.0);
    auto& system = sim.system();
    using Law = talus::DefaultLaw<Dim>;
    talus::MoreauMidpoint<Dim, Law, talus::AnyShape<Dim>, talus::HierarchicalGrid<Dim>> step;
    talus::StepData<Dim, Law> data;
    const auto add = [&] { system.add(talus::Ball<Dim>(0.1), 1000.0, {5.0 * up<Dim>(), {}}); };
    const V<Dim> before = system.bodies.position[1];
    step.pose_problem(system, 0.0, 1e-3, {}, data);
    BOOST_CHECK_THROW(add(), talus::input_error);
    BOOST_CHECK_THROW(step.pose_problem(system, 0.0, 1e-3, {}, data), talus::input_error);
    step.undo(system);
    add();
    BOOST_TEST((system.bodies.position[1] == before));
    step.pose_problem(system, 0.0, 1e-3, {}, data);
    data.report = sim.solver().solve(data.problem, data.impulse);
    step.complete(system, data);
    add();
}

BOOST_AUTO_TEST_CASE(a_step_that_ends_with_no_orientation_is_none) {
    auto sim = with_floor<3>(0.5, {});
    const auto box = add_box(sim, 5.0);
    sim.system().bodies.spin[box] = W<3>(1e200, 1e200, 0.0);
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    BOOST_TEST((sim.system().bodies.spin[box] == W<3>(1e200, 1e200, 0.0)));
    sim.system().bodies.spin[box].setZero();
    sim.step();
    BOOST_TEST(sim.system().bodies.rotation[box].matrix().allFinite());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(obstacles_may_be_listed_in_another_order, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = with_floor<Dim>(0.5, {});
    sim.system().add_obstacle(talus::Ball<Dim>(1.0), talus::Pose<Dim>{5.0 * up<Dim>(), {}});
    sim.step();
    std::swap(sim.system().obstacles[0], sim.system().obstacles[1]);
    sim.step();
    sim.system().bodies.position[1] += up<Dim>();
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
}

// A shape without thickness is judged by its size.
template <int Dim>
struct Rod {
    V<Dim> half = 0.5 * V<Dim>::Unit(0);
    V<Dim> support(const V<Dim>& d) const { return d[0] < 0.0 ? V<Dim>(-half) : half; }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        const V<Dim> reach = pose.rotation.matrix().cwiseAbs() * half;
        return {pose.position - reach, pose.position + reach};
    }
};
template <int Dim>
struct Rods : talus::SimulationTypes<Dim> {
    using Shape = talus::AnyShapeOf<Dim, Rod<Dim>, talus::HalfSpace<Dim>>;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_rod_without_thickness_is_certified_by_its_length, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim, Rods<Dim>> sim(law<Dim>(0.5));
    sim.system().gravity = -g * up<Dim>();
    sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    sim.system().add(Rod<Dim>{}, round_inertia<Dim>(1.0, 0.3), {0.01 * up<Dim>(), {}});
    const talus::RunSummary run = sim.run(0.2);
    BOOST_TEST(run.certified(), to_string(run));
    BOOST_TEST(run.overlap.value > 0.0);
    BOOST_TEST(sim.system().half_thickness()[1] == 0.5);
}

// (erincatto/box3d#134) A second simulation of a system that another one has led to a later time.
BOOST_AUTO_TEST_CASE_TEMPLATE(the_clock_begins_where_the_system_is, D, dimensions) {
    constexpr int Dim = D::value;
    auto coarse = with_floor<Dim>(
        0.5, talus::PrescribedMotion<Dim>::uniform({}, {0.25 * up<Dim>(), W<Dim>::Zero()}),
        {.h = 1e-3});
    const auto rider = add_box(coarse, 0.0);
    coarse.system().bodies.velocity[rider] = 0.25 * up<Dim>();
    BOOST_TEST(coarse.run(1.0).certified());
    talus::Simulation<Dim> fine(coarse.system(), {.h = 1e-4});
    BOOST_TEST(fine.time() == coarse.time());
    BOOST_TEST(fine.run(0.1).certified());
    BOOST_TEST(std::abs(fine.time() - 1.1) <= 1e-12);
    BOOST_TEST(std::abs(fine.system().bodies.position[0][Dim - 1] - 0.275) <= 1e-12);
    BOOST_TEST(std::abs(fine.system().bodies.position[rider][Dim - 1] - 0.775) <= 1e-5);
}

template <int Dim>
std::string refusal(talus::Simulation<Dim> sim) {
    try {
        sim.step();
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return "none";
}

// (schteppe/cannon.js#317) A moving body made static by hand would go on pushing.
BOOST_AUTO_TEST_CASE_TEMPLATE(what_has_no_mass_and_no_motion_stands_still, D, dimensions) {
    constexpr int Dim = D::value;
    const auto refusal_of = [](auto change) {
        auto sim = with_floor<Dim>(0.5, talus::Pose<Dim>{});
        const auto box = static_cast<std::size_t>(add_box(sim, 0.0));
        change(sim.system(), box);
        return refusal(sim);
    };
    const auto make_static = [](auto& system, std::size_t i) {
        system.bodies.inverse_mass[i] = 0.0;
        system.bodies.inverse_inertia[i].setZero();
    };
    BOOST_TEST(refusal_of(make_static) == "none");
    BOOST_TEST(refusal_of([&](auto& system, std::size_t i) {
                   make_static(system, i);
                   system.bodies.velocity[i] = 2.0 * V<Dim>::Unit(0);
               }).find("velocity of body 1 is 2, but must be 0") == 0u);
    BOOST_TEST(refusal_of([&](auto& system, std::size_t i) {
                   system.bodies.inverse_mass[i] = 0.0;
               }).find("inverse moment of inertia of body 1 is ") == 0u);
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
        BOOST_TEST(refusal_of([&](auto& system, std::size_t i) {
                       system.bodies.inverse_mass[i] = bad;
                   }).find("inverse mass of body 1 is ") == 0u);
        BOOST_TEST(refusal_of([&](auto& system, std::size_t i) {
                       system.bodies.inverse_inertia[i][0] = bad;
                   }).find("inverse moment of inertia of body 1 is ") == 0u);
    }
    BOOST_TEST(refusal_of([](auto& system, std::size_t i) {
                   system.bodies.position[i][0] = std::numeric_limits<double>::quiet_NaN();
               }).find("position of body 1[0] is nan") == 0u);
}

// (google-deepmind/mujoco#2573) 0/0 on the axis: an own shape that gives no number is named.
template <int Dim>
struct Lost : Rod<Dim> {
    V<Dim> support(const V<Dim>& d) const {
        return Rod<Dim>::support(d) * (d[0] == 0.0 ? std::sqrt(-1.0) : 1.0);
    }
};
template <int Dim>
struct LostOnes : talus::SimulationTypes<Dim> {
    using Shape = talus::AnyShapeOf<Dim, Lost<Dim>, talus::HalfSpace<Dim>, talus::Box<Dim>>;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(supports_that_are_no_numbers_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    for (const bool flat : {true, false}) {
        talus::Simulation<Dim, LostOnes<Dim>> sim(law<Dim>(0.5));
        if (flat)
            sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
        else
            sim.system().add_obstacle(talus::Box<Dim>(V<Dim>::Constant(1.0)),
                                      talus::Pose<Dim>{-up<Dim>(), {}});
        sim.system().add(Lost<Dim>{}, round_inertia<Dim>(1.0, 0.3), {});
        std::string said = "none";
        try {
            sim.step();
        } catch (const talus::input_error& error) {
            said = error.what();
        }
        BOOST_TEST(said.find("bodies 0 and 1: support of a shape along (") == 0u, said);
    }
}

// (avianphysics/avian#990) What is anticipated is what the motion leads to: nothing for bodies that
// pass each other, round ones too, and the side where they meet for those that do not.
BOOST_AUTO_TEST_CASE_TEMPLATE(round_bodies_that_pass_each_other_are_not_deflected, D, dimensions) {
    constexpr int Dim = D::value;
    const double r = 0.01, v = 10.0;
    const auto end_velocity = [&](const auto& obstacle, double height, int part, double h) {
        talus::Simulation<Dim> sim(law<Dim>(0.5),
                                   {.h = h, .step = {.scheme = talus::Scheme::gap_anticipating}});
        sim.system().add_obstacle(obstacle, talus::Pose<Dim>{});
        const V<Dim> start = (-0.2 + part * v * h / 8) * V<Dim>::Unit(0) + height * up<Dim>();
        const auto ball = sim.system().add(talus::Ball<Dim>(r), 1000.0, {start, {}},
                                           {v * V<Dim>::Unit(0), W<Dim>::Zero()});
        BOOST_TEST(sim.run(0.5 / v).certified());
        return V<Dim>(sim.system().bodies.velocity[ball] - v * V<Dim>::Unit(0));
    };
    for (const double h : {5e-4, 1e-3, 2e-3})
        for (int part = 0; part < 8; ++part) {
            const double clear = 2.0 * r + 2e-4;
            BOOST_TEST(end_velocity(talus::Ball<Dim>(r), clear, part, h).isZero(0.0));
            BOOST_TEST(end_velocity(talus::Capsule<Dim>(2 * r, r), clear, part, h).isZero(0.0));
            // One that hits is deflected.
            BOOST_TEST(end_velocity(talus::Ball<Dim>(r), 1.5 * r, part, h).norm() > 1.0);
        }
}

BOOST_AUTO_TEST_CASE(a_run_of_no_step_claims_nothing) {
    auto sim = with_floor<2>(0.5, {});
    BOOST_TEST(to_string(sim.run(0.0)) == "no step was made");
}

BOOST_AUTO_TEST_SUITE_END()
