// SPDX-License-Identifier: BSL-1.0
// Rolling friction between bodies, against closed forms: mu_r is the tangent of the slope on which
// a ball begins to roll.
#include <talus/geometry/box.hpp>
#include <talus/law/rolling_block.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/equilibrium.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random.hpp"
#include "rolling_scene.hpp"

BOOST_AUTO_TEST_SUITE(stepping_rolling_friction)

using namespace experiment;
using talus::RollingFriction;

// Rests iff mu_r >= slope, else rolls with g (sin - mu_r cos) / (1 + I / (m R^2)).
BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_rests_on_a_slope_up_to_mu_r_and_rolls_beyond, D, dimensions) {
    constexpr int Dim = D::value;
    const double slope = 0.2, h = 1e-3, duration = 0.1, cosine = 1.0 / std::hypot(1.0, slope);
    for (const double part : {0.0, 0.5, 0.999, 1.001, 3.0}) {
        const double mu_r = part * slope;
        auto sim = ball_on_a_slope<Dim>(RollingFriction<Dim>{.mu = 0.8, .mu_r = mu_r}, slope, h);
        const auto& bodies = sim.system().bodies;
        talus::EnergyLedger<Dim> books(bodies, sim.system().gravity);
        const auto run = sim.run(duration, [&](const auto& s) {
            books.record(s.data(), bodies);
            BOOST_TEST(mismatch<Dim>(s.data()) < class_r);
        });
        BOOST_TEST(run.certified());
        const double a = std::max(0.0, g * cosine * (slope - mu_r) / (1.0 + kap<Dim>));
        BOOST_TEST(largest(V<Dim>(bodies.velocity[1] - a * duration * V<Dim>::Unit(0))) < class_r);
        const W<Dim> spin = bodies.rotation[1].spin_world(bodies.spin[1]);
        BOOST_TEST(largest(W<Dim>(spin - rolling_spin<Dim>(a * duration / R))) < 10.0 * class_r);
        const auto& data = sim.data();
        BOOST_TEST(talus::residual<Dim>(data.problem, data.solution()).relative < 1e-12);
        // The moment that holds it, or all there is, against rolling. (The ball is the second
        // body.)
        const double moment = bodies.mass(1) * g * cosine * R * h * std::min(slope, mu_r);
        const W<Dim> error = talus::contact_moment(data, 0) - rolling_spin<Dim>(moment);
        BOOST_TEST(largest(error) < class_r * bodies.mass(1) * g * R * h);
        if (a > 0.1) {
            const double way = 0.5 * a * duration * duration, weight = bodies.mass(1) * g * cosine;
            BOOST_TEST(books.closure() < class_r);
            BOOST_TEST(std::abs(books.flows().rolling + mu_r * weight * way) < class_r * weight);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_rolling_ball_stops_after_the_distance_of_its_energy, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const double mu_r = 0.05, v = 0.3, h = 1e-3, brake = g * mu_r / (1.0 + kap<Dim>);
    auto sim = ball_on_a_slope<Dim>(RollingFriction<Dim>{.mu = 0.4, .mu_r = mu_r}, 0.0, h);
    auto& bodies = sim.system().bodies;
    bodies.velocity[1] = v * V<Dim>::Unit(0);
    bodies.spin[1] = rolling_spin<Dim>(v / R);
    if constexpr (Dim == 3) bodies.spin[1][2] = 7.0;  // about the normal: nothing stops that
    talus::EnergyLedger<Dim> books(bodies, sim.system().gravity);
    const double start = books.kinetic();
    const auto run =
        sim.run(1.5 * v / brake, [&](const auto& s) { books.record(s.data(), bodies); });
    BOOST_TEST(run.certified());
    // Exact but for the step within which it stops.
    BOOST_TEST(std::abs(bodies.position[1][0] - v * v / (2.0 * brake)) < brake * h * h);
    BOOST_TEST(bodies.velocity[1].norm() < class_r);
    double left = 0.0;
    if constexpr (Dim == 3) {
        const V<3> spin = bodies.rotation[1].spin_world(bodies.spin[1]);
        BOOST_TEST((spin - V<3>(0.0, 0.0, 7.0)).norm() < 10.0 * class_r);
        left = 0.5 * kap<3> * bodies.mass(1) * R * R * 49.0;
    }
    BOOST_TEST(books.closure() < class_r);
    BOOST_TEST(std::abs(books.flows().rolling + start - left) < 1e-10 * start);
    BOOST_TEST(std::abs(books.flows().friction) < 1e-10 * start);
}

// A skidding ball: friction spins it up against the moment, to rolling, all in one text.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_skidding_ball_begins_to_roll_later, D, dimensions) {
    constexpr int Dim = D::value;
    const double mu = 0.2, mu_r = 0.05, v = 1.0, h = 1e-4;
    auto sim = ball_on_a_slope<Dim>(RollingFriction<Dim>{.mu = mu, .mu_r = mu_r}, 0.0, h);
    auto& bodies = sim.system().bodies;
    bodies.velocity[1] = v * V<Dim>::Unit(0);
    // v - g mu t = R w,  w = g (mu - mu_r) t / (kap R)
    const double t = v / (g * (mu + (mu - mu_r) / kap<Dim>));
    for (const double part : {0.5, 0.9}) {
        BOOST_TEST(sim.run(part * t - sim.time()).certified());
        BOOST_TEST(std::abs(bodies.velocity[1][0] - v + g * mu * sim.time()) < class_r);
        BOOST_TEST(std::abs(bodies.spin[1].norm() - g * (mu - mu_r) * sim.time() / (kap<Dim> * R)) <
                   10.0 * class_r);
    }
    BOOST_TEST(sim.run(0.2 * t).certified());
    const double slip = bodies.velocity[1][0] - R * bodies.spin[1].norm();
    BOOST_TEST(std::abs(slip) < class_r);
}

// Without slip R_1 w_1 = -R_2 w_2; the couple mu_r L F brakes both, friction keeps the slip away.
BOOST_AUTO_TEST_CASE_TEMPLATE(two_balls_roll_on_each_other, D, dimensions) {
    constexpr int Dim = D::value;
    const double mu_r = 0.1, force = 50.0, h = 1e-3, w = 3.0;
    const double radius[2] = {0.2, 0.3};
    auto sim = rolling_simulation<Dim>(RollingFriction<Dim>{.mu = 0.5, .mu_r = mu_r}, h,
                                       V<Dim>(V<Dim>::Zero()));
    auto& system = sim.system();
    for (const int k : {0, 1}) {
        const double sign = k == 0 ? -1.0 : 1.0;
        system.add(talus::Ball<Dim>{radius[k]}, 1000.0, {sign * radius[k] * up<Dim>(), {}},
                   {V<Dim>::Zero(), rolling_spin<Dim>(-sign * w * radius[0] / radius[k])});
    }
    system.forces.push_back([force](double, const auto&, auto wrenches) {
        wrenches[0].force = force * up<Dim>();
        wrenches[1].force = -force * up<Dim>();
    });
    const auto& bodies = system.bodies;
    talus::EnergyLedger<Dim> books(bodies, system.gravity);
    const auto& data = sim.step();
    books.record(data, bodies);
    const double length = radius[0] * radius[1] / (radius[0] + radius[1]);
    BOOST_TEST(std::abs(data.problem.jacobian.rolling_length[0] - length) < class_r);
    double mobility = 0.0, lever = 0.0;  // of the slip: to friction, and to the couple
    for (const int k : {0, 1}) {
        const double m = bodies.mass(k), inertia = kap<Dim> * m * radius[k] * radius[k];
        mobility += 1.0 / m + radius[k] * radius[k] / inertia;
        lever += (k == 0 ? 1.0 : -1.0) * radius[k] / inertia;
    }
    const double couple = mu_r * length * force * h, friction = couple * lever / mobility;
    for (const int k : {0, 1}) {
        const double inertia = kap<Dim> * bodies.mass(k) * radius[k] * radius[k];
        const double braked = ((k == 0 ? -1.0 : 1.0) * couple + radius[k] * friction) / inertia;
        const double begin = (k == 0 ? 1.0 : -1.0) * w * radius[0] / radius[k];
        BOOST_TEST(largest(W<Dim>(data.end[k].angular - rolling_spin<Dim>(begin + braked))) <
                   class_r);
    }
    const auto slip = talus::contact_velocity(data, 0);
    BOOST_TEST(largest(slip) < class_r);
    BOOST_TEST(books.closure() < class_r);
    BOOST_TEST(books.flows().rolling < 0.0);
}

// Faces do not roll: a box slides as without. It tips where the weight gets beyond the edge by more
// than mu_r L, L half its least width.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_is_held_by_no_more_than_statics_says, D, dimensions) {
    constexpr int Dim = D::value;
    const double mu_r = 0.2, wide = 0.1, high = 0.3, h = 1e-3;
    const auto box_on_a_slope = [&](double mu, double slope) {
        const double cosine = 1.0 / std::hypot(1.0, slope);
        auto sim =
            rolling_simulation<Dim>(RollingFriction<Dim>{mu, mu_r}, h,
                                    V<Dim>(g * cosine * (slope * V<Dim>::Unit(0) - up<Dim>())));
        sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
        V<Dim> half = V<Dim>::Constant(0.5 * wide);
        half[Dim - 1] = 0.5 * high;
        sim.system().add(talus::Box<Dim>(half), 1000.0, {0.5 * high * up<Dim>(), {}});
        sim.solver().params.tolerance = sim.solver().params.aim = 1e-12;
        return sim;
    };
    const double mu = 0.1, slope = 0.3, duration = 0.05, cosine = 1.0 / std::hypot(1.0, slope);
    auto slides = box_on_a_slope(mu, slope);
    BOOST_TEST(slides.run(duration).certified());
    const auto& bodies = slides.system().bodies;
    W<Dim> spin = bodies.rotation[1].spin_world(bodies.spin[1]);
    double sideways = 0.0;
    if constexpr (Dim == 3) {
        // What presses more on one side than on the other, moments of rolling friction may hold: so
        // friction may turn it about the normal. The law leaves open how much, up to this.
        const double moment = mu * mu_r * 0.5 * wide * g * cosine * bodies.mass(1);
        BOOST_TEST(std::abs(spin[2]) < moment * duration * bodies.inverse_inertia[1][2]);
        sideways = std::abs(spin[2]) * wide;
        spin[2] = 0.0;
    }
    BOOST_TEST(largest(spin) < 1e-9);
    const double a = g * (slope - mu) * cosine;
    BOOST_TEST(std::abs(bodies.velocity[1][0] - a * duration) < 1e-9 + 0.1 * sideways);
    const double tips = (wide + 2.0 * mu_r * 0.5 * wide) / high;
    for (const double part : {0.97, 1.03}) {
        auto sim = box_on_a_slope(2.0, part * tips);
        BOOST_TEST((talus::equilibrium(sim.system()).verdict ==
                    (part < 1.0 ? talus::Verdict::equilibrium : talus::Verdict::moving)));
    }
}

// The step of one body that touches once is the exact one-contact solve.
BOOST_AUTO_TEST_CASE_TEMPLATE(one_contact_is_solved_as_rolling_block_does, D, dimensions) {
    constexpr int Dim = D::value, rows = talus::rows_with_rolling<Dim>;
    std::mt19937 rng(5);
    for (int k = 0; k < 30; ++k) {
        const RollingFriction<Dim> law{0.3, 0.2};
        auto sim = ball_on_a_slope<Dim>(law, 0.5, 1e-3);
        auto& bodies = sim.system().bodies;
        // A body whose centre is beside the normal and whose inertia is no multiple of the
        // identity.
        bodies.position[1][0] = 0.0;
        for (int i = 0; i < talus::rotation_dof<Dim>; ++i)
            bodies.inverse_inertia[1][i] *= random_input::uniform(rng, 0.5, 2.0);
        bodies.velocity[1] = random_input::vector<V<Dim>>(rng);
        bodies.velocity[1][Dim - 1] = -0.5;
        bodies.spin[1] = random_input::vector<W<Dim>>(rng, 4.0);
        bodies.position[1][Dim - 1] = R + 0.5e-3 * 0.5;  // touches at the midpoint
        const auto& data = sim.step();
        BOOST_REQUIRE(data.contact_count() == 1u);
        const talus::DelassusProduct<Dim, talus::AngularMatrix<Dim>, rows> w(
            data.problem.jacobian, data.problem.inverse_mass);
        const talus::Vector<rows> exact =
            talus::RollingBlock<rows>(w.diagonal_block(0))
                .solution(law.mu, law.mu_r, data.problem.free_velocity[0]);
        BOOST_TEST(largest(talus::Vector<rows>(data.solution()[0] - exact)) <
                   class_r * exact.norm());
        BOOST_TEST(mismatch<Dim>(data) < 10.0 * class_r);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_contacts_give_is_counted_with_the_moments, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = ball_on_a_slope<Dim>(RollingFriction<Dim>{0.8, 0.3}, 0.2, 1e-3);
    (void)sim.step();
    const auto& data = sim.step();
    const double weight = sim.system().bodies.mass(1) * g * data.h;
    // At rest nothing turns it: friction by its lever is what the moment holds.
    const auto on_ball = talus::wrench_impulse_on(data, 1);
    BOOST_TEST(largest(on_ball.torque) < class_r * weight * R);
    BOOST_TEST(largest(V<Dim>(on_ball.force + data.h * sim.system().bodies.mass(1) *
                                                  sim.system().gravity)) < class_r * weight);
    BOOST_TEST(largest(talus::contact_moment(data, 0)) > 0.1 * weight * R);
    const auto back = talus::wrench_impulse_between(data, 0, 1);
    BOOST_TEST(largest(V<Dim>(back.force + on_ball.force)) < class_r * weight);
    // Of the internal moment the part that is not symmetric balances the couple.
    std::vector<V<Dim>> forces;
    std::vector<talus::Matrix<Dim>> moments;
    talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces);
    talus::internal_moments<Dim>(data.problem.jacobian, forces, 2, moments);
    const double torque = (moments[1](0, Dim - 1) - moments[1](Dim - 1, 0)) * data.h;
    BOOST_TEST(std::abs(std::abs(torque) - largest(talus::contact_moment(data, 0))) <
               class_r * weight * R);
    // What was remembered solves the next step: no sweep is made.
    BOOST_TEST(data.recalled == 1u);
    BOOST_TEST(data.report.iterations <= 1);
    BOOST_TEST((talus::equilibrium(sim.system()).verdict == talus::Verdict::equilibrium));
}

// A floor that turns about an axis along itself takes a ball along by its moment: work of walls.
BOOST_AUTO_TEST_CASE_TEMPLATE(books_close_with_obstacles_that_turn, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim =
        rolling_simulation<Dim>(RollingFriction<Dim>{0.3, 0.1}, 1e-3, V<Dim>(-g * up<Dim>()));
    auto& system = sim.system();
    system.add_obstacle(talus::Ball<Dim>{0.5}, talus::PrescribedMotion<Dim>::uniform(
                                                   {}, {V<Dim>::Zero(), rolling_spin<Dim>(2.0)}));
    system.add(talus::Ball<Dim>{0.1}, 1000.0, {0.6 * up<Dim>(), {}});
    talus::EnergyLedger<Dim> books(system.bodies, system.gravity);
    const auto run =
        sim.run(0.3, [&](const auto& s) { books.record(s.data(), s.system().bodies); });
    BOOST_TEST(run.missed == 0);
    BOOST_TEST(books.closure() < class_r);
    BOOST_TEST(std::abs(books.flows().walls) > 1e-3);
    BOOST_TEST(books.flows().rolling < 0.0);
}

// Restitution e and the moment of the same impulse; cohesion adds to what a moment may be.
BOOST_AUTO_TEST_CASE_TEMPLATE(adaptors_take_rolling_friction_along, D, dimensions) {
    constexpr int Dim = D::value, rows = talus::rows_with_rolling<Dim>;
    const double e = 0.5, mu = 0.6, mu_r = 0.05, v = 2.0, w = 9.0;
    using Bouncing = talus::WeightedMean<rows, RollingFriction<Dim>>;
    auto sim = ball_on_a_slope<Dim>(Bouncing{{mu, mu_r}, e}, 0.0, 1e-4);
    auto& system = sim.system();
    system.gravity.setZero();
    system.bodies.velocity[1] = -v * up<Dim>() + w * R * V<Dim>::Unit(0);
    system.bodies.spin[1] = rolling_spin<Dim>(w);
    talus::EnergyLedger<Dim> books(system.bodies, system.gravity);
    books.record(sim.step(), system.bodies);
    BOOST_TEST(std::abs(system.bodies.velocity[1][Dim - 1] - e * v) < class_r);
    // It rolls on, slower: the moment impulse is mu_r R m (1 + e) v.
    const double lost = mu_r * (1.0 + e) * v / ((1.0 + kap<Dim>)*R);
    BOOST_TEST(std::abs(system.bodies.spin[1].norm() - (w - lost)) < 10.0 * class_r);
    BOOST_TEST(books.closure() < class_r);

    using Sticky = talus::Cohesive<rows, RollingFriction<Dim>>;
    const double h = 1e-3, slope = 0.2, cosine = 1.0 / std::hypot(1.0, slope);
    for (const double part : {0.99, 1.01}) {
        const double weight = system.bodies.mass(1) * g * cosine;
        const double pull = part * weight * (slope / mu_r - 1.0);  // that just holds it, at 1
        auto held = ball_on_a_slope<Dim>(Sticky{{mu, mu_r}, pull * h}, slope, h);
        BOOST_TEST(held.run(0.01).certified());
        BOOST_TEST((held.system().bodies.spin[1].norm() > 1e-6) == (part < 1.0));
    }
}

template <class Action>
std::string refusal(Action&& action) {
    try {
        action();
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return "";
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_coefficients_are_refused_by_name, D, dimensions) {
    constexpr int Dim = D::value;
    using Simulation = RollingSimulation<Dim, RollingFriction<Dim>>;
    const auto says = [](const std::string& sentence, const std::string& word) {
        return sentence.find(word) != std::string::npos;
    };
    const std::string said = refusal([] { Simulation sim({.mu = 0.5, .mu_r = -0.25}); });
    BOOST_TEST(says(said, "law.mu_r"), said);
    BOOST_TEST(says(said, "-0.25"), said);
    BOOST_TEST(says(said, "finite and not negative"), said);
    Simulation sim({.mu = 0.5, .mu_r = 0.25});
    const std::string pair = refusal([&] { sim.system().laws.set(0, 0, {0.5, std::nan("")}); });
    BOOST_TEST(says(pair, "law of materials (0, 0).mu_r"), pair);
    BOOST_TEST(sim.system().laws.at(0, 0).mu_r == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()
