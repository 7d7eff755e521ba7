// SPDX-License-Identifier: BSL-1.0
// Bodies that should stay where they are, and did not in other libraries.
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/compound.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/stepping/step_queries.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "common/dimensions.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(reports_statics)

using namespace experiment;

using V3 = talus::Vector<3>;
using talus::BodyIndex;
using talus::Box;

/// Speeds that count as rest: the solver's tolerance times the scale g h of a step, over thousands
/// of steps.
constexpr double rest = 1e-9;

template <int Dim>
double speed(const talus::Bodies<Dim>& bodies, BodyIndex body) {
    const auto i = static_cast<std::size_t>(body);
    return bodies.velocity[i].norm() + bodies.spin[i].norm();
}

/// How far a body goes in a time, and whether the number of contacts stays the same.
template <class Sim>
double creep(Sim& sim, BodyIndex body, double duration) {
    const auto i = static_cast<std::size_t>(body);
    const auto begin = sim.system().bodies.position[i];
    sim.step();
    const std::size_t contacts = sim.data().contact_count();
    bool steady = true;
    const auto run = sim.run(
        duration, [&](const auto& s) { steady = steady && s.data().contact_count() == contacts; });
    BOOST_TEST(run.missed == 0);
    BOOST_TEST(steady);
    return (sim.system().bodies.position[i] - begin).norm();
}

// google-deepmind/mujoco#3328
BOOST_AUTO_TEST_CASE(a_pinched_capsule_does_not_creep_through_the_grip) {
    // 45 g between two pads pressed by 12 N, friction 0.7; the pad that presses is held in z by two
    // guides without friction.
    const double radius = 0.004, mass = 0.045, half = 0.02;
    talus::MaterialTable<talus::DefaultLaw<3>> laws(2, law<3>(0.7));
    laws.set(1, 0, law<3>(0.0));
    talus::SimulationParams params{.h = 1e-3};
    params.step.contact_tolerance = touching;
    talus::Simulation<3, Sweeping<3>> sim(talus::System<3, talus::DefaultLaw<3>>(laws), params);
    sim.solver().params.tolerance = 1e-12;
    sim.solver().params.max_sweeps = 100000;
    auto& system = sim.system();
    const Box<3> pad(V3::Constant(half));
    system.add_obstacle(pad, talus::Pose<3>{{-half - radius, 0, 0}, {}});
    for (const double side : {-1.0, 1.0})
        system.add_obstacle(talus::HalfSpace<3>{-side * V3::Unit(2), -half}, {}, 1);
    const auto along_y = talus::Rotation<3>::exp(0.5 * pi * V3::Unit(2));
    const talus::Capsule<3> grain(0.01, radius);
    const double density = mass / grain.mass_properties().volume;
    const BodyIndex capsule = system.add(grain, density, {V3::Zero(), along_y});
    const BodyIndex presses = system.add(pad, 1000.0, {{half + radius, 0, 0}, {}});
    system.forces.push_back(
        [=](double, const talus::Bodies<3>&, std::span<talus::Wrench<3>> wrenches) {
            wrenches[static_cast<std::size_t>(capsule)].force -= mass * g * V3::Unit(2);
            wrenches[static_cast<std::size_t>(presses)].force -= 12.0 * V3::Unit(0);
        });
    BOOST_CHECK_SMALL(creep(sim, capsule, 1.0), rest);
    BOOST_CHECK_SMALL(speed(system.bodies, capsule), rest);
}

// newton-physics/newton#1138, liabru/matter-js#752, schteppe/cannon.js#288
BOOST_AUTO_TEST_CASE_TEMPLATE(a_block_on_an_incline_holds_up_to_the_angle_of_friction, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const auto slope = [](double mu, double angle) {
        auto sim = simulation<Dim>(law<Dim>(mu), 1e-3,
                                   g * in_plane<Dim>(std::sin(angle), -std::cos(angle)));
        sim.system().add(Box<Dim>(V<Dim>::Constant(0.5)), 100.0, {0.5 * up<Dim>(), {}});
        return sim;
    };
    auto gentle = slope(1.0, pi / 90);
    BOOST_CHECK_SMALL(creep(gentle, 1, 2.0), rest);
    for (const double mu : {0.1, 0.5}) {
        auto below = slope(mu, std::atan(mu) - 1e-4);
        BOOST_CHECK_SMALL(creep(below, 1, 0.5), rest);
        const double angle = std::atan(mu) + 1e-4;
        auto above = slope(mu, angle);
        for (int k = 0; k < 500; ++k) above.step();
        const double pull = g * (std::sin(angle) - mu * std::cos(angle));
        BOOST_CHECK_SMALL(above.system().bodies.velocity[1][0] - 0.5 * pull, 1e-10);
    }
}

// NVIDIA-Omniverse/PhysX#276
BOOST_AUTO_TEST_CASE_TEMPLATE(forces_on_an_incline_carry_the_weight, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double angle : {0.0, 0.1, 0.3, 0.45}) {
        const V<Dim> gravity = g * in_plane<Dim>(std::sin(angle), -std::cos(angle));
        auto sim = simulation<Dim>(law<Dim>(0.5), 1e-3, gravity);
        sim.system().add(Box<Dim>(V<Dim>::Constant(0.5)), 100.0, {0.5 * up<Dim>(), {}});
        for (int k = 0; k < 50; ++k) {
            sim.step();
            const auto w = talus::wrench_impulse_on(sim.data(), 1);
            BOOST_CHECK_SMALL((w.force / 1e-3 + 100.0 * gravity).norm(), 1e-8);
            BOOST_CHECK_SMALL(w.torque.norm() / 1e-3, 1e-8);
        }
    }
}

// siconos/siconos#106, google-deepmind/mujoco#1665
BOOST_AUTO_TEST_CASE(a_tetrahedron_and_a_cube_of_a_file_keep_their_contacts) {
    const auto floored = [](const std::vector<V3>& points) {
        auto sim = simulation<3>(law<3>(0.5), 1e-3, -g * up<3>());
        const talus::ConvexPolytope<3> shape(points);
        double low = 0.0;
        for (const V3& p : points) low = std::min(low, p[2]);
        sim.system().add(shape, 100.0, {-low * up<3>(), {}});
        return sim;
    };
    std::vector<V3> tetrahedron{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    const V3 axis = V3(1, -1, 0).normalized();  // (1, 1, 1) turns onto the vertical about it
    const auto turn = talus::Rotation<3>::exp(std::acos(1.0 / std::sqrt(3.0)) * axis);
    for (V3& v : tetrahedron) v = turn * v;
    auto sits = floored(tetrahedron);
    BOOST_CHECK_SMALL(creep(sits, 1, 1.0), rest);
    BOOST_TEST(sits.data().contact_count() == 3u);
    std::vector<V3> cube;
    for (int i = 0; i < 8; ++i)
        cube.emplace_back((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    auto box = floored(cube);
    BOOST_CHECK_SMALL(creep(box, 1, 1.0), rest);
    BOOST_TEST(box.data().contact_count() == 4u);
}

// google-deepmind/mujoco#2356
BOOST_AUTO_TEST_CASE(a_peg_across_a_small_cube_does_not_jitter) {
    auto sim = simulation<3>(law<3>(0.6), 2e-3, -g * up<3>(), false);
    sim.system().add_obstacle(Box<3>(V3::Constant(0.025)), talus::Pose<3>{{0, 0, 0.025}, {}});
    const BodyIndex peg =
        sim.system().add(Box<3>(V3(0.048, 0.01, 0.01)), 1000.0, {{0, 0, 0.06}, {}});
    BOOST_CHECK_SMALL(creep(sim, peg, 2.0), rest);
    BOOST_TEST(sim.data().contact_count() == 4u);
}

// jrouwe/JoltPhysics#1686
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_at_rest_on_a_level_box_does_not_roll, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = simulation<Dim>(law<Dim>(0.3), 1.0 / 60, -g * up<Dim>(), false);
    sim.system().add_obstacle(Box<Dim>(V<Dim>::Constant(5.0)),
                              talus::Pose<Dim>{-5.0 * up<Dim>(), {}});
    const BodyIndex ball =
        sim.system().add(talus::Ball<Dim>(0.5), 1000.0, {in_plane<Dim>(0.123, 0.5), {}});
    BOOST_CHECK_SMALL(creep(sim, ball, 20.0), rest);
    BOOST_CHECK_SMALL(speed(sim.system().bodies, ball), rest);
}

// siconos/siconos#218
BOOST_AUTO_TEST_CASE(a_cube_with_balls_at_its_corners_rests_on_a_plate) {
    const double half = 0.0944, radius = 0.011;
    std::vector<talus::Compound<3>::Placed> parts{{Box<3>(V3::Constant(half)), {}}};
    for (int i = 0; i < 8; ++i) {
        const V3 corner((i & 1) ? half : -half, (i >> 1 & 1) ? half : -half, i >> 2 ? half : -half);
        parts.push_back({talus::Ball<3>(radius), {corner, {}}});
    }
    auto sim = simulation<3>(law<3>(0.6), 1e-3, -g * up<3>(), false);
    sim.system().add_obstacle(Box<3>(V3(0.5, 0.5, 0.025)), talus::Pose<3>{{0, 0, -0.025}, {}});
    const BodyIndex cube =
        sim.system().add(talus::Compound<3>(parts), 2679.1838, {{0, 0, half + radius + 0.01}, {}});
    BOOST_TEST(sim.run(0.5).missed == 0);
    BOOST_CHECK_SMALL(speed(sim.system().bodies, cube), rest);
    const V3 place = sim.system().bodies.position[static_cast<std::size_t>(cube)];
    const double entered = 1e-3 * std::sqrt(2 * g * 0.01);  // h times the speed of the fall
    BOOST_CHECK_SMALL(place.head<2>().norm(), rest);
    BOOST_TEST((place[2] <= half + radius && place[2] >= half + radius - entered));
    BOOST_TEST(sim.data().contact_count() == 4u);
}

// jrouwe/JoltPhysics#1740
BOOST_AUTO_TEST_CASE_TEMPLATE(boxes_that_bounce_rest_under_a_hundred_times_gravity, D, dimensions) {
    constexpr int Dim = D::value;
    const auto fall = [](bool floor_first, double height) {
        auto sim = simulation<Dim>(law<Dim>(0.4, 0.5), 1.0 / 60, -1000.0 * up<Dim>(), floor_first);
        sim.system().add(Box<Dim>(V<Dim>::Constant(0.5)), 100.0, {(0.5 + height) * up<Dim>(), {}});
        if (!floor_first) sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
        return sim;
    };
    for (const bool floor_first : {false, true}) {
        auto sim = fall(floor_first, 0.0);
        BOOST_CHECK_SMALL(creep(sim, floor_first ? 1 : 0, 10.0), rest);
    }
    auto one = fall(false, 0.1), other = fall(true, 0.1);
    for (int k = 0; k < 600; ++k) {
        one.step();
        other.step();
        const double difference =
            (one.system().bodies.position[0] - other.system().bodies.position[1]).norm();
        BOOST_REQUIRE_SMALL(difference, rest);
    }
    BOOST_CHECK_SMALL(speed(one.system().bodies, 0), rest);
}

BOOST_AUTO_TEST_SUITE_END()
