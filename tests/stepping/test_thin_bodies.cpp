// SPDX-License-Identifier: BSL-1.0
// What a run tells of bodies that are thin somewhere: of walls within a large body, of a table's
// top, and of plates that lie obliquely in their own frame.
#include <boost/test/unit_test.hpp>

#include <tuple>
#include <vector>

#include "common/dimensions.hpp"
#include "experiment.hpp"

using namespace experiment;

BOOST_AUTO_TEST_SUITE(stepping_thin_bodies)

/// Across axis 0, or across `axis`.
template <int Dim>
talus::Box<Dim> wall(double thickness, int axis = 0, double side = 1.0) {
    V<Dim> half = 0.5 * side * V<Dim>::Ones();
    half[axis] = 0.5 * thickness;
    return talus::Box<Dim>(half);
}

/// The share of their thicknesses that a ball of 5 mm went at 41 m/s, and whether it went through.
template <int Dim, class Obstacle>
std::tuple<double, bool> shot(const Obstacle& obstacle, const talus::Pose<Dim>& pose) {
    talus::Simulation<Dim> sim(law<Dim>(0.0), {.h = 1e-3});
    sim.system().add_obstacle(obstacle, pose);
    sim.system().add(talus::Ball<Dim>(0.005), 1000.0, talus::Pose<Dim>{-0.03 * V<Dim>::Unit(0), {}},
                     talus::Twist<Dim>{41.0 * V<Dim>::Unit(0)});
    const talus::RunSummary run = sim.run(0.003);
    return {run.travel.value, sim.system().bodies.position[1][0] > 0.05};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(walls_of_one_body_are_passed_and_it_is_told, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::Compound<Dim> walls({{wall<Dim>(2e-3), talus::Pose<Dim>{}},
                                      {wall<Dim>(2e-3), talus::Pose<Dim>{V<Dim>::Unit(0), {}}}});
    const auto [travel, passed] = shot<Dim>(walls, talus::Pose<Dim>{});
    BOOST_TEST(passed);
    BOOST_TEST(travel == 0.041 / 0.012, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(travel > 1.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_plate_that_lies_obliquely_in_its_frame_is_thin, D, dimensions) {
    constexpr int Dim = D::value;
    W<Dim> turn = W<Dim>::Zero();
    turn[turn.size() - 1] = pi / 4.0;
    const auto oblique = talus::Rotation<Dim>::exp(turn);
    const talus::Pose<Dim> turned{V<Dim>::Zero(), oblique}, back = turned.inverse();
    const auto box = wall<Dim>(1e-3).placed(turned);
    const auto v = box.core().vertices;
    std::vector<V<Dim>> corners(v.begin(), v.end());
    if (Dim == 2) std::swap(corners[2], corners[3]);
    const auto [travel, passed] = shot<Dim>(talus::ConvexPolytope<Dim>(corners), back);
    BOOST_TEST(passed);
    BOOST_TEST(travel == 0.041 / 0.011, boost::test_tools::tolerance(1e-9));
    // Turned by as much again, it stands across the way of the ball.
    const auto rod = talus::Capsule<Dim>(0.5, 1e-3).placed(turned);
    const auto [past_rod, passed_rod] = shot<Dim>(rod, turned);
    BOOST_TEST(passed_rod);
    BOOST_TEST(past_rod == 0.041 / 0.012, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_table_entered_through_its_top_is_told_of_the_top, D, dimensions) {
    constexpr int Dim = D::value;
    const double top = 2e-3, leg = 0.1;
    const V<Dim> side = 0.4 * V<Dim>::Unit(0);
    const auto post = talus::Box<Dim>(0.5 * leg * V<Dim>::Ones());
    const double down = -0.5 * (top + leg);
    const talus::Compound<Dim> table({{wall<Dim>(top, Dim - 1), talus::Pose<Dim>{}},
                                      {post, talus::Pose<Dim>{side + down * up<Dim>(), {}}},
                                      {post, talus::Pose<Dim>{-side + down * up<Dim>(), {}}}});
    talus::Simulation<Dim> sim(law<Dim>(0.3), {.h = 1e-4});
    sim.system().add_obstacle(table);
    // Deep in, at rest: no gravity.
    sim.system().add(talus::Ball<Dim>(0.05), 1000.0,
                     talus::Pose<Dim>{(0.5 * top + 0.05 - 2e-3) * up<Dim>(), {}});
    sim.system().gravity.setZero();
    const talus::RunSummary run = sim.run(1e-3);
    BOOST_TEST(run.overlap.value == 2.0, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(!run.certified());
}

BOOST_AUTO_TEST_SUITE_END()
