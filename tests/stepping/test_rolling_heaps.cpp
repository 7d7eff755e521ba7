// SPDX-License-Identifier: BSL-1.0
// Rolling friction in scenes of several balls: symmetries, restarts, piles.
#include <talus/law/material_table.hpp>
#include <talus/spatial/tilt.hpp>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <vector>

#include "common/dimensions.hpp"
#include "heap.hpp"
#include "rolling_scene.hpp"

BOOST_AUTO_TEST_SUITE(stepping_rolling_heaps)

using namespace experiment;
using talus::RollingFriction;

/// Columns of balls on a floor, jittered by the seed: `wide` per horizontal axis and `high`.
template <int Dim, class Types, class Law>
talus::Simulation<Dim, Types> columns(const Law& law, int wide, int high, unsigned seed,
                                      talus::SimulationParams params = {}) {
    talus::Simulation<Dim, Types> sim(law, params);
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    std::mt19937 rng(seed);
    const int per_layer = Dim == 2 ? wide : wide * wide;
    const double pitch = 0.021;
    for (int k = 0; k < per_layer * high; ++k) {
        V<Dim> x = V<Dim>::Zero();
        x[0] = (k % wide - 0.5 * (wide - 1)) * pitch;
        if constexpr (Dim == 3) x[1] = (k / wide % wide - 0.5 * (wide - 1)) * pitch;
        x[Dim - 1] = (k / per_layer + 0.5) * pitch;
        x += random_input::vector<V<Dim>>(rng, 0.0005);
        system.add(talus::Ball<Dim>{random_input::uniform(rng, 0.008, 0.01)}, 2500.0, {x, {}});
    }
    return sim;
}

template <int Dim>
using Rolling = RollingTypes<Dim>;

BOOST_AUTO_TEST_CASE_TEMPLATE(without_mu_r_it_is_coulombs_law, D, dimensions) {
    constexpr int Dim = D::value;
    const auto run = [](auto sim) {
        sim.solver().params.tolerance = sim.solver().params.aim = 1e-13;
        for (int k = 0; k < 60; ++k) (void)sim.step();
        return everything(sim.system().bodies);
    };
    const auto with = run(columns<Dim, Rolling<Dim>>(RollingFriction<Dim>{0.4, 0.0}, 2, 3, 3));
    const auto without = run(columns<Dim, talus::SimulationTypes<Dim>>(law<Dim>(0.4), 2, 3, 3));
    BOOST_REQUIRE(with.size() == without.size());
    for (std::size_t i = 0; i < with.size(); ++i) BOOST_TEST(std::abs(with[i] - without[i]) < 1e-7);
}

/// Velocities after some steps of three balls that roll over each other on a slope, in the axes of
/// the slope; the scene turned by `angle`, the balls added in the order given.
template <int Dim>
std::vector<double> three_balls(double angle, const std::array<int, 3>& order) {
    auto sim =
        rolling_simulation<Dim>(RollingFriction<Dim>{0.5, 0.1}, 1e-3, V<Dim>(V<Dim>::Zero()));
    auto& system = sim.system();
    const talus::Rotation<Dim> turn = talus::tilt<Dim>(angle);
    system.gravity = turn * V<Dim>(3.0 * V<Dim>::Unit(0) - g * up<Dim>());
    system.add_obstacle(talus::HalfSpace<Dim>{turn * up<Dim>(), 0.0});
    // Two on the floor a little apart, the third upon them; in space the third is off their plane.
    std::array<V<Dim>, 3> at{R * up<Dim>(), R * up<Dim>() + 2.1 * R * V<Dim>::Unit(0),
                             2.6 * R * up<Dim>() + 1.05 * R * V<Dim>::Unit(0)};
    if constexpr (Dim == 3) at[2][1] = 0.1 * R;
    std::array<talus::BodyIndex, 3> body{};
    for (const int k : order)
        body[static_cast<std::size_t>(k)] =
            system.add(talus::Ball<Dim>{R}, 1000.0, {turn * at[static_cast<std::size_t>(k)], turn},
                       {V<Dim>::Zero(), turn.spin_world(rolling_spin<Dim>(0.5 * k - 0.3))});
    (void)sim.run(0.15);
    std::vector<double> all;
    for (const talus::BodyIndex i : body) {
        const auto twist = system.bodies.twist(static_cast<std::size_t>(i));
        for (const double x : turn.inverse() * twist.linear) all.push_back(x);
        for (const double x : turn.spin_body(twist.angular)) all.push_back(x);
    }
    return all;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(order_of_bodies_and_direction_of_axes_do_not_matter, D, dimensions) {
    constexpr int Dim = D::value;
    const auto plain = three_balls<Dim>(0.0, {0, 1, 2});
    for (const auto& other : {three_balls<Dim>(0.0, {2, 1, 0}), three_balls<Dim>(0.0, {1, 2, 0}),
                              three_balls<Dim>(0.7, {0, 1, 2})})
        for (std::size_t i = 0; i < plain.size(); ++i)
            BOOST_TEST(std::abs(other[i] - plain[i]) < 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_restart_makes_the_same_bits, D, dimensions) {
    constexpr int Dim = D::value;
    const RollingFriction<Dim> law{0.5, 0.1};
    auto through = columns<Dim, Rolling<Dim>>(law, 3, 4, 1);
    for (int k = 0; k < 150; ++k) (void)through.step();
    const auto state = through.state();
    BOOST_TEST(state.moment.size() == state.key.size());
    BOOST_TEST(!state.key.empty());
    auto other = columns<Dim, Rolling<Dim>>(law, 1, 1, 2);
    other.restore(state);
    const auto go_on = [](auto& sim) {
        for (int k = 0; k < 20; ++k) (void)sim.step();
        // Contacts of those that stay keep what they remember.
        sim.system().remove_if([](std::size_t i) { return i == 2 || i == 5; });
        for (int k = 0; k < 20; ++k) (void)sim.step();
    };
    go_on(through);
    go_on(other);
    BOOST_TEST(equal_bits(everything(through.system().bodies), everything(other.system().bodies)));
    // Without the moments it starts from somewhere else; with too few it does not start.
    auto short_of_one = state;
    short_of_one.moment.pop_back();
    BOOST_CHECK_THROW(other.restore(short_of_one), talus::input_error);
    auto without = state;
    without.moment.clear();
    other.restore(without);
    go_on(other);
    BOOST_TEST(!equal_bits(everything(through.system().bodies), everything(other.system().bodies)));
}

template <int Dim>
struct Corrected : Rolling<Dim> {
    using GapCorrection = talus::GapCorrection<Dim>;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(books_of_a_heap_close_in_either_scheme_and_corrected, D, dimensions) {
    constexpr int Dim = D::value;
    const auto check = [](auto sim) {
        const auto& bodies = sim.system().bodies;
        talus::EnergyLedger<Dim> books(bodies, sim.system().gravity);
        const auto run = sim.run(0.2, [&](const auto& s) { books.record(s.data(), bodies); });
        BOOST_TEST(run.certified(), to_string(run));
        BOOST_TEST(books.closure() < class_r);
        BOOST_TEST(books.flows().rolling < 0.0);
        BOOST_TEST(mismatch<Dim>(sim.data()) < class_r);
    };
    const RollingFriction<Dim> law{0.5, 0.1};
    talus::SimulationParams anticipating;
    anticipating.step.scheme = talus::Scheme::gap_anticipating;
    check(columns<Dim, Rolling<Dim>>(law, 3, 4, 1));
    check(columns<Dim, Rolling<Dim>>(law, 3, 4, 1, anticipating));
    check(columns<Dim, Corrected<Dim>>(law, 3, 4, 1));
}

/// Height over half-width of what became of a column, as of a triangle or cone.
template <int Dim>
double steepness(double mu_r, unsigned seed) {
    auto sim = columns<Dim, Rolling<Dim>>(RollingFriction<Dim>{0.5, mu_r}, Dim == 2 ? 5 : 3,
                                          Dim == 2 ? 10 : 6, seed);
    BOOST_TEST(sim.run(0.6).certified());
    const auto& bodies = sim.system().bodies;
    double height = 0.0, width = 0.0;
    for (std::size_t i = 1; i < bodies.count(); ++i) {
        height += bodies.position[i][Dim - 1];
        width += V<Dim>(bodies.position[i] - bodies.position[i][Dim - 1] * up<Dim>()).norm();
    }
    return height / width;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_pile_stands_steeper_with_rolling_friction, D, dimensions) {
    constexpr int Dim = D::value;
    for (const unsigned seed : {1u, 2u, 3u}) {
        const double without = steepness<Dim>(0.0, seed), with = steepness<Dim>(0.3, seed);
        BOOST_TEST(with > 1.5 * without);
        BOOST_TEST_MESSAGE(Dim << "D, seed " << seed << ": " << without << " and " << with);
    }
}

BOOST_AUTO_TEST_SUITE_END()
