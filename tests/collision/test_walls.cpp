// SPDX-License-Identifier: BSL-1.0
// Round holes: contacts against the points of a body that are farthest out, and a ball that swings
// in a hollow, against closed forms.
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/dimensions.hpp"
#include "common/ellipsoid.hpp"
#include "common/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(collision_walls)

template <int Dim>
talus::RoundHole<Dim> hole(double radius) {
    if constexpr (Dim == 2)
        return talus::RoundHole<2>(radius);
    else
        return talus::RoundHole<3>(radius, talus::Vector<3>(0.2, -1.0, 0.4));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_touch_a_hole_where_they_are_farthest_out, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    random_geometry::Generator g(17);
    std::vector<V> corners{V::Constant(-0.1)};
    for (int k = 0; k < Dim; ++k) corners.push_back(0.3 * V::Unit(k));
    const std::vector<talus::AnyShape<Dim>> bodies{
        talus::Ball<Dim>(0.3), talus::Box<Dim>(V::Constant(0.2)), talus::Capsule<Dim>(0.2, 0.1),
        talus::ConvexPolytope<Dim>(corners),
        talus::Compound<Dim>({{talus::Ball<Dim>(0.2), {}},
                              {talus::Box<Dim>(V::Constant(0.1)), {0.3 * V::Unit(0), {}}}})};
    for (int trial = 0; trial < 200; ++trial) {
        const auto& body = bodies[static_cast<std::size_t>(trial) % bodies.size()];
        const talus::Pose<Dim> at = random_geometry::pose<Dim>(g, 1.0);
        const talus::Pose<Dim> wall = random_geometry::pose<Dim>(g, 0.3);
        const talus::AnyShape<Dim> outside = hole<Dim>(1.5);
        talus::Column<talus::ContactPoint<Dim>> out, mirrored;
        talus::contact_points<Dim>(body, at, outside, wall, 10.0, out);
        talus::contact_points<Dim>(outside, wall, body, at, 10.0, mirrored);
        BOOST_REQUIRE(!out.empty());
        BOOST_REQUIRE(out.size() == mirrored.size());
        double deepest = 10.0;
        for (std::size_t k = 0; k < out.size(); ++k) {
            const auto& c = out[k];
            // The ends of the gap: on the wall, and on the body.
            const auto placed = hole<Dim>(1.5).placed(wall);
            const V on_wall = c.point - 0.5 * c.gap * c.normal;
            BOOST_TEST(std::abs(placed.across(on_wall).norm() - 1.5) < 1e-12);
            BOOST_TEST((placed.across(on_wall) + 1.5 * c.normal).norm() < 1e-12);
            BOOST_TEST((mirrored[k].normal + c.normal).norm() < 1e-12);
            BOOST_TEST(std::abs(mirrored[k].gap - c.gap) < 1e-12);
            deepest = std::min(deepest, c.gap);
        }
        // Nothing of the body is farther out: sampled in all directions by the support of its hull.
        double farthest = 0.0;
        const auto placed = hole<Dim>(1.5).placed(wall);
        body.visit([&]<class S>(const S& s) {
            if constexpr (talus::ConvexShape<S, Dim>)
                for (int k = 0; k < 2000; ++k) {
                    const V d = random_geometry::direction<Dim>(g);
                    farthest =
                        std::max(farthest, placed.across(at.point_world(s.support(d))).norm());
                }
        });
        if (farthest > 0.0) {
            BOOST_TEST(1.5 - farthest > deepest - 1e-9);
            BOOST_TEST(1.5 - farthest < deepest + 0.05);
        }
        // No nearer than the margin: nothing.
        out.clear();
        talus::contact_points<Dim>(body, at, outside, wall, deepest - 1e-9, out);
        BOOST_TEST(out.empty());
    }
    BOOST_CHECK_THROW(hole<Dim>(0.0), talus::input_error);
    if constexpr (Dim == 3)
        BOOST_CHECK_THROW(talus::RoundHole<3>(1.0, talus::Vector<3>::Zero()), talus::input_error);
    const auto same = talus::from_record<talus::RoundHole<Dim>>(talus::record_of(hole<Dim>(2.0)));
    BOOST_TEST((same.axis() == hole<Dim>(2.0).axis()));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_shape_of_ones_own_touches_a_hole_on_both_sides, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    V axes = V::Constant(0.2);
    axes[0] = 1.0;
    const Ellipsoid<Dim> long_one{axes};
    const auto round = [] {
        if constexpr (Dim == 2)
            return talus::RoundHole<2>(1.02);
        else
            return talus::RoundHole<3>(1.02, V::Unit(1));
    }();
    for (const double off : {0.0, 0.005, -0.005}) {
        const talus::Pose<Dim> pose{V(off * V::Unit(0)), {}};
        talus::Column<talus::ContactPoint<Dim>> out;
        talus::contact_points<Dim>(long_one, pose, round, talus::Pose<Dim>{}, 0.1, out);
        BOOST_REQUIRE(out.size() == 2u);
        BOOST_TEST((out[0].feature != out[1].feature));
        double left = 1.0, right = 1.0;
        for (const auto& c : out) (c.normal[0] > 0.0 ? left : right) = c.gap;
        BOOST_CHECK_SMALL(right - (0.02 - off), 1e-9);
        BOOST_CHECK_SMALL(left - (0.02 + off), 1e-9);
    }
    // What touches at one end alone has one contact within a smaller margin.
    talus::Column<talus::ContactPoint<Dim>> out;
    talus::contact_points<Dim>(long_one, {V(0.015 * V::Unit(0)), {}}, round, talus::Pose<Dim>{},
                               0.01, out);
    BOOST_TEST(out.size() == 1u);
}

/// Period of small swings in a hollow of radius R: sqrt((1 + kap) (R - r) / g) if it rolls, kap = 0
/// if it slides [s].
template <int Dim>
void swings(double mu, double kap) {
    using V = talus::Vector<Dim>;
    const double R = 1.0, r = 0.1, g = 9.81, amplitude = 0.01;
    talus::Simulation<Dim> sim(talus::DefaultLaw<Dim>{{mu}, 0.0, 0.0}, {.h = 2e-4});
    sim.solver().params.tolerance = sim.solver().params.aim = 1e-10;
    auto& system = sim.system();
    const V up = V::Unit(Dim - 1);
    system.gravity = -g * up;
    if constexpr (Dim == 2)
        system.add_obstacle(talus::RoundHole<2>(R));
    else
        system.add_obstacle(talus::RoundHole<3>(R, V::Unit(1)));
    const V start = (R - r) * (std::sin(amplitude) * V::Unit(0) - std::cos(amplitude) * up);
    const auto ball = system.add(talus::Ball<Dim>(r), 1000.0, {start, {}});
    const double period = 2.0 * std::numbers::pi * std::sqrt((1.0 + kap) * (R - r) / g) *
                          (1.0 + amplitude * amplitude / 16.0);
    // A quarter of the way through the lowest point; three quarters through it back.
    std::vector<double> crossings;
    double last = start[0];
    BOOST_TEST(sim.run(1.1 * period,
                       [&](const auto& s) {
                           const double x = s.system().bodies.position[ball][0];
                           if ((x > 0.0) != (last > 0.0))
                               crossings.push_back(s.time() - s.params().h * x / (x - last));
                           last = x;
                       })
                   .certified());
    BOOST_REQUIRE(crossings.size() == 2u);
    BOOST_CHECK_CLOSE(2.0 * (crossings[1] - crossings[0]), period, 0.1);
    const double radius = system.bodies.position[ball].norm();
    BOOST_CHECK_SMALL(radius - (R - r), 1e-5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_swings_in_a_hollow, D, dimensions) {
    constexpr int Dim = D::value;
    swings<Dim>(0.0, 0.0);
    swings<Dim>(1.0, Dim == 2 ? 0.5 : 0.4);
}

BOOST_AUTO_TEST_SUITE_END()
