// SPDX-License-Identifier: BSL-1.0
// Validation cases A01, A02, A04 and A09: one body, one law, exact answers at every step size.
#include <talus/geometry/box.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_single_contact)

using namespace experiment;

constexpr double radius = 0.3;

/// A point block: a body that slides on one contact and does not turn.
template <int Dim>
talus::BodyIndex add_block(talus::Simulation<Dim>& sim, const V<Dim>& velocity) {
    return sim.system().add(talus::Ball<Dim>{radius}, point_mass<Dim>(1.0),
                            {radius * up<Dim>(), {}}, {velocity, W<Dim>::Zero()});
}

// --- A01: incline-threshold ------------------------------------------------------------------

/// Steps a body from rest on an incline of 20 degrees (tan = 0.36397); checks u and x along the
/// way.
template <int Dim>
void check_incline(talus::Simulation<Dim>& sim, talus::BodyIndex body, double mu,
                   double tolerance) {
    const auto i = static_cast<std::size_t>(body);
    const double slope = 20.0 * pi / 180.0;
    const double a = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
    const V<Dim> start = sim.system().bodies.position[i];
    double error_u = 0.0, error_x = 0.0;
    sim.run(1.0, [&](const auto& s) {
        const auto& bodies = s.system().bodies;
        const double t = s.time();
        error_u = std::max(error_u, largest(bodies.velocity[i] - in_plane<Dim>(a * t, 0.0)));
        error_x = std::max(
            error_x, largest(bodies.position[i] - start - in_plane<Dim>(0.5 * a * t * t, 0.0)));
    });
    BOOST_TEST_CONTEXT("mu = " << mu << ", h = " << sim.params().h) {
        BOOST_CHECK_LT(error_u, tolerance);
        BOOST_CHECK_LT(error_x, tolerance);
    }
}

template <int Dim>
talus::Simulation<Dim> incline(double mu, double h) {
    const double slope = 20.0 * pi / 180.0;
    return simulation<Dim>(law<Dim>(mu), h,
                           in_plane<Dim>(g * std::sin(slope), -g * std::cos(slope)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_block_on_an_incline_holds_or_slides_exactly, D, dimensions) {
    constexpr int Dim = D::value;
    for (double h : {1e-2, 1e-4})
        for (double mu : {0.3650, 0.3629}) {
            auto sim = incline<Dim>(mu, h);
            const auto body = add_block<Dim>(sim, V<Dim>::Zero());
            // Rounding of u accumulates over 1 / h steps of increments g h.
            check_incline(sim, body, mu, class_r * g);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_on_an_incline_holds_or_slides_exactly, D, dimensions) {
    constexpr int Dim = D::value;
    V<Dim> half = V<Dim>::Constant(0.2);
    half[Dim - 1] = 0.1;
    for (double h : {1e-2, 1e-3})
        for (double mu : {0.3650, 0.3629}) {
            auto sim = incline<Dim>(mu, h);
            const auto body = sim.system().add(talus::Box<Dim>{half}, 1.0 / (8.0 * half.prod()),
                                               {half[Dim - 1] * up<Dim>(), {}});
            // Class S, with 1 / h steps to add up: hyperstatic corners.
            check_incline(sim, body, mu, 100 * solver_tolerance * g / h);
        }
}

// --- A02: slide-to-stop ------------------------------------------------------------------------

/// Distance travelled until rest; checks that rest is exact.
template <int Dim>
V<Dim> stop_distance(double mu, double h, const V<Dim>& velocity) {
    auto sim = simulation<Dim>(law<Dim>(mu), h, -g * up<Dim>());
    const auto i = static_cast<std::size_t>(add_block<Dim>(sim, velocity));
    const double t_stop = velocity.norm() / (mu * g);
    sim.run(h * std::ceil(t_stop / h));
    BOOST_CHECK_SMALL(largest(sim.system().bodies.velocity[i]), class_r);
    const V<Dim> stopped = sim.system().bodies.position[i] - radius * up<Dim>();
    sim.run(20 * h);
    BOOST_CHECK_SMALL(largest(sim.system().bodies.position[i] - radius * up<Dim>() - stopped),
                      class_r);
    return stopped;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sliding_block_stops_where_the_discrete_formula_says, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const double v = 3.0, mu = 0.3;
    const double t_stop = v / (mu * g), d = v * v / (2 * mu * g);
    BOOST_CHECK_CLOSE(d, 1.529051988, 1e-7);
    V<Dim> direction = V<Dim>::Unit(0);
    if constexpr (Dim == 3) direction = {std::cos(37 * pi / 180), std::sin(37 * pi / 180), 0.0};
    for (double h : {1e-2, 5e-3, 3e-3, 7e-4}) {
        const V<Dim> seen = stop_distance<Dim>(mu, h, v * direction);
        const double r = t_stop - h * std::floor(t_stop / h);
        const double excess = mu * g * r * (h - r) / 2;
        BOOST_CHECK_SMALL(seen.dot(direction) - (d + excess), 2 * class_r);
        BOOST_CHECK_SMALL(largest(seen - seen.dot(direction) * direction), 2 * class_r);
        BOOST_CHECK_LE(std::abs(seen.norm() - d), mu * g * h * h / 8 + class_r);
    }
}

// --- A04: slide-to-roll ----------------------------------------------------------------------

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sliding_ball_rolls_at_the_exact_speed, D, dimensions) {
    constexpr int Dim = D::value;
    const double v = 2.0, mu = 0.3, m = 1.7, k = kap<Dim>;
    const double t_roll = v / (mu * g) * k / (1 + k);
    const double slid = v * v / (mu * g) * (Dim == 2 ? 5.0 / 18.0 : 12.0 / 49.0);
    for (double h : {7e-3, 3e-3, 1e-3, 4e-4}) {
        auto sim = simulation<Dim>(law<Dim>(mu), h, -g * up<Dim>());
        const auto i = static_cast<std::size_t>(
            sim.system().add(talus::Ball<Dim>{radius}, round_inertia<Dim>(m, radius),
                             {radius * up<Dim>(), {}}, {in_plane<Dim>(v, 0), W<Dim>::Zero()}));
        double first_sticking_end = 0.0;
        sim.run(0.5, [&](const auto& s) {
            const V<Dim> slip =
                talus::relative_velocity<Dim>(s.data().problem.jacobian, 0, s.data().end);
            if (first_sticking_end == 0.0 && largest(slip) < 1e-12) first_sticking_end = s.time();
        });
        const auto& bodies = sim.system().bodies;
        BOOST_CHECK_SMALL(largest(bodies.velocity[i] - in_plane<Dim>(v / (1 + k), 0)), class_r * v);
        BOOST_CHECK_SMALL(
            largest(bodies.twist(i).angular - rolling_spin<Dim>(v / (1 + k) / radius)),
            class_r * v / radius);
        // Rolling starts in the step that contains t_roll.
        BOOST_CHECK_GE(first_sticking_end, t_roll - 1e-9);
        BOOST_CHECK_LE(first_sticking_end, t_roll + h + 1e-9);
        // Distance: exact but for the step of the event, an error of second order.
        const double x = slid + (sim.time() - t_roll) * v / (1 + k);
        BOOST_CHECK_LE(std::abs(bodies.position[i][0] - x), mu * g * h * h / 8 + class_r);
    }
}

// --- A09: coulomb-isotropy -----------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(friction_in_space_has_no_preferred_direction) {
    const double v = 2.0, mu = 0.3, d = v * v / (2 * mu * g);
    double shortest = 1e9, longest = 0.0, heading_error = 0.0;
    for (int degree = 0; degree <= 90; ++degree) {
        const double azimuth = degree * pi / 180;
        const V<3> direction(std::cos(azimuth), std::sin(azimuth), 0.0);
        const V<3> stop = stop_distance<3>(mu, 1e-3, v * direction);
        shortest = std::min(shortest, stop.norm());
        longest = std::max(longest, stop.norm());
        heading_error = std::max(heading_error, direction.cross(stop).norm() / stop.norm());
    }
    BOOST_CHECK_LE(heading_error, 1e-11);
    BOOST_CHECK_LE((longest - shortest) / d, 1e-11);
    BOOST_CHECK_CLOSE(longest, d, 1e-3);
}

BOOST_AUTO_TEST_CASE(the_choice_of_tangents_does_not_matter) {
    // The same block on floors of different normals: each gives other tangents.
    const double v = 2.0, mu = 0.3, h = 1e-3;
    std::vector<V<3>> stops;
    for (int k = 0; k < 3; ++k) {
        const auto turn = talus::Rotation<3>::exp({0.7 * k, -1.1 * k, 0.4 * k});
        auto sim = simulation<3>(law<3>(mu), h, turn * V<3>(0, 0, -g), false);
        sim.system().add_obstacle(talus::HalfSpace<3>{turn * V<3>(0, 0, 1), 0.0});
        sim.system().add(talus::Ball<3>{radius}, point_mass<3>(1.0),
                         {turn * V<3>(0, 0, radius), {}}, {turn * V<3>(1.6, 1.2, 0) * v / 2});
        sim.run(1.0);
        stops.push_back(turn.transpose_times(sim.system().bodies.position[1]));
    }
    for (const auto& stop : stops) BOOST_CHECK_SMALL(largest(stop - stops[0]), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
