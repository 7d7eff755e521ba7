// SPDX-License-Identifier: BSL-1.0
// Inlets keep their rate, their distance and their seed; sinks count what they take.
#include <talus/feed/inlet.hpp>
#include <talus/feed/sink.hpp>
#include <talus/sample/container.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(feed)

template <int Dim>
using V = talus::Vector<Dim>;

template <int Dim>
V<Dim> point(double x, double up) {
    V<Dim> p = V<Dim>::Zero();
    p[0] = x;
    p[Dim - 1] = up;
    return p;
}

template <int Dim>
talus::Simulation<Dim> silo() {
    talus::Simulation<Dim> sim(talus::DefaultLaw<Dim>{{0.3}, 0.0, 0.0},
                               {.h = 2e-3, .step = {.scheme = talus::Scheme::gap_anticipating}});
    sim.system().gravity = -9.81 * V<Dim>::Unit(Dim - 1);
    V<Dim> low = V<Dim>::Constant(-0.2), high = V<Dim>::Constant(0.2);
    low[Dim - 1] = 0.0;
    high[Dim - 1] = 1.0;
    for (const auto& wall : talus::container<Dim>(low, high)) sim.system().add_obstacle(wall);
    return sim;
}

template <int Dim>
talus::InletParams<Dim> rain() {
    V<Dim> low = V<Dim>::Constant(-0.15), high = V<Dim>::Constant(0.15);
    low[Dim - 1] = high[Dim - 1] = 0.8;
    return {.place = talus::in_box<Dim>(low, high),
            .shape = talus::balls<Dim>(talus::UniformRadii(0.01, 0.02)),
            .rate = 100.0,
            .total = 40,
            .velocity = -1.0 * V<Dim>::Unit(Dim - 1)};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_inlet_keeps_its_rate_and_its_total, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = silo<Dim>();
    talus::Inlet<Dim> inlet(rain<Dim>());
    double half = 0.0;
    BOOST_TEST(sim.run(0.6,
                       [&](auto&) {
                           inlet.feed(sim.system(), sim.time());
                           if (std::abs(sim.time() - 0.2) < 1e-9)
                               half = static_cast<double>(inlet.count());
                       })
                   .certified());
    BOOST_TEST(half == 20.0);
    BOOST_TEST(inlet.count() == 40);
    BOOST_TEST(inlet.done());
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        if (!sim.system().bodies.is_obstacle(i))
            BOOST_TEST(sim.system().bodies.position[i][Dim - 1] > 0.0);
    // What a sink took may come again.
    inlet.owe(2);
    BOOST_TEST(!inlet.done());
    BOOST_TEST(inlet.feed(sim.system(), sim.time()) == 2u);
    BOOST_TEST(inlet.done());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_crowded_inlet_does_not_prefer_small_bodies, D, dimensions) {
    constexpr int Dim = D::value;
    auto params = rain<Dim>();
    params.place = talus::at_point<Dim>(point<Dim>(0.0, 0.5));
    params.shape = talus::balls<Dim>(talus::UniformRadii(0.005, 0.015));
    params.rate = 1e6;
    params.total = 400;
    talus::Inlet<Dim> inlet(params);
    talus::System<Dim> system(talus::DefaultLaw<Dim>{{0.3}, 0.0, 0.0});
    // What came goes on by a little in each turn, and out of the way in the end.
    double sum = 0.0;
    while (!inlet.done()) {
        inlet.feed(system, 1.0);
        auto& bodies = system.bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i) bodies.position[i][0] += 5e-4;
        system.remove_if([&](std::size_t i) {
            const bool gone = bodies.position[i][0] > 0.05;
            if (gone) sum += system.half_thickness()[i];
            return gone;
        });
    }
    for (const double radius : system.half_thickness()) sum += radius;
    BOOST_CHECK_CLOSE(sum / 400.0, 0.01, 5.0);  // three standard errors
}

BOOST_AUTO_TEST_CASE_TEMPLATE(no_body_comes_where_there_is_no_room, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = silo<Dim>();
    auto params = rain<Dim>();
    params.place = talus::at_point<Dim>(point<Dim>(0.0, 0.5));
    params.shape = [](talus::Random&) { return talus::Ball<Dim>(0.05); };
    params.rate = 1e6;
    params.clearance = 0.01;
    params.velocity = V<Dim>::Zero();
    talus::Inlet<Dim> inlet(params);
    BOOST_TEST(inlet.feed(sim.system(), 1.0) == 1u);  // the next would be where it is
    BOOST_TEST(inlet.feed(sim.system(), 1.0) == 0u);
    BOOST_TEST(inlet.due(1.0) == 39);
    auto& bodies = sim.system().bodies;
    const std::size_t last = bodies.count() - 1;
    bodies.position[last] = point<Dim>(0.0, 0.5 - 0.1 - 0.0099);
    BOOST_TEST(inlet.feed(sim.system(), 1.0) == 0u);
    bodies.position[last] = point<Dim>(0.0, 0.5 - 0.1 - 0.0101);
    BOOST_TEST(inlet.feed(sim.system(), 1.0) == 1u);
    // Nor in a wall.
    params.place = talus::at_point<Dim>(point<Dim>(0.199, 0.9));
    talus::Inlet<Dim> blocked(params);
    BOOST_TEST(blocked.feed(sim.system(), 1.0) == 0u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_stopped_inlet_goes_on_with_the_same_bodies, D, dimensions) {
    constexpr int Dim = D::value;
    auto through = silo<Dim>(), stopped = silo<Dim>();
    talus::Inlet<Dim> one(rain<Dim>()), other(rain<Dim>());
    for (int k = 0; k < 150; ++k) {
        through.step();
        one.feed(through.system(), through.time());
        if (k == 60) {
            const auto record = talus::record_of(other);
            talus::Inlet<Dim> next(rain<Dim>());
            next.restore(record);
            other = next;
        }
        stopped.step();
        other.feed(stopped.system(), stopped.time());
    }
    BOOST_TEST(one.count() > 25);
    const auto &a = through.system().bodies, &b = stopped.system().bodies;
    BOOST_REQUIRE(a.count() == b.count());
    for (std::size_t i = 0; i < a.count(); ++i) {
        BOOST_TEST((a.position[i] == b.position[i]));
        BOOST_TEST(a.inverse_mass[i] == b.inverse_mass[i]);
    }
    BOOST_CHECK_THROW(other.restore(talus::NumberRecord{}), talus::input_error);
    BOOST_TEST(other.count() == one.count());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sink_takes_what_is_there_and_counts_it, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = silo<Dim>();
    auto& system = sim.system();
    double mass = 0.0;
    for (int k = 0; k < 6; ++k) {
        const auto body =
            system.add(talus::Ball<Dim>(0.02), 1000.0, {point<Dim>(0.0, 0.1 + 0.1 * k), {}});
        if (k < 3) mass += system.bodies.mass(body);
    }
    const std::size_t before = system.bodies.count();
    auto sink = talus::Sink<Dim>::below(2.0 * V<Dim>::Unit(Dim - 1), 0.35);
    BOOST_TEST(sink.drain(system) == 3u);
    BOOST_TEST(sink.taken().size() == 3u);
    BOOST_TEST(sink.drain(system) == 0u);
    BOOST_TEST(system.bodies.count() == before - 3);
    BOOST_CHECK_CLOSE(sink.mass(), mass, 1e-12);
    auto again = talus::Sink<Dim>::below(V<Dim>::Unit(Dim - 1), 0.35);
    again.restore(talus::record_of(sink));
    BOOST_TEST(again.count() == 3);
    auto far = talus::Sink<Dim>::outside(V<Dim>::Constant(-0.45), V<Dim>::Constant(0.45));
    BOOST_TEST(far.drain(system) == 2u);  // those at 0.5 and 0.6
}

BOOST_AUTO_TEST_CASE_TEMPLATE(places_cover_what_they_say, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(4);
    const V<Dim> axis = V<Dim>::Ones(), centre = V<Dim>::Constant(0.3);
    const auto disc = talus::in_disc<Dim>(centre, 2.0, axis);
    const auto segment = talus::on_segment<Dim>(V<Dim>::Zero(), 2.0 * axis);
    constexpr int draws = 20000;
    V<Dim> mean = V<Dim>::Zero(), mean_on_segment = V<Dim>::Zero();
    double square = 0.0, turned = 0.0;
    for (int k = 0; k < draws; ++k) {
        const V<Dim> way = disc(random) - centre;
        BOOST_REQUIRE(std::abs(way.dot(axis)) < 1e-12);
        BOOST_REQUIRE(way.norm() <= 2.0);
        mean += way / draws;
        square += way.squaredNorm() / draws;
        mean_on_segment += segment(random) / draws;
        turned += (talus::random_rotation<Dim>(random) * V<Dim>::Unit(0))[0] / draws;
    }
    BOOST_TEST(mean.norm() < 0.05);
    // Mean square distance over a disc is R^2 / 2, over a segment R^2 / 3.
    BOOST_CHECK_CLOSE(square, Dim == 2 ? 4.0 / 3.0 : 2.0, 3.0);
    BOOST_TEST((mean_on_segment - axis).norm() < 0.05);
    BOOST_TEST(std::abs(turned) < 0.03);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(numbers_out_of_range_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    const auto refused = [](auto change) {
        auto params = rain<Dim>();
        change(params);
        BOOST_CHECK_THROW(talus::Inlet<Dim>{params}, talus::input_error);
    };
    refused([](auto& p) { p.rate = -1.0; });
    refused([](auto& p) { p.density = 0.0; });
    refused([](auto& p) { p.total = -1; });
    refused([](auto& p) { p.clearance = std::nan(""); });
    refused([](auto& p) { p.tries = 0; });
    refused([](auto& p) { p.place = nullptr; });
    refused([](auto& p) { p.shape = nullptr; });
    refused([](auto& p) { p.velocity[0] = std::nan(""); });
    const V<Dim> zero = V<Dim>::Zero(), one = V<Dim>::Ones();
    BOOST_CHECK_THROW(talus::in_box<Dim>(one, zero), talus::input_error);
    talus::Inlet<Dim> inlet(rain<Dim>());
    for (const double t : {std::nan(""), HUGE_VAL})
        BOOST_CHECK_THROW((void)inlet.due(t), talus::input_error);
    inlet.owe(std::size_t{1} << 59);
    BOOST_CHECK_THROW(inlet.owe(std::size_t{1} << 59), talus::input_error);
    BOOST_CHECK_THROW(inlet.owe(static_cast<std::size_t>(-1)), talus::input_error);
    BOOST_CHECK_THROW(talus::in_disc<Dim>(zero, 0.0, one), talus::input_error);
    BOOST_CHECK_THROW(talus::in_disc<Dim>(zero, 1.0, zero), talus::input_error);
    BOOST_CHECK_THROW(talus::Sink<Dim>::below(zero, 0.0), talus::input_error);
    BOOST_CHECK_THROW(talus::Sink<Dim>::outside(one, zero), talus::input_error);
    BOOST_CHECK_THROW(talus::container<Dim>(one, zero), talus::input_error);
    BOOST_TEST(talus::container<Dim>(zero, one).size() == 2u * Dim - 1u);
    BOOST_TEST(talus::container<Dim>(zero, one, talus::Lid::closed).size() == 2u * Dim);
}

BOOST_AUTO_TEST_SUITE_END()
