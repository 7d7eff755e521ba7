// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/event_driven/event_driven.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lagrangian/planar_body.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_event_driven)

using machines::PlanarBody;
using machines::SlidingRod;
using machines::Three;
using talus::ContactMode;
using talus::EventDrivenParams;
using talus::EventEnd;
using talus::EventKind;
using talus::EventReport;
using Sim = talus::EventDriven<PlanarBody>;

namespace {

constexpr double g = 9.81;

PlanarBody ball(double restitution) {
    PlanarBody body;
    body.restitution = restitution;
    return body;
}
/// A block on a plane inclined by `slope`, down to the right.
PlanarBody block(double slope, double mu) {
    PlanarBody body;
    body.mu = mu;
    body.gravity = g * Eigen::Vector2d(std::sin(slope), -std::cos(slope));
    return body;
}
std::string complaint(const std::function<void()>& f) {
    try {
        f();
    } catch (const talus::input_error& e) {
        return e.what();
    }
    return "nothing";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_bouncing_ball_is_where_its_closed_form_says) {
    constexpr double e = 0.8, height = 1.0;
    Sim sim(ball(e), Three(0.0, height, 0.0), Three(0.3, 0.0, 2.0));
    const double fall = std::sqrt(2.0 * height / g), speed = g * fall;
    const EventReport run = sim.advance(3.0);
    BOOST_TEST(run.done(), to_string(run));
    double t = fall, up = e * speed;
    for (const auto& event : run.events) {
        BOOST_TEST((event.kind == EventKind::impact));
        BOOST_CHECK_SMALL(event.time - t, 1e-11);
        BOOST_CHECK_SMALL(event.approach + up / e, 1e-10);
        BOOST_CHECK_SMALL(event.impulse - (1.0 + e) * up / e, 1e-10);
        t += 2.0 * up / g;
        up *= e;
    }
    BOOST_TEST(t > 3.0);
    BOOST_TEST(run.events.size() == 6u);
    const double since = 3.0 - (t - 2.0 * up / e / g), now = up / e;
    BOOST_CHECK_SMALL(sim.position()[1] - (now * since - 0.5 * g * since * since), 1e-10);
    BOOST_CHECK_SMALL(sim.velocity()[1] - (now - g * since), 1e-10);
    BOOST_CHECK_SMALL(sim.position()[0] - 0.9, 1e-12);
    BOOST_CHECK_SMALL(sim.position()[2] - 6.0, 1e-12);
    BOOST_TEST(sim.time() == 3.0);
}

BOOST_AUTO_TEST_CASE(a_block_pushed_up_an_incline_stops_and_stays_or_comes_back) {
    constexpr double slope = 0.3, speed = 2.0;
    for (const double mu : {0.5, 0.1}) {  // tan 0.3 = 0.309
        Sim sim(block(slope, mu), Three(0.0, 0.0, 0.0), Three(-speed, 0.0, 0.0));
        const EventReport run = sim.advance(2.0);
        BOOST_TEST(run.done(), to_string(run));
        BOOST_TEST((run.counted && run.events.size() == 1u));
        const double stop = speed / (g * (std::sin(slope) + mu * std::cos(slope)));
        BOOST_CHECK_SMALL(run.events.at(0).time - stop, 1e-11);
        const double down = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
        const bool stays = down == 0.0;
        BOOST_TEST(
            (run.events[0].kind == (stays ? EventKind::slip_to_stick : EventKind::slip_reversal)));
        BOOST_TEST((sim.mode(0) == (stays ? ContactMode::sticking : ContactMode::sliding)));
        const double since = 2.0 - stop;
        BOOST_CHECK_SMALL(sim.position()[0] - (-0.5 * speed * stop + 0.5 * down * since * since),
                          1e-10);
        BOOST_CHECK_SMALL(sim.velocity()[0] - down * since, 1e-10);
        BOOST_CHECK_SMALL(sim.position()[1], 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(a_force_that_grows_moves_a_block_and_lifts_it) {
    constexpr double mu = 0.4, across = 3.0, up = 2.0;
    PlanarBody body = block(0.0, mu);
    body.rise = {across, up};
    Sim sim(body, Three(0.0, 0.0, 0.0));
    const EventReport run = sim.advance(6.0);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.events.size() == 2u);
    const double slips = mu * g / (across + mu * up), lifts = g / up;
    BOOST_TEST((run.events.at(0).kind == EventKind::stick_to_slip));
    BOOST_CHECK_SMALL(run.events[0].time - slips, 1e-11);
    BOOST_TEST((run.events.at(1).kind == EventKind::detachment));
    BOOST_CHECK_SMALL(run.events[1].time - lifts, 1e-11);
    BOOST_TEST((sim.mode(0) == ContactMode::open));
    // y'' = up (t - lifts), x'' = (across + mu up) (t - slips), then across t.
    const double s = 6.0 - lifts, d = lifts - slips, a = across + mu * up;
    BOOST_CHECK_SMALL(sim.position()[1] - up * s * s * s / 6.0, 1e-9);
    const double x = a * d * d * d / 6.0, v = 0.5 * a * d * d;
    BOOST_CHECK_SMALL(
        sim.position()[0] - (x + v * s + 0.5 * across * lifts * s * s + across * s * s * s / 6.0),
        1e-8);
}

/// y'' + y = 5 cos(2.2 t) above a stop at 0, by the closed form of each flight.
BOOST_AUTO_TEST_CASE(an_impact_oscillator_follows_its_exact_map_over_twenty_impacts) {
    constexpr double w = 2.2, shake = 5.0, e = 0.8;
    PlanarBody body = ball(e);
    body.gravity.setZero();
    body.stiffness = 1.0;
    body.shake = shake;
    body.frequency = w;
    Sim sim(body, Three(0.0, 0.5, 0.0), Three(0.0, 0.0, 0.0), 0.0,
            EventDrivenParams{.relative_tolerance = 1e-12, .absolute_tolerance = 1e-13});
    double from = 0.0, y = 0.5, v = 0.0;
    const double forced = shake / (1.0 - w * w);
    std::vector<std::pair<double, double>> exact;  // times, and speeds before
    while (exact.size() < 20) {
        const double start = from;
        const double c = y - forced * std::cos(w * from), s = v + forced * w * std::sin(w * from);
        const auto at = [&](double t) {
            return forced * std::cos(w * t) + c * std::cos(t - start) + s * std::sin(t - start);
        };
        const auto speed = [&](double t) {
            return -forced * w * std::sin(w * t) - c * std::sin(t - start) +
                   s * std::cos(t - start);
        };
        double a = from + 1e-6;
        while (at(a + 1e-4) > 0.0) a += 1e-4;
        double b = a + 1e-4;
        for (int k = 0; k < 60; ++k) (at(0.5 * (a + b)) > 0.0 ? a : b) = 0.5 * (a + b);
        from = 0.5 * (a + b);
        y = 0.0;
        exact.emplace_back(from, speed(from));
        v = -e * speed(from);
    }
    const EventReport run = sim.advance(from + 1e-3);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.events.size() == 20u);
    double worst = 0.0;
    for (std::size_t k = 0; k < 20; ++k) {
        BOOST_TEST((run.events.at(k).kind == EventKind::impact));
        worst = std::max({worst, std::abs(run.events[k].time - exact[k].first),
                          std::abs(run.events[k].approach - exact[k].second)});
    }
    BOOST_TEST_MESSAGE("impact oscillator, worst of 20 impacts: " << worst);
    BOOST_CHECK_SMALL(worst, 1e-8);
}

BOOST_AUTO_TEST_CASE(impacts_that_accumulate_are_reported_with_their_limit) {
    for (const double e : {0.5, 0.8}) {
        Sim sim(ball(e), Three(0.0, 1.0, 0.0));
        const EventReport run = sim.advance(5.0);
        BOOST_TEST((run.end == EventEnd::accumulation && !run.done()));
        BOOST_TEST(run.count(EventKind::accumulation) == 1u);
        const double limit = std::sqrt(2.0 / g) * (1.0 + e) / (1.0 - e);
        BOOST_CHECK_SMALL(run.events.back().time - limit, 1e-9);
        BOOST_TEST((run.time < limit && run.time > limit - 1e-5 && sim.time() == run.time));
        // It says so again, and does not pass.
        const EventReport again = sim.advance(5.0);
        BOOST_TEST((again.end == EventEnd::accumulation));
        BOOST_TEST(sim.time() < limit + 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(a_rod_that_lands_flat_has_two_contacts_at_once) {
    const double fall = std::sqrt(2.0 * 0.3 / g);
    Sim bounces(PlanarBody::rod(0.2, 0.5), Three(0.0, 0.3, 0.0));
    const EventReport run = bounces.advance(1.2 * fall);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.count(EventKind::impact) == 2u);
    for (const auto& event : run.events) BOOST_CHECK_SMALL(event.time - fall, 1e-12);
    BOOST_CHECK_SMALL(bounces.velocity()[2], 1e-11);
    BOOST_CHECK_SMALL(bounces.velocity()[1] - g * (0.5 * fall - 0.2 * fall), 1e-10);

    // Without restitution it stays, slides with what friction has left it and stops; then it
    // sticks with one force more than equations.
    constexpr double mu = 0.2, speed = 3.0;
    Sim stays(PlanarBody::rod(mu, 0.0), Three(0.0, 0.3, 0.0), Three(speed, 0.0, 0.0));
    const EventReport slide = stays.advance(3.0);
    BOOST_TEST(slide.done(), to_string(slide));
    const double after = speed - mu * g * fall, stop = fall + after / (mu * g);
    BOOST_TEST(slide.count(EventKind::slip_to_stick) == 2u);
    BOOST_CHECK_SMALL(slide.events.back().time - stop, 1e-10);
    BOOST_CHECK_SMALL(stays.position()[0] - (speed * fall + 0.5 * after * (stop - fall)), 1e-10);
    BOOST_CHECK_SMALL(stays.velocity().norm(), 1e-14);
    BOOST_TEST((stays.mode(0) == ContactMode::sticking && stays.mode(1) == ContactMode::sticking));
}

/// Friction of redundant contacts: the forces are not unique, the motion is.
BOOST_AUTO_TEST_CASE(a_rod_pushed_along_the_floor_slips_when_all_its_friction_is_used) {
    PlanarBody rod = PlanarBody::rod(0.3, 0.0);
    rod.rise = {2.0, 0.0};
    // The centre of mass is not in the middle: loads and least forces differ.
    rod.corners = {{-0.2, 0.0}, {0.5, 0.0}};
    Sim sim(rod, Three(0.0, 0.0, 0.0));
    const EventReport run = sim.advance(2.0);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.count(EventKind::stick_to_slip) == 2u);
    const double slips = 0.3 * g / 2.0, since = 2.0 - slips;
    for (const auto& event : run.events) BOOST_CHECK_SMALL(event.time - slips, 1e-9);
    BOOST_CHECK_SMALL(sim.position()[0] - 2.0 * since * since * since / 6.0, 1e-9);
}

BOOST_AUTO_TEST_CASE(no_acceleration_in_painleves_inconsistency_is_said_at_once) {
    const SlidingRod rod(std::numbers::pi / 3.0, 2.0, -1.0, 0.0);
    Sim sim(rod.body, rod.q, rod.u);
    const EventReport run = sim.advance(0.1);
    BOOST_TEST((run.end == EventEnd::no_acceleration && run.counted), to_string(run));
    BOOST_TEST(run.time == 0.0);
    BOOST_TEST((sim.position() == rod.q && sim.velocity() == rod.u));
}

BOOST_AUTO_TEST_CASE(several_accelerations_in_painleves_indeterminacy_are_said) {
    const SlidingRod rod(std::numbers::pi / 3.0, 2.0, -1.0, 9.0);
    Sim sim(rod.body, rod.q, rod.u);
    const EventReport run = sim.advance(0.1);
    BOOST_TEST((run.end == EventEnd::several_accelerations), to_string(run));
    BOOST_TEST(run.count(EventKind::several_accelerations) == 1u);
    // On the other side nothing is strange.
    const SlidingRod tame(std::numbers::pi / 3.0, 2.0, 1.0, 0.0);
    Sim other(tame.body, tame.q, tame.u);
    BOOST_TEST(other.advance(0.01).done());
}

/// W_nn = mu |W_nt| at tan(angle) = (3 mu - sqrt(9 mu^2 - 16)) / 2.
BOOST_AUTO_TEST_CASE(a_slide_that_leads_to_the_border_of_the_paradox_ends_there) {
    const SlidingRod rod(std::numbers::pi / 6.0, 2.0, -12.0, 0.0);
    Sim sim(rod.body, rod.q, rod.u);
    const double border = std::atan(3.0 - std::sqrt(5.0)), near = 1e-3 * std::numbers::pi / 180.0;
    double slide = 0.0;  // a thousandth of a degree before: beyond, it changes as a logarithm
    const EventReport run = sim.advance(0.13, [&](const Sim::Step& step) {
        const Three q = step.position(step.t_end()), u = step.velocity(step.t_end());
        if (q[2] < border - near) slide = u[0] + 0.5 * std::sin(q[2]) * u[2];
    });
    BOOST_TEST((run.end == EventEnd::no_acceleration), to_string(run));
    BOOST_TEST_MESSAGE("border of the paradox, angle - closed form: "
                       << sim.position()[2] - border << " at t = " << run.time << ", steps "
                       << run.steps << ", rejected " << run.rejected);
    BOOST_CHECK_SMALL(sim.position()[2] - border, 1e-6);
    BOOST_CHECK_SMALL(run.time - 0.11445, 1e-5);
    BOOST_CHECK_SMALL(slide + 3.67, 0.05);
    // Begun tamer, the tip comes to rest before, turns round and lifts off.
    const SlidingRod tame(std::numbers::pi / 6.0, 2.0, -6.0, 1.0);
    Sim other(tame.body, tame.q, tame.u);
    const EventReport rest = other.advance(0.12);
    BOOST_TEST(rest.done(), to_string(rest));
    BOOST_TEST(rest.events.size() == 2u);
    BOOST_TEST((rest.events.at(0).kind == EventKind::slip_reversal));
    BOOST_TEST((rest.events.at(1).kind == EventKind::detachment));
}

BOOST_AUTO_TEST_CASE(observers_see_dense_output_and_may_stop) {
    PlanarBody body = ball(1.0);
    body.gravity.setZero();
    body.stiffness = 9.0;
    Sim sim(body, Three(0.0, 1.0, 0.0));
    double worst = 0.0, end = 0.0;
    const EventReport run = sim.advance(2.0, [&](const Sim::Step& step) {
        BOOST_TEST(step.t_begin() == end);
        end = step.t_end();
        for (int k = 0; k <= 10; ++k) {
            const double t = k == 10 ? end : step.t_begin() + 0.1 * k * (end - step.t_begin());
            worst = std::max(
                {worst, std::abs(step.position(t)[1] - std::abs(std::cos(3.0 * t))),
                 std::abs(std::abs(step.velocity(t)[1]) - std::abs(3.0 * std::sin(3.0 * t)))});
        }
        BOOST_CHECK_THROW((void)step.position(end + 1e-3), talus::input_error);
    });
    BOOST_TEST((run.done() && run.events.size() == 2u), to_string(run));
    BOOST_TEST(end == 2.0);
    BOOST_TEST_MESSAGE("dense output, worst: " << worst);
    BOOST_CHECK_SMALL(worst, 1e-8);
    const EventReport stopped =
        sim.advance(1.0, [](const Sim::Step& step) { return step.t_end() < 2.5; });
    BOOST_TEST((stopped.end == EventEnd::stopped && !stopped.done()));
    BOOST_TEST((sim.time() >= 2.5 && sim.time() < 2.6 && sim.time() == stopped.time));
}

BOOST_AUTO_TEST_CASE(the_same_run_has_the_same_bits_and_a_divided_one_the_same_motion) {
    const auto start = [] {
        return Sim(PlanarBody::rod(0.3, 0.5), Three(0.0, 1.0, 0.6), Three(1.0, 0.0, 2.0));
    };
    Sim one = start(), two = start(), parts = start();
    const EventReport run = one.advance(0.8);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(two.advance(0.8).events.size() == run.events.size());
    BOOST_TEST((one.position() == two.position() && one.velocity() == two.velocity()));
    for (int k = 0; k < 16; ++k) BOOST_TEST(parts.advance(0.05).done());
    BOOST_CHECK_SMALL((parts.position() - one.position()).norm(), 1e-8);
    BOOST_TEST(run.count(EventKind::impact) > 1u);
}

BOOST_AUTO_TEST_CASE(limits_that_are_asked_for_are_kept_and_told) {
    Sim few(ball(0.9), Three(0.0, 1.0, 0.0), EventDrivenParams{.max_events = 3});
    const EventReport run = few.advance(10.0);
    BOOST_TEST((run.end == EventEnd::event_limit && run.events.size() == 3u));
    BOOST_TEST(few.time() == run.events.back().time);
    Sim short_steps(ball(0.9), Three(0.0, 1.0, 0.0), EventDrivenParams{.max_steps = 5});
    const EventReport steps = short_steps.advance(10.0);
    BOOST_TEST((steps.end == EventEnd::step_limit && steps.steps == 5));
    BOOST_TEST((few.advance(0.0).done() && short_steps.advance(0.0).done()));
}

BOOST_AUTO_TEST_CASE(what_is_not_as_it_must_be_is_refused_and_changes_nothing) {
    const Three up(0.0, 1.0, 0.0), none(0.0, 0.0, 0.0);
    const auto refuse = [&](const EventDrivenParams& params) {
        return complaint([&] { Sim(ball(0.5), up, params); });
    };
    BOOST_TEST(refuse({.relative_tolerance = 1e-15}).find("relative tolerance is 1e-15") == 0u);
    BOOST_TEST(refuse({.absolute_tolerance = 0.0}).find("absolute tolerance is 0") == 0u);
    BOOST_TEST(refuse({.longest_step = -1.0}).find("longest step is -1") == 0u);
    BOOST_TEST(refuse({.touching = machines::nan}).find("gap that counts as touching is nan") ==
               0u);
    BOOST_TEST(refuse({.resting_speed = 0.0}).find("resting speed is 0") == 0u);
    BOOST_TEST(refuse({.accumulation_count = 1}).find("accumulation count is 1") == 0u);
    BOOST_TEST(refuse({.enumeration_contacts = 9}).find("contacts to enumerate is 9") == 0u);
    BOOST_TEST(complaint([&] { Sim(ball(0.5), Three(0.0, -0.1, 0.0)); }) ==
               "gap of contact 0 (corner) at t = 0 s is -0.1, but must be at least -1e-09");
    PlanarBody rough = ball(0.5);
    rough.mu = -1.0;
    BOOST_TEST(complaint([&] { Sim(rough, up); }).find("law of contact 0 (corner).mu is -1") !=
               std::string::npos);

    PlanarBody spoilt = ball(0.5);
    spoilt.spoilt_from = 0.3;
    Sim sim(spoilt, up);
    BOOST_TEST(sim.advance(0.2).done());
    const Three q = sim.position(), u = sim.velocity();
    BOOST_TEST(complaint([&] { (void)sim.advance(0.5); }).find("force[0] at t = 0.3") == 0u);
    BOOST_TEST(complaint([&] { (void)sim.advance(-1.0); }) ==
               "duration is -1, but must be finite and not negative");
    BOOST_CHECK_THROW((void)sim.advance(machines::nan), talus::input_error);
    BOOST_CHECK_THROW(sim.set_state(Three(0.0, -1.0, 0.0), none), talus::input_error);
    BOOST_CHECK_THROW(sim.set_state(Three(0.0, machines::nan, 0.0), none), talus::input_error);
    BOOST_CHECK_THROW(
        (void)sim.advance(0.05, [](const Sim::Step&) { throw talus::input_error("no"); }),
        talus::input_error);
    BOOST_TEST((sim.position() == q && sim.velocity() == u && sim.time() == 0.2));
}

BOOST_AUTO_TEST_SUITE_END()
