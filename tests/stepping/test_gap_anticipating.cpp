// SPDX-License-Identifier: BSL-1.0
// What a step that anticipates contacts must leave alone, and what it must not let pass.
#include <talus/geometry/box.hpp>
#include <talus/geometry/compound.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_polyhedron.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include "common/dimensions.hpp"
#include "common/effort.hpp"
#include "common/random.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_gap_anticipating)

using namespace experiment;

/// Of all steps, what simulations aim at by default. (More is asked for here, but many contacts in
/// nearly the same place are slow to get there.)
constexpr double accurate = talus::DefaultSolver::params.aim;

template <int Dim>
talus::Simulation<Dim> anticipating(double mu, double h, double gravity = g) {
    talus::SimulationParams params;
    params.h = h;
    params.step.scheme = talus::Scheme::gap_anticipating;
    params.step.contact_tolerance = touching;
    talus::Simulation<Dim> sim(law<Dim>(mu), params);
    sim.solver().params.tolerance = 1e-12;
    sim.system().gravity = -gravity * up<Dim>();
    return sim;
}

/// Half extents along the first axis, along the last, and across.
template <int Dim>
talus::Box<Dim> block(double first, double last, double across) {
    V<Dim> half = V<Dim>::Constant(across);
    half[0] = first;
    half[Dim - 1] = last;
    return talus::Box<Dim>(half);
}

constexpr double tile = 0.1, start = -0.413172, half_box = 0.05;

/// Tiles with their tops at height 0, every other one lower by `drop`.
template <int Dim>
std::vector<talus::Pose<Dim>> tile_poses(double drop, int count = 20) {
    std::vector<talus::Pose<Dim>> poses;
    for (int i = 0; i < count; ++i)
        poses.push_back({in_plane<Dim>(-0.5 + tile * (i + 0.5), -0.1 - (i % 2 ? drop : 0.0)), {}});
    return poses;
}
template <int Dim>
void add_tiles(talus::Simulation<Dim>& sim, double drop, int count = 20) {
    for (const auto& pose : tile_poses<Dim>(drop, count))
        sim.system().add_obstacle(block<Dim>(0.5 * tile, 0.1, 0.5), pose);
}

/// Length of the sliding box: it always lies on a tile that is not lower.
template <int Dim>
std::size_t add_sliding_box(talus::Simulation<Dim>& sim) {
    return static_cast<std::size_t>(sim.system().add(block<Dim>(0.12, half_box, half_box), 1000.0,
                                                     {in_plane<Dim>(start, half_box), {}},
                                                     {in_plane<Dim>(2.0, 0.0)}));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("long"))
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_keeps_its_speed_over_flush_and_lower_tiles, D, dimensions) {
    constexpr int Dim = D::value;
    for (double h : {1e-2, 1e-3})
        for (double drop : {0.0, 1e-9, 1e-7, 1e-5}) {
            auto sim = anticipating<Dim>(0.0, h);
            add_tiles(sim, drop);
            const auto box = add_sliding_box(sim);
            BOOST_CHECK_LT(sim.run(0.4).residual.value, accurate);
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][0] - 2.0, 1e-9);
            BOOST_CHECK_SMALL(sim.system().bodies.position[box][Dim - 1] - half_box, 1e-5);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(friction_stops_a_box_on_tiles_where_it_does_on_one, D, dimensions) {
    constexpr int Dim = D::value;
    const double mu = 0.3, way = 2.0 * 2.0 / (2.0 * mu * g);
    for (double drop : {0.0, 1e-5}) {
        auto sim = anticipating<Dim>(mu, 1e-3);
        add_tiles(sim, drop);
        const auto box = add_sliding_box(sim);
        BOOST_CHECK_LT(sim.run(0.75).residual.value, accurate);
        // Exact but for the last step, and for the heights of the tiles.
        BOOST_CHECK_SMALL(sim.system().bodies.position[box][0] - start - way, 1e-5);
        BOOST_CHECK_SMALL(sim.system().bodies.velocity[box].norm(), 1e-9);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(inner_faces_of_compounds_are_no_obstacle, D, dimensions) {
    constexpr int Dim = D::value;
    using C = talus::Compound<Dim>;
    using Child = typename C::Child;
    std::vector<typename C::Placed> floor;
    for (const auto& pose : tile_poses<Dim>(0.0))
        floor.push_back({Child(block<Dim>(0.5 * tile, 0.1, 0.5)), pose});
    auto sim = anticipating<Dim>(0.0, 1e-3);
    sim.system().add_obstacle(C(floor));
    const Child half(block<Dim>(0.03, half_box, half_box));
    const auto box = static_cast<std::size_t>(sim.system().add(
        C({{half, {in_plane<Dim>(-0.03, 0.0), {}}}, {half, {in_plane<Dim>(0.03, 0.0), {}}}}),
        1000.0, {in_plane<Dim>(start, half_box), {}}, {in_plane<Dim>(2.0, 0.0)}));
    BOOST_CHECK_LT(sim.run(0.4).residual.value, accurate);
    BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][0] - 2.0, 1e-9);
    BOOST_CHECK_SMALL(sim.system().bodies.position[box][Dim - 1] - half_box, 1e-8);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_rolls_over_seams_without_loss, D, dimensions) {
    constexpr int Dim = D::value;
    const double r = 0.05;
    for (double h : {1e-2, 1e-3})
        for (double v : {2.0, 10.0}) {
            auto sim = anticipating<Dim>(0.5, h);
            add_tiles(sim, 0.0, 40);
            const auto ball = static_cast<std::size_t>(
                sim.system().add(talus::Ball<Dim>(r), 1000.0, {in_plane<Dim>(start, r), {}},
                                 {in_plane<Dim>(v, 0.0), rolling_spin<Dim>(v / r)}));
            BOOST_CHECK_LT(sim.run(3.0 / v).residual.value, accurate);
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[ball][0] / v - 1.0, 1e-9);
            BOOST_CHECK_SMALL(sim.system().bodies.spin[ball].norm() * r / v - 1.0, 1e-9);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_seam_reached_in_the_middle_of_a_step_is_no_obstacle, D,
                              dimensions) {
    constexpr int Dim = D::value;
    // Then the front stands exactly over the seam when contacts are looked for.
    for (double half : {0.05, 0.12})
        for (double at : {-0.4, -0.37, -0.399, -0.4005}) {
            auto sim = anticipating<Dim>(0.0, 1e-3);
            add_tiles(sim, 0.0);
            const auto box = static_cast<std::size_t>(
                sim.system().add(block<Dim>(half, half_box, half_box), 1000.0,
                                 {in_plane<Dim>(at, half_box), {}}, {in_plane<Dim>(2.0, 0.0)}));
            BOOST_CHECK_LT(sim.run(0.4).residual.value, accurate);
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][0] - 2.0, 1e-9);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(corners_pass_each_other, D, dimensions) {
    constexpr int Dim = D::value;
    // Two boxes on their edges, the one flying over the other.
    const auto cube = block<Dim>(0.05, 0.05, 0.05);
    const auto on_edge = talus::Rotation<Dim>::exp(rolling_spin<Dim>(0.25 * pi));
    const double height = 2.0 * 0.05 * std::sqrt(2.0);
    for (double h : {1.0 / 60.0, 1e-2, 1e-3})
        for (double over : {2e-4, 1e-3, 1e-2}) {
            auto sim = anticipating<Dim>(0.3, h, 0.0);
            sim.system().add_obstacle(cube, talus::Pose<Dim>{V<Dim>(V<Dim>::Zero()), on_edge});
            const auto box = static_cast<std::size_t>(
                sim.system().add(cube, 1000.0, {in_plane<Dim>(-0.5137, height + over), on_edge},
                                 {in_plane<Dim>(10.0, 0.0)}));
            BOOST_CHECK_LT(sim.run(0.1).residual.value, accurate);
            BOOST_CHECK_SMALL(
                largest(V<Dim>(sim.system().bodies.velocity[box] - in_plane<Dim>(10.0, 0.0))),
                1e-9);
        }
}

template <int Dim>
talus::ConvexPolytope<Dim> grain(talus::Random& random, double radius) {
    if constexpr (Dim == 2)
        return talus::ConvexPolytope<2>(talus::random_polygon(random, radius));
    else
        return talus::ConvexPolytope<3>(talus::random_polyhedron(random, radius));
}

/// How many of the bodies, thrown from all sides within 60 degrees at a wall of 5 cm, get to its
/// other side.
template <int Dim, class S>
int passing(const S& shape, double most_spin, int runs) {
    std::mt19937 rng(5);
    int passed = 0;
    for (int k = 0; k < runs; ++k) {
        auto sim = anticipating<Dim>(k % 2 ? 0.3 : 0.0, 1.0 / 60.0, 0.0);
        sim.solver().params.tolerance = 1e-9;
        V<Dim> half = V<Dim>::Constant(10.0);
        half[0] = 0.025;
        sim.system().add_obstacle(talus::Box<Dim>(half),
                                  talus::Pose<Dim>{V<Dim>(1.225 * V<Dim>::Unit(0)), {}});
        V<Dim> toward = random_input::unit<V<Dim>>(rng);
        while (toward[0] < 0.5) toward = random_input::unit<V<Dim>>(rng);
        const double speed = k % 3 == 0 ? 100.0 : random_input::uniform(rng, 30.0, 100.0);
        const auto turn = talus::Rotation<Dim>::exp(random_input::vector<W<Dim>>(rng, 3.0));
        const W<Dim> spin = random_input::vector<W<Dim>>(rng, most_spin);
        const auto body = static_cast<std::size_t>(sim.system().add(
            shape, 1000.0, {V<Dim>(V<Dim>::Zero()), turn}, {V<Dim>(speed * toward), spin}));
        BOOST_CHECK_LT(sim.run(0.1).residual.value, accurate);
        passed += sim.system().bodies.position[body][0] > 1.225;
    }
    return passed;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_at_up_to_100_m_per_s_passes_a_wall_of_5_cm, D, dimensions) {
    constexpr int Dim = D::value;
    const int runs = Dim == 2 ? 200 : 100;
    // Rods and plates thrown so may tumble through: an impact turns them by radians in a step.
    BOOST_CHECK_EQUAL(passing<Dim>(talus::Ball<Dim>(0.05), 20.0, runs), 0);
    BOOST_CHECK_EQUAL(passing<Dim>(block<Dim>(0.05, 0.05, 0.05), 0.0, runs), 0);
    BOOST_CHECK_EQUAL(passing<Dim>(block<Dim>(0.06, 0.03, 0.04), 0.0, runs), 0);
    BOOST_CHECK_EQUAL(passing<Dim>(block<Dim>(0.01, 0.01, 0.01), 0.0, runs), 0);
    talus::Random random(3);
    for (int k = 0; k < 3; ++k)
        BOOST_CHECK_EQUAL(passing<Dim>(grain<Dim>(random, 0.05), 0.0, runs), 0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_meets_the_side_of_a_tile_that_it_comes_to_first, D,
                              dimensions) {
    constexpr int Dim = D::value;
    for (double v : {5.0, 20.0})
        for (bool over : {false, true}) {
            auto sim = anticipating<Dim>(0.0, 1e-2, 0.0);
            sim.system().add_obstacle(block<Dim>(1.0, 0.1, 0.5),
                                      talus::Pose<Dim>{in_plane<Dim>(1.0, -0.1), {}});
            // The lower corner in front flies diagonally, to the middle of the tile's side, or to
            // the middle of its own way over the tile.
            const double height = over ? 0.6 : 0.15;
            const auto box = static_cast<std::size_t>(sim.system().add(
                block<Dim>(0.05, 0.05, 0.05), 1000.0,
                {in_plane<Dim>(-0.3 - 0.05, height + 0.05), {}}, {in_plane<Dim>(v, -v)}));
            BOOST_CHECK_LT(sim.run(0.3 / v * 1.2).residual.value, accurate);
            const V<Dim>& end = sim.system().bodies.velocity[box];
            if (over) {
                BOOST_CHECK_LT(sim.run(0.45 / v).residual.value, accurate);
                BOOST_CHECK_SMALL(end[Dim - 1], 1e-6);
                BOOST_CHECK_SMALL(end[0] - v, 1e-6);
            } else {
                BOOST_CHECK_SMALL(end[0], 1e-6);
                BOOST_CHECK_SMALL(end[Dim - 1] + v, 1e-6);
            }
        }
}

/// Tiles of random lengths with their tops at height 0.
template <int Dim>
void add_random_tiles(talus::Simulation<Dim>& sim, std::mt19937& rng, double length) {
    for (double at = -1.0; at < length;) {
        const double width = random_input::uniform(rng, 0.05, 0.3);
        sim.system().add_obstacle(block<Dim>(0.5 * width, 0.1, 2.0),
                                  talus::Pose<Dim>{in_plane<Dim>(at + 0.5 * width, -0.1), {}});
        at += width;
    }
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("long"))
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_that_lands_at_a_slant_keeps_its_speed_along_the_tiles, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const unsigned seed = 1;
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 rng(seed);
    for (double h : {1.0 / 60.0, 1e-2, 1e-3})
        for (int k = 0; k < (h < 5e-3 ? repetitions(10, 2) : repetitions(40, 10)); ++k) {
            auto sim = anticipating<Dim>(0.0, h);
            const double v = random_input::uniform(rng, 5.0, 20.0);
            const double slant = random_input::uniform(rng, 0.35, 1.2);
            const double across = v * std::cos(slant), down = v * std::sin(slant);
            // Bodies that overlap at the first midpoint have met whatever they met there.
            const double height = 0.51 * h * v + random_input::uniform(rng, 0.005, 0.5);
            const double duration = std::max(height / down + 0.05, 2.5 * h);
            add_random_tiles<Dim>(sim, rng, across * duration + 3.0);
            const double half = random_input::uniform(rng, 0.03, 0.08);
            const auto box = static_cast<std::size_t>(sim.system().add(
                block<Dim>(half * random_input::uniform(rng, 0.5, 2.0), half, half), 1000.0,
                {in_plane<Dim>(random_input::uniform(rng, 0.3, 0.5), height + half), {}},
                {in_plane<Dim>(across, -down)}));
            BOOST_CHECK_LT(sim.run(duration).residual.value, accurate);
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][0] / across - 1.0, 1e-9);
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][Dim - 1], 1e-6);
        }
}

/// Free tiles of a half-space: what carries a body may itself be carried.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_that_lands_on_free_tiles_keeps_its_speed_along_them, D,
                              dimensions) {
    constexpr int Dim = D::value;
    for (double across : {2.0, 5.0})
        for (double height : {0.03, 0.041, 0.06}) {  // above the floor at the first midpoint
            auto sim = anticipating<Dim>(0.0, 1e-2);
            sim.solver().params.tolerance = 1e-6;
            sim.system().add_obstacle(talus::HalfSpace<Dim>(up<Dim>(), -0.2));
            const auto a_tile = block<Dim>(0.5 * tile, 0.1, 0.5);
            for (const auto& pose : tile_poses<Dim>(0.0, 8)) sim.system().add(a_tile, 1000.0, pose);
            const auto box = static_cast<std::size_t>(sim.system().add(
                block<Dim>(half_box, half_box, half_box), 1000.0,
                {in_plane<Dim>(start, height + half_box), {}}, {in_plane<Dim>(across, -5.0)}));
            BOOST_CHECK_LT(sim.run(0.1).residual.value, accurate);
            // Tiles turn a little by what is left of the error.
            BOOST_CHECK_SMALL(sim.system().bodies.velocity[box][0] / across - 1.0, 1e-5);
        }
}

/// Only the surface of a belt moves: its ends stay where they are.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_that_lands_on_the_end_of_a_belt_stays_on_it, D, dimensions) {
    constexpr int Dim = D::value;
    for (double speed : {5.0, -5.0})
        for (double end : {-1.0, 1.0}) {
            auto sim = anticipating<Dim>(0.0, 1e-2);
            sim.system().add_obstacle(
                block<Dim>(1.0, 0.1, 0.5),
                talus::PrescribedMotion<Dim>::belt({in_plane<Dim>(0.0, -0.1), {}},
                                                   {in_plane<Dim>(speed, 0.0), W<Dim>::Zero()}));
            const double at = end * (1.0 - 0.01);  // all of it over the belt
            const auto box = static_cast<std::size_t>(
                sim.system().add(block<Dim>(0.01, 0.01, 0.01), 1000.0,
                                 {in_plane<Dim>(at, 0.03), {}}, {in_plane<Dim>(0.0, -2.0)}));
            BOOST_CHECK_LT(sim.run(0.1).residual.value, accurate);
            BOOST_CHECK_SMALL(sim.system().bodies.position[box][0] - at, 1e-9);
            BOOST_CHECK_GT(sim.system().bodies.position[box][Dim - 1], 0.01 - 1e-6);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_bounce_returns_its_speed_at_any_step, D, dimensions) {
    constexpr int Dim = D::value;
    constexpr double radius = 0.1;
    for (const double h : {1e-3, 1e-4, 1e-5})
        for (const double speed : {0.1, 0.01}) {
            talus::SimulationParams params{.h = h};
            params.step.scheme = talus::Scheme::gap_anticipating;
            talus::Simulation<Dim> sim(law<Dim>(0.0, 1.0), params);
            auto& bodies = sim.system().bodies;
            sim.system().add_obstacle(talus::HalfSpace<Dim>(up<Dim>()));
            // It arrives in some twenty steps.
            const auto ball =
                sim.system().add(talus::Ball<Dim>(radius), 1000.0,
                                 {V<Dim>((radius + 20.3 * h * speed) * up<Dim>()), {}},
                                 {V<Dim>(-speed * up<Dim>()), talus::AngularVector<Dim>::Zero()});
            BOOST_TEST(sim.run(50 * h).missed == 0);
            BOOST_TEST(bodies.velocity[ball][Dim - 1] == speed, boost::test_tools::tolerance(1e-9));
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_plate_that_rises_under_a_moving_surface_is_foreseen, D,
                              dimensions) {
    constexpr int Dim = D::value;
    using Motion = talus::PrescribedMotion<Dim>;
    constexpr double radius = 0.1, speed = 5.0, h = 1e-2;
    talus::SimulationParams params{.h = h};
    params.step.scheme = talus::Scheme::gap_anticipating;
    talus::Simulation<Dim> sim(law<Dim>(0.3), params);
    sim.system().gravity = -g * up<Dim>();
    const auto rising =
        Motion::uniform({V<Dim>(-0.8 * up<Dim>()), {}},
                        {V<Dim>(speed * up<Dim>()), talus::AngularVector<Dim>::Zero()});
    sim.system().add_obstacle(talus::Box<Dim>(V<Dim>::Constant(0.5)),
                              rising.with_surface([](double) { return talus::Twist<Dim>{}; }));
    sim.system().add(talus::Ball<Dim>(radius), 1000.0, {});
    const auto run = sim.run(0.2);
    BOOST_TEST(run.missed == 0);
    BOOST_TEST(run.overlap.value < 1e-9, to_string(run));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(steps_over_seams_repeat_to_the_bit, D, dimensions) {
    constexpr int Dim = D::value;
    auto one = anticipating<Dim>(0.1, 1e-3), two = anticipating<Dim>(0.1, 1e-3);
    for (auto* sim : {&one, &two}) {
        add_tiles(*sim, 1e-6);
        add_sliding_box(*sim);
        BOOST_CHECK_LT(sim->run(0.3).residual.value, accurate);
    }
    BOOST_CHECK(one.system().bodies.position == two.system().bodies.position);
    BOOST_CHECK(one.system().bodies.velocity == two.system().bodies.velocity);
}

BOOST_AUTO_TEST_SUITE_END()
