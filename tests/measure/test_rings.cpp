// SPDX-License-Identifier: BSL-1.0
// Pressure by rings, surfaces and their slope, against heaps whose answers are known.
#include <talus/measure/rings.hpp>
#include <talus/measure/stress.hpp>
#include <talus/sample/container.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_rings)

template <int Dim>
talus::Vector<Dim> at(double x, double up) {
    talus::Vector<Dim> p = talus::Vector<Dim>::Zero();
    p[0] = x;
    p[Dim - 1] = up;
    return p;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rings_tile_the_ground, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::Rings<Dim> rings(at<Dim>(1.0, 5.0), 0.5, 4);
    double area = 0.0;
    for (std::size_t k = 0; k < rings.count(); ++k) area += rings.area(k);
    BOOST_CHECK_CLOSE(area, Dim == 2 ? 4.0 : std::numbers::pi * 4.0, 1e-12);
    BOOST_TEST(rings.ring(at<Dim>(1.0, -3.0)) == 0u);
    BOOST_TEST(rings.ring(at<Dim>(-0.3, 0.0)) == 2u);
    BOOST_TEST(rings.ring(at<Dim>(3.1, 0.0)) == 4u);
    BOOST_TEST(rings.middle(1) == 0.75);
    BOOST_CHECK_THROW(talus::Rings<Dim>(at<Dim>(0, 0), 0.0, 3), talus::input_error);
    BOOST_CHECK_THROW(talus::Rings<Dim>(at<Dim>(0, 0), 1.0, 0), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_press_where_they_stand, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(talus::DefaultLaw<Dim>{{0.3}, 0.0, 0.0}, {.h = 1e-3});
    auto& system = sim.system();
    system.gravity = -9.81 * talus::Vector<Dim>::Unit(Dim - 1);
    const auto floor =
        system.add_obstacle(talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1), 0.0));
    const auto inner = system.add(talus::Ball<Dim>(0.1), 1000.0, {at<Dim>(0.1, 0.1), {}});
    const auto outer = system.add(talus::Ball<Dim>(0.2), 1000.0, {at<Dim>(-0.7, 0.2), {}});
    const auto on_top = system.add(talus::Ball<Dim>(0.1), 1000.0, {at<Dim>(-0.7, 0.5), {}});
    talus::GroundPressure<Dim> ground(talus::Rings<Dim>(at<Dim>(0.0, 0.0), 0.5, 3));
    std::vector<talus::Vector<Dim>> forces;
    BOOST_TEST(sim.run(0.05,
                       [&](const auto& s) {
                           const auto& jacobian = s.data().problem.jacobian;
                           talus::contact_forces<Dim>(jacobian, s.data().impulse, s.data().h,
                                                      forces);
                           ground.record(jacobian, forces, s.system().bodies, [&](std::size_t i) {
                               return i == static_cast<std::size_t>(floor);
                           });
                       })
                   .certified());
    const auto weight = [&](auto body) { return 9.81 * system.bodies.mass(body); };
    BOOST_TEST(ground.records() == 50);
    BOOST_CHECK_CLOSE(ground.pressure(0) * ground.rings().area(0), weight(inner), 0.1);
    BOOST_CHECK_CLOSE(ground.pressure(1) * ground.rings().area(1), weight(outer) + weight(on_top),
                      0.1);
    BOOST_TEST(ground.pressure(2) == 0.0);
    BOOST_CHECK_CLOSE(ground.force(), weight(inner) + weight(outer) + weight(on_top), 0.1);
    talus::GroundPressure<Dim> same(ground.rings());
    same.restore(talus::record_of(ground));
    BOOST_TEST(same.pressure(1) == ground.pressure(1));
    BOOST_CHECK_THROW(same.restore(talus::NumberRecord{}), talus::input_error);
    BOOST_TEST(same.records() == 50);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_point_is_of_the_ground_in_whatever_order, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    // A grain has rolled on since it touched the ground, just inside the first ring.
    for (const bool ground_first : {true, false}) {
        talus::Bodies<Dim> bodies;
        const auto add_grain = [&] {
            return bodies.add({1.0, talus::AngularVector<Dim>::Constant(1.0)},
                              {at<Dim>(0.6, 0.1), {}});
        };
        const talus::BodyIndex first = ground_first ? bodies.add_obstacle({}) : add_grain();
        const talus::BodyIndex second = ground_first ? add_grain() : bodies.add_obstacle({});
        talus::ContactJacobian<Dim> jacobian;
        jacobian.resize(1);
        jacobian.a = {first};
        jacobian.b = {second};
        const V of_ground = at<Dim>(0.49, 0.0), of_grain = at<Dim>(0.0, -0.1);
        jacobian.arm_a[0] = ground_first ? of_ground : of_grain;
        jacobian.arm_b[0] = ground_first ? of_grain : of_ground;
        const std::vector<V> forces{V((ground_first ? -9.81 : 9.81) * V::Unit(Dim - 1))};
        talus::GroundPressure<Dim> ground(talus::Rings<Dim>(at<Dim>(0.0, 0.0), 0.5, 3));
        ground.record(jacobian, forces, bodies,
                      [&](std::size_t i) { return bodies.is_obstacle(i); });
        BOOST_CHECK_CLOSE(ground.pressure(0) * ground.rings().area(0), 9.81, 1e-9);
        BOOST_TEST(ground.pressure(1) == 0.0);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_cone_has_its_slope, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Bodies<Dim> bodies;
    const double angle = 0.45;
    std::vector<double> radius;
    for (int k = 0; k < 400; ++k) {
        const double x = 0.01 * (k % 40) * (k % 2 == 0 ? 1.0 : -1.0), r = 0.001;
        // On the cone, or below it.
        const double depth = k < 40 ? 0.0 : 0.002 * (k / 40);
        bodies.add({1.0, talus::AngularVector<Dim>::Constant(1.0)},
                   {at<Dim>(x, 1.0 - std::tan(angle) * std::abs(x) - depth - r), {}});
        radius.push_back(r);
    }
    const talus::Rings<Dim> rings(at<Dim>(0.0, 0.0), 0.01, 60);
    const auto heights =
        talus::surface_heights(rings, bodies, radius, [](std::size_t) { return true; });
    std::vector<double> middle;
    for (std::size_t k = 0; k < rings.count(); ++k) middle.push_back(rings.middle(k));
    const talus::LineFit fit = talus::fit_line(middle, heights);
    BOOST_CHECK_CLOSE(fit.angle(), angle, 1.0);
    BOOST_TEST(fit.points >= 39u);
    BOOST_TEST(std::isnan(heights[59]));
    const std::vector<double> x{0.0, 1.0, 2.0}, y{1.0, -1.0, -3.0}, flat{1.0, 1.0, 1.0};
    BOOST_CHECK_CLOSE(talus::fit_line(x, y).slope, -2.0, 1e-12);
    BOOST_CHECK_CLOSE(talus::fit_line(x, y).at_zero, 1.0, 1e-12);
    BOOST_CHECK_THROW(talus::fit_line(flat, y), talus::input_error);
    BOOST_CHECK_THROW(talus::fit_line(std::span(x).first(1), std::span(y).first(1)),
                      talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
