// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/event_driven/event_driven.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <string>

/// Contacts with two tangential rows, and one that is curved: a particle of 1 kg.
BOOST_AUTO_TEST_SUITE(lagrangian_event_space)

using talus::ContactMode;
using talus::EventDrivenParams;
using talus::EventEnd;
using talus::EventKind;
using Three = Eigen::Vector3d;

namespace {

constexpr double g = 9.81;

/// On an incline, down along the first axis, or within a sphere of 1 m.
struct Particle {
    static constexpr int dof = 3, rows = 3;
    double mu = 0.0, slope = 0.0;
    bool in_bowl = false;
    double pull = 0.0;  // along the first axis, per second

    void mass(double, const auto&, auto& a) const { a.setIdentity(); }
    void force(double t, const auto&, const auto&, auto& f) const {
        f << g * std::sin(slope) + pull * t, 0.0, -g * std::cos(slope);
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        using Real = std::remove_cvref_t<decltype(q[0])>;
        const Real gap = in_bowl ? Real(1.0 - sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])) : q[2];
        auto& contact = contacts.add(gap, {{mu}, 0.0, 0.0}, "surface");
        if (in_bowl) return;
        contact.slide[0] = q[0];
        contact.slide[1] = q[1];
    }
};
using Sim = talus::EventDriven<Particle>;

}  // namespace

/// With the angle a between velocity and the line of slope, and k = mu / tan(slope),
///   |v| sin(a) tan(a / 2)^-k   is constant [by d|v|/da of the two equations of motion].
BOOST_AUTO_TEST_CASE(a_puck_on_an_incline_turns_downhill_as_its_first_integral_says) {
    constexpr double slope = 0.4, mu = 0.3;
    const double k = mu / std::tan(slope);
    Sim sim({.mu = mu, .slope = slope}, Three(0.0, 0.0, 0.0), Three(-0.5, 2.0, 0.0));
    const auto integral = [&](const Three& u) {
        const double a = std::atan2(u[1], u[0]);
        return u.norm() * std::sin(a) * std::pow(std::tan(0.5 * a), -k);
    };
    const double start = integral(sim.velocity());
    for (int part = 0; part < 4; ++part) {
        const auto run = sim.advance(0.1);
        BOOST_TEST((run.done() && run.events.empty()), to_string(run));
        BOOST_CHECK_SMALL(integral(sim.velocity()) / start - 1.0, 1e-9);
    }
    BOOST_TEST(sim.velocity()[0] > 0.2);
    BOOST_CHECK_SMALL(sim.position()[2], 1e-14);
}

BOOST_AUTO_TEST_CASE(a_puck_on_a_rough_incline_comes_to_rest_and_sticks) {
    constexpr double slope = 0.2, mu = 0.5;
    Sim sim({.mu = mu, .slope = slope}, Three(0.0, 0.0, 0.0), Three(1.0, 2.0, 0.0));
    const auto run = sim.advance(2.0);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.events.size() == 1u);
    BOOST_TEST((run.events.at(0).kind == EventKind::slip_to_stick));
    BOOST_TEST((sim.mode(0) == ContactMode::sticking));
    BOOST_CHECK_SMALL(sim.velocity().norm(), 1e-15);
    // d/dt (|v| (mu cot(slope) + cos(a))) = g sin(slope) (1 - k^2), for any friction.
    const double k = mu / std::tan(slope), speed = std::sqrt(5.0);
    const double stop = speed * (k + 1.0 / speed) / (g * std::sin(slope) * (k * k - 1.0));
    BOOST_CHECK_SMALL(run.events[0].time - stop, 1e-8);
}

BOOST_AUTO_TEST_CASE(where_a_puck_would_begin_to_slide_from_rest_is_said_not_to_be_supported) {
    constexpr double mu = 0.5;
    Sim sim({.mu = mu, .pull = 2.0}, Three(0.0, 0.0, 0.0));
    const auto run = sim.advance(4.0);
    BOOST_TEST((run.end == EventEnd::slip_in_space && !run.done()), to_string(run));
    BOOST_CHECK_SMALL(run.time - mu * g / 2.0, 1e-11);
    BOOST_TEST(sim.time() == run.time);
}

/// A contact that stays closed on a curved surface, for long: drift and energy, and where it opens.
BOOST_AUTO_TEST_CASE(a_particle_in_a_bowl_stays_on_it) {
    Sim sim({.in_bowl = true}, Three(0.6, 0.0, -0.8), Three(0.0, 2.0, 0.0));
    const auto energy = [&] { return 0.5 * sim.velocity().squaredNorm() + g * sim.position()[2]; };
    const auto spin = [&] {
        return sim.position()[0] * sim.velocity()[1] - sim.position()[1] * sim.velocity()[0];
    };
    const double start = energy();
    double worst = 0.0;
    for (int k = 0; k < 5; ++k) {
        const auto run = sim.advance(2.0);
        BOOST_TEST((run.done() && run.events.empty() && run.counted), to_string(run));
        worst = std::max(worst, run.gap_correction);
        BOOST_CHECK_SMALL(sim.position().norm() - 1.0, 1e-13);
        BOOST_CHECK_SMALL(sim.position().dot(sim.velocity()), 1e-13);
        BOOST_CHECK_SMALL(energy() - start, 1e-8);
        BOOST_CHECK_SMALL(spin() - 1.2, 1e-8);
    }
    BOOST_TEST_MESSAGE("bowl: gap taken back at most " << worst << ", energy " << energy() - start);
    BOOST_TEST((worst > 0.0 && worst < 1e-9));

    // From the bottom with v^2 = 4.5 g it leaves at cos = (4.5 - 2) / 3 from the top.
    Sim loop({.in_bowl = true}, Three(0.0, 0.0, -1.0), Three(std::sqrt(4.5 * g), 0.0, 0.0));
    const auto run = loop.advance(0.8);
    BOOST_TEST(run.count(EventKind::detachment) == 1u, to_string(run));
    const double leaves = run.events.at(0).time;
    Sim again({.in_bowl = true}, Three(0.0, 0.0, -1.0), Three(std::sqrt(4.5 * g), 0.0, 0.0));
    BOOST_TEST(again.advance(leaves).done());
    BOOST_CHECK_SMALL(again.position()[2] - 2.5 / 3.0, 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()
