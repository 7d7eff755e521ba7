// SPDX-License-Identifier: BSL-1.0
// Motions that other libraries were reported to get wrong: impacts, sliding, rolling, spinning.
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/momentum.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "common/dimensions.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(reports_motion)

using namespace experiment;

using V3 = talus::Vector<3>;
using talus::Box;

template <class Sim>
double energy(const Sim& sim) {
    return talus::kinetic_energy(sim.system().bodies) +
           talus::potential_energy(sim.system().bodies, sim.system().gravity);
}

/// A row of balls of radius `r` along axis 0, without friction and gravity.
template <int Dim>
auto row(const std::vector<double>& x, const std::vector<double>& v, double r, double h) {
    auto sim = simulation<Dim>(law<Dim>(0.0, 1.0), h, V<Dim>::Zero(), false);
    for (std::size_t i = 0; i < x.size(); ++i)
        sim.system().add(talus::Ball<Dim>(r), 1000.0, {x[i] * V<Dim>::Unit(0), {}},
                         {v[i] * V<Dim>::Unit(0), {}});
    return sim;
}

// dimforge/rapier#97, erincatto/box2d#167, erincatto/box2d#76, jrouwe/JoltPhysics#1286,
// bulletphysics/bullet3#1530, liabru/matter-js#13, piqnt/planck.js#223
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_that_bounces_back_keeps_its_energy, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double height : {0.3, 1.0, 10.0}) {
        auto sim = simulation<Dim>(law<Dim>(0.2, 1.0), 1e-3, -g * up<Dim>(), false);
        sim.system().add_obstacle(Box<Dim>(V<Dim>::Constant(5.0)),
                                  talus::Pose<Dim>{-5.0 * up<Dim>(), {}});
        sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {(0.1 + height) * up<Dim>(), {}});
        const double begin = energy(sim);
        double highest = 0.0;
        for (int k = 0; k < 10000; ++k) {
            sim.step();
            if (k > 4000) highest = std::max(highest, sim.system().bodies.position[1][Dim - 1]);
        }
        BOOST_CHECK_CLOSE(energy(sim), begin, 1e-9);
        // The highest of all steps is at most g h^2 / 8 below the top of the parabola.
        BOOST_CHECK_SMALL(highest - (0.1 + height), g * 1e-6);
    }
}

// dimforge/rapier#974
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_leaves_with_restitution_times_its_speed, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double e : {0.0, 0.3, 0.5, 0.8, 0.95}) {
        const double h = 1e-4;
        auto sim = simulation<Dim>(law<Dim>(0.2, e), h, -g * up<Dim>());
        sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {2.1 * up<Dim>(), {}});
        double before = 0.0;
        while (sim.system().bodies.velocity[1][Dim - 1] <= 0.0 && sim.time() < 0.7) {
            before = sim.system().bodies.velocity[1][Dim - 1];
            sim.step();
            if (sim.data().contact_count() > 0) break;
        }
        BOOST_CHECK_SMALL(sim.system().bodies.velocity[1][Dim - 1] + e * before, 1e-11);
        const double fall = std::sqrt(2 * g * 2.0);
        BOOST_CHECK_SMALL(before + fall, 2 * g * h);
    }
}

// keenon/nimblephysics#143
BOOST_AUTO_TEST_CASE_TEMPLATE(two_balls_and_a_wall_keep_their_energy, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double gap : {0.01, 0.0}) {
        auto sim = row<Dim>({1.0 - 0.2 - 2 * gap, 1.0 - gap}, {2.0, 0.0}, 0.1, 1e-2);
        sim.system().add_obstacle(talus::HalfSpace<Dim>{-V<Dim>::Unit(0), -1.1});
        const double begin = energy(sim);
        for (int k = 0; k < 20; ++k) {
            sim.step();
            BOOST_CHECK_CLOSE(energy(sim), begin, 1e-10);
        }
        const auto& v = sim.system().bodies.velocity;
        BOOST_CHECK_SMALL(v[0][0] + 2.0, 1e-12);
        BOOST_CHECK_SMALL(v[1][0], 1e-12);
    }
}

// xissburg/edyn#49
BOOST_AUTO_TEST_CASE_TEMPLATE(in_a_cradle_only_the_last_ball_leaves, D, dimensions) {
    constexpr int Dim = D::value;
    std::vector<double> x{-0.3}, v{1.0};
    for (int i = 0; i < 5; ++i) x.push_back(0.201 * i), v.push_back(0.0);
    auto sim = row<Dim>(x, v, 0.1, 1e-3);
    for (int k = 0; k < 300; ++k) sim.step();
    for (std::size_t i = 0; i < 6; ++i)
        BOOST_CHECK_SMALL(sim.system().bodies.velocity[i][0] - (i == 5 ? 1.0 : 0.0), 1e-11);
}

// jrouwe/JoltPhysics#1403, DanielChappuis/reactphysics3d#96
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_gives_its_speed_to_one_at_rest, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = row<Dim>({2.8, 4.0}, {1.0, 0.0}, 0.5, 1.0 / 60);
    for (int k = 0; k < 60; ++k) sim.step();
    BOOST_CHECK_SMALL(sim.system().bodies.velocity[0][0], 1e-12);
    BOOST_CHECK_SMALL(sim.system().bodies.velocity[1][0] - 1.0, 1e-12);
}

// godotengine/godot#29639, gama-platform/gama#556
BOOST_AUTO_TEST_CASE(balls_in_a_box_neither_gain_nor_lose_energy) {
    auto sim = simulation<2>(law<2>(0.0, 1.0), 1e-3, V<2>::Zero(), false);
    for (const double side : {-1.0, 1.0})
        for (int axis = 0; axis < 2; ++axis)
            sim.system().add_obstacle(talus::HalfSpace<2>{-side * V<2>::Unit(axis), -1.0});
    for (int i = 0; i < 20; ++i)
        sim.system().add(talus::Ball<2>(0.12), 1000.0,
                         {{-0.75 + 0.37 * (i % 5), -0.6 + 0.4 * (i / 5)}, {}},
                         {V<2>(std::sin(7.0 * i), std::cos(5.0 * i)), {}});
    const double begin = energy(sim);
    int impacts = 0;
    for (int k = 0; k < 5000; ++k) impacts += sim.step().contact_count() > 0 ? 1 : 0;
    BOOST_TEST(impacts > 300);
    BOOST_CHECK_CLOSE(energy(sim), begin, 1e-8);
}

// erincatto/box3d#83
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_on_a_smaller_one_bounces_no_higher, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.0, 1.0), 1e-3, -g * up<Dim>(), false);
    sim.system().add_obstacle(Box<Dim>(V<Dim>::Constant(0.375)),
                              talus::Pose<Dim>{-0.375 * up<Dim>(), {}});
    sim.system().add(Box<Dim>(V<Dim>::Constant(0.5)), 1000.0, {1.5 * up<Dim>(), {}});
    const double begin = energy(sim);
    for (int k = 0; k < 3000; ++k) sim.step();
    BOOST_CHECK_CLOSE(energy(sim), begin, 1e-8);
    BOOST_CHECK_SMALL(largest(sim.system().bodies.spin[1]), 1e-9);
}

// newton-physics/newton#1137
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_without_restitution_does_not_bounce, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.5), 1e-3, -g * up<Dim>());
    sim.system().add(Box<Dim>(V<Dim>::Constant(0.1)), 1000.0, {0.1 * up<Dim>(), {}});
    sim.system().add(Box<Dim>(V<Dim>::Constant(0.1)), 1000.0, {0.39 * up<Dim>(), {}});
    for (int k = 0; k < 400; ++k) {
        sim.step();
        BOOST_REQUIRE_LT(sim.system().bodies.velocity[2][Dim - 1], 1e-9);
    }
    BOOST_CHECK_SMALL(largest(sim.system().bodies.velocity[2]), 1e-9);
    BOOST_CHECK_GT(sim.system().bodies.position[2][Dim - 1], 0.3 - 1e-3 * std::sqrt(2 * g * 0.09));
}

// jrouwe/JoltPhysics#2121
BOOST_AUTO_TEST_CASE_TEMPLATE(a_thrown_ball_rolls_at_the_speed_its_momentum_gives, D, dimensions) {
    constexpr int Dim = D::value;
    const auto rolls = [](talus::Scheme scheme, double h, double e) {
        talus::SimulationParams params{.h = h};
        params.step.scheme = scheme;
        talus::Simulation<Dim> sim(law<Dim>(0.3, e), params);
        sim.system().gravity = -g * up<Dim>();
        sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
        sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {1.35 * up<Dim>(), {}},
                         {2.0 * V<Dim>::Unit(0), {}});
        while (sim.time() < 2.0) sim.step();
        const double exact = 2.0 / (1.0 + kap<Dim>);  // 5/7 of 2 m/s in space
        BOOST_CHECK_SMALL(sim.system().bodies.velocity[1][0] - exact, 1e-9);
        BOOST_CHECK_SMALL(largest(sim.system().bodies.spin[1]) - exact / 0.1, 1e-8);
    };
    for (const double h : {1e-3, 3e-4}) {
        rolls(talus::Scheme::gap_anticipating, h, 0.0);
        rolls(talus::Scheme::midpoint, h, 0.0);
        rolls(talus::Scheme::midpoint, h, 0.5);
    }
}

// google/brax#78, chaos-polymtl/lethe#889
BOOST_AUTO_TEST_CASE(a_pushed_capsule_ends_rolling_without_slip) {
    auto sim = simulation<3>(law<3>(0.5), 1e-3, -g * up<3>());
    const talus::Capsule<3> capsule(0.3, 0.1);
    const auto across = talus::Rotation<3>::exp(0.5 * pi * V3::Unit(2));
    sim.system().add(capsule, 1000.0, {0.1 * up<3>(), across}, {V3(1, 0, 0), {}});
    for (int k = 0; k < 1000; ++k) sim.step();
    const auto& bodies = sim.system().bodies;
    const double m = bodies.mass(1), along = bodies.inertia(1).minCoeff();
    const double exact = 1.0 / (1.0 + along / (m * 0.01));
    BOOST_CHECK_SMALL((bodies.velocity[1] - exact * V3::Unit(0)).norm(), 1e-10);
    BOOST_CHECK_SMALL((bodies.twist(1).angular - exact / 0.1 * V3::Unit(1)).norm(), 1e-9);
}

// JamieHegarty/TouchGolf#30
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_rolls_over_seams_of_boxes, D, dimensions) {
    constexpr int Dim = D::value;
    for (const auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        talus::SimulationParams params{.h = 2e-3};
        params.step.scheme = scheme;
        params.step.contact_tolerance = touching;
        talus::Simulation<Dim, Sweeping<Dim>> sim(law<Dim>(0.5), params);
        sim.solver().params.tolerance = 1e-12;
        sim.system().gravity = -g * up<Dim>();
        for (int i = 0; i < 10; ++i)
            sim.system().add_obstacle(Box<Dim>(V<Dim>::Constant(0.5)),
                                      talus::Pose<Dim>{in_plane<Dim>(i, -0.5), {}});
        sim.system().add(talus::Ball<Dim>(0.2), 1000.0, {0.2 * up<Dim>(), {}},
                         {3.0 * V<Dim>::Unit(0), rolling_spin<Dim>(15.0)});
        for (int k = 0; k < 1400; ++k) {
            sim.step();
            BOOST_REQUIRE_SMALL(sim.system().bodies.velocity[10][Dim - 1], 1e-9);
        }
        BOOST_CHECK_SMALL((sim.system().bodies.velocity[10] - 3.0 * V<Dim>::Unit(0)).norm(), 1e-9);
        BOOST_CHECK_SMALL(sim.system().bodies.position[10][Dim - 1] - 0.2, 1e-9);
    }
}

// godotengine/godot#38780
BOOST_AUTO_TEST_CASE(a_box_slides_over_a_needless_corner_of_the_floor) {
    auto sim = simulation<2>(law<2>(0.0), 1e-3, -g * up<2>(), false);
    sim.system().add_obstacle(
        talus::ConvexPolytope<2>({{0.64, -0.64}, {8.32, -0.64}, {8.32, 0}, {5.54, 0}, {0.64, 0}}));
    sim.system().add(Box<2>(V<2>(0.32, 0.32)), 100.0, {{3.5, 0.32}, {}}, {V<2>(2.0, 0.0), {}});
    for (int k = 0; k < 2000; ++k) sim.step();
    BOOST_CHECK_SMALL((sim.system().bodies.position[1] - V<2>(7.5, 0.32)).norm(), 1e-9);
    BOOST_CHECK_SMALL(sim.system().bodies.spin[1][0], 1e-9);
}

// dimforge/rapier#137, Genesis-Embodied-AI/genesis-world#907, bulletphysics/bullet3#2590
BOOST_AUTO_TEST_CASE(friction_is_the_same_in_all_directions) {
    for (int k = 0; k < 12; ++k) {
        const double angle = 0.3 + pi * k / 6.0, mu = 0.4, v = 2.0, h = 1e-3;
        const V3 along(std::cos(angle), std::sin(angle), 0.0);
        auto sim = simulation<3>(law<3>(mu), h, -g * up<3>());
        sim.system().add(Box<3>(V3(0.2, 0.1, 0.05)), 100.0, {0.05 * up<3>(), {}}, {v * along, {}});
        for (int i = 0; i < 700; ++i) sim.step();
        const V3 way = sim.system().bodies.position[1] - 0.05 * up<3>();
        BOOST_CHECK_SMALL((way - way.dot(along) * along).norm(), 1e-9);
        // In the last step the block stops before the end of the step.
        BOOST_CHECK_SMALL(way.dot(along) - v * v / (2 * mu * g), mu * g * h * h);
    }
}

// jrouwe/JoltPhysics#983, Genesis-Embodied-AI/genesis-world#3115
BOOST_AUTO_TEST_CASE_TEMPLATE(a_launched_box_slides_without_tipping_or_turning, D, dimensions) {
    constexpr int Dim = D::value;
    const double mu = 0.5, v = 6.0, h = 5e-3;
    auto sim = simulation<Dim>(law<Dim>(mu), h, -g * up<Dim>());
    sim.system().add(Box<Dim>(V<Dim>::Constant(0.05)), 1000.0, {0.05 * up<Dim>(), {}},
                     {v * V<Dim>::Unit(0), {}});
    for (int k = 0; k < 320; ++k) {
        sim.step();
        BOOST_REQUIRE_SMALL(largest(sim.system().bodies.spin[1]), 1e-8);
    }
    const V<Dim> place = sim.system().bodies.position[1];
    BOOST_CHECK_SMALL(place[0] - v * v / (2 * mu * g), mu * g * h * h);
    BOOST_CHECK_SMALL(place[Dim - 1] - 0.05, 1e-9);
    BOOST_CHECK_SMALL(largest(sim.system().bodies.velocity[1]), 1e-9);
}

// Teardown-Issue-Tracker-Maintainers/Teardown-Issue-Tracker#563
BOOST_AUTO_TEST_CASE(a_ball_that_spins_upright_on_a_point_spins_for_ever) {
    for (const double mu : {0.0, 0.8}) {
        auto sim = simulation<3>(law<3>(mu), 1e-2, -g * up<3>());
        sim.system().add(talus::Ball<3>(0.5), 1000.0, {0.5 * up<3>(), {}},
                         {V3::Zero(), 10.0 * V3::Unit(2)});
        for (int k = 0; k < 2000; ++k) sim.step();
        BOOST_CHECK_SMALL((sim.system().bodies.spin[1] - 10.0 * V3::Unit(2)).norm(), 1e-9);
    }
}

// siconos/siconos#125
BOOST_AUTO_TEST_CASE(a_tumbling_block_takes_the_same_way_each_time) {
    const auto thrown = [] {
        talus::Simulation<3> sim(law<3>(0.4), {.h = 2e-3});
        sim.system().gravity = g * V3(std::sin(0.6), 0.0, -std::cos(0.6));
        sim.system().add_obstacle(talus::HalfSpace<3>{V3::Unit(2), 0.0});
        sim.system().add(Box<3>(V3(0.3, 0.2, 0.1)), 2500.0, {0.8 * up<3>(), {}},
                         {V3(1, 0.2, 0), V3(1, 2, 3)});
        for (int k = 0; k < 1000; ++k) sim.step();
        return sim.system().bodies.position[1];
    };
    const V3 first = thrown();
    for (int k = 0; k < 3; ++k) BOOST_TEST((thrown() == first));
}

// avianphysics/avian#993, google/brax#48
BOOST_AUTO_TEST_CASE(a_free_body_keeps_momentum_and_energy_for_long) {
    for (const V3& spin : {V3(0.01, 0.02, 3.0), V3(3.0, 0.02, 0.01), V3(0.01, 3.0, 0.02)}) {
        talus::Simulation<3> sim(law<3>(0.0), {.h = 5e-3});
        sim.system().add(talus::Ball<3>(0.1), talus::Inertia<3>{1.0, {1.0, 2.0, 2.7}}, {},
                         {V3::Zero(), spin});
        const double begin = energy(sim);
        const V3 momentum = talus::momentum(sim.system().bodies).angular;
        double worst = 0.0;
        for (int k = 0; k < 40000; ++k) {
            sim.step();
            worst = std::max(worst, std::abs(energy(sim) / begin - 1.0));
        }
        const V3 after = talus::momentum(sim.system().bodies).angular;
        BOOST_CHECK_SMALL((after - momentum).norm() / momentum.norm(), 1e-10);
        // Of order h^2 and bounded: (3 h)^2 = 2e-4 in 120 000 rad.
        BOOST_CHECK_SMALL(worst, 3e-4);
        // About the axes of least and greatest moment the spin stays.
        const V3 w = sim.system().bodies.spin[0];
        if (spin[1] < 1.0) BOOST_CHECK_SMALL((w - spin).norm(), 0.1);
    }
}

BOOST_AUTO_TEST_SUITE_END()
