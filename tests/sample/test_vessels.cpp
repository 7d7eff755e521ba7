// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/regions.hpp>
#include <talus/sample/vessels.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(sample_vessels)

template <int Dim>
using V = talus::Vector<Dim>;

template <int Dim>
bool solid(const std::vector<talus::PlacedShape<Dim>>& walls, const V<Dim>& x) {
    for (const auto& wall : walls)
        if (talus::covers(talus::view_of<Dim>(wall.shape), wall.pose, x)) return true;
    return false;
}
template <int Dim>
V<Dim> at(double x, double height) {
    V<Dim> place = V<Dim>::Zero();
    place[0] = x;
    place[Dim - 1] = height;
    return place;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_hopper_leaves_its_opening_and_nothing_else, D, dimensions) {
    constexpr int Dim = D::value;
    const double little = 1e-6;
    for (const double lean : {0.3, std::numbers::pi / 4, 1.2}) {
        const talus::HopperParams params{.opening = 0.06, .width = 0.3, .depth = 0.1, .lean = lean};
        const auto walls = talus::hopper<Dim>(params);
        BOOST_TEST(walls.size() == (Dim == 2 ? 4u : 6u));
        for (const double side : {-1.0, 1.0}) {
            BOOST_TEST(!solid<Dim>(walls, at<Dim>(side * (0.03 - little), 0.0)));
            // Along the planks, from the edge to the wall: open above, solid below.
            for (const double way : {0.001, 0.3, 0.7, 0.999}) {
                const double x = 0.03 + 0.12 * way, height = 0.12 * way * std::tan(lean);
                BOOST_TEST(!solid<Dim>(walls, at<Dim>(side * x, height + little)));
                BOOST_TEST(solid<Dim>(walls, at<Dim>(side * x, height - little)));
            }
            BOOST_TEST(!solid<Dim>(walls, at<Dim>(side * (0.15 - little), 0.5)));
            BOOST_TEST(solid<Dim>(walls, at<Dim>(side * (0.15 + little), 0.5)));
            if constexpr (Dim == 3) {
                V<3> x = at<3>(0.0, 0.1);
                x[1] = side * (0.05 - little);
                BOOST_TEST(!solid<3>(walls, x));
                x[1] = side * (0.05 + little);
                BOOST_TEST(solid<3>(walls, x));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(drums_and_tubes_are_round_and_closed_where_they_say, D, dimensions) {
    constexpr int Dim = D::value;
    const auto drum = talus::drum<Dim>(0.5, 0.2);
    for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
        const V<Dim> out = at<Dim>(std::cos(angle), std::sin(angle));
        BOOST_TEST(!solid<Dim>(drum, V<Dim>(0.499999 * out)));
        BOOST_TEST(solid<Dim>(drum, V<Dim>(0.500001 * out)));
    }
    if constexpr (Dim == 3) {
        BOOST_TEST(!solid<3>(drum, V<3>(0.0, 0.0999, 0.0)));
        BOOST_TEST(solid<3>(drum, V<3>(0.0, -0.1001, 0.0)));
    }
    // What is at the end of axis 0 goes up.
    const auto twist = talus::drum_twist<Dim>(0.5);
    BOOST_TEST(twist.at(V<Dim>::Unit(0))[Dim - 1] == std::numbers::pi,
               boost::test_tools::tolerance(1e-12));
    const auto tube = talus::tube<Dim>(0.4);
    BOOST_TEST(!solid<Dim>(tube, at<Dim>(0.1999, 7.0)));
    BOOST_TEST(solid<Dim>(tube, at<Dim>(-0.2001, -7.0)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_rough_floor_stops_what_slides, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::UniformRadii radii(0.008, 0.012);
    talus::Random first(3), second(3);
    const auto floor = talus::rough_floor<Dim>(first, radii, 0.2);
    const auto again = talus::rough_floor<Dim>(second, radii, 0.2);
    BOOST_REQUIRE(floor.size() == again.size());
    BOOST_TEST(floor.size() > 10u);
    for (std::size_t k = 0; k < floor.size(); ++k)
        BOOST_TEST((floor[k].pose.position == again[k].pose.position));
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{.mu = 0.0}},
                               talus::SimulationParams{.h = 1e-3});
    auto& system = sim.system();
    system.gravity = -9.81 * V<Dim>::Unit(Dim - 1);
    for (const auto& wall : floor) system.add_obstacle(wall.shape, wall.pose);
    const auto ball = system.add(talus::Ball<Dim>(0.01), 1000.0, {at<Dim>(0.0, 0.02), {}},
                                 {V<Dim>(0.2 * V<Dim>::Unit(0)), {}});
    BOOST_TEST(sim.run(1.0).steps == 1000);
    BOOST_TEST(system.bodies.position[ball].norm() < 0.2);
    BOOST_TEST(system.bodies.velocity[ball].norm() < 0.05);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(vessels_that_are_none_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    for (const talus::HopperParams& params : std::vector<talus::HopperParams>{
             {.opening = -0.1, .width = 0.3, .depth = 0.1},
             {.opening = 0.3, .width = 0.3, .depth = 0.1},
             {.opening = 0.1, .width = std::nan(""), .depth = 0.1},
             {.opening = 0.1, .width = 0.3, .depth = 0.1, .lean = 0.0},
             {.opening = 0.1, .width = 0.3, .depth = 0.1, .lean = 1.6},
             {.opening = 0.1, .width = 0.3, .depth = 0.1, .thickness = 0.0}})
        BOOST_CHECK_THROW(talus::hopper<Dim>(params), talus::input_error);
    if (Dim == 3)
        BOOST_CHECK_THROW(talus::hopper<Dim>({.opening = 0.1, .width = 0.3}), talus::input_error);
    BOOST_CHECK_THROW(talus::drum<Dim>(0.0), talus::input_error);
    BOOST_CHECK_THROW(talus::drum<Dim>(1.0, -1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::tube<Dim>(0.0), talus::input_error);
    talus::Random random(1);
    for (const double reach : {0.0, -1.0, 1e9})
        BOOST_CHECK_THROW(talus::rough_floor<Dim>(random, talus::UniformRadii(0.1, 0.2), reach),
                          talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
