// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/event_driven/event_driven.hpp>
#include <talus/lagrangian/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lagrangian/planar_body.hpp"
#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_event_agreement)

using machines::DoublePendulum;
using machines::PlanarBody;
using machines::SlidingRod;
using machines::Three;
using machines::Two;
using talus::EventDriven;
using talus::EventEnd;
using talus::EventKind;
using talus::LagrangianSimulation;

namespace {

/// Where a system is at the ends of equal parts of a duration, by events.
template <class System, class Coordinates>
std::vector<Coordinates> by_events(const System& system, const Coordinates& q, const Coordinates& u,
                                   double duration, int parts, std::size_t least_impacts) {
    EventDriven<System> sim(system, q, u);
    std::vector<Coordinates> path;
    std::size_t impacts = 0;
    for (int k = 0; k < parts; ++k) {
        const talus::EventReport run = sim.advance(duration / parts);
        BOOST_TEST(run.done(), to_string(run));
        impacts += run.count(EventKind::impact);
        path.push_back(sim.position());
    }
    BOOST_TEST(impacts >= least_impacts);
    BOOST_TEST_MESSAGE(impacts << " impacts");
    return path;
}
/// The mean distance of the midpoint method from that.
template <class System, class Coordinates>
double distance(const System& system, const Coordinates& q, const Coordinates& u, double h,
                double duration, const std::vector<Coordinates>& path) {
    LagrangianSimulation<System> sim(system, q, u, 0.0, {.h = h});
    double sum = 0.0;
    for (const Coordinates& there : path) {
        BOOST_TEST(sim.run(duration / static_cast<double>(path.size())).certified());
        sum += (sim.position() - there).norm();
    }
    return sum / static_cast<double>(path.size());
}
/// The slope of log error over log h by least squares. Whether a step ends before or after an event
/// makes single errors irregular, so that there are many: of 4 to 128 steps in each part.
template <class System, class Coordinates>
void must_agree_in_first_order(const System& system, const Coordinates& q, const Coordinates& u,
                               double duration, std::size_t least_impacts, double constant) {
    constexpr int parts = 64;
    const auto path = by_events(system, q, u, duration, parts, least_impacts);
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, worst = 0.0;
    for (const int steps :
         {4, 5, 7, 9, 11, 13, 16, 19, 23, 27, 32, 38, 45, 54, 64, 76, 91, 108, 128}) {
        const double h = duration / (parts * steps);
        const double error = distance(system, q, u, h, duration, path);
        worst = std::max(worst, error / h);
        const double x = std::log(h), y = std::log(error);
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    BOOST_TEST_MESSAGE("slope " << slope << ", largest error over h " << worst);
    BOOST_TEST(worst <= constant);
    BOOST_CHECK_SMALL(slope - 1.0, 0.2);  // the catalogue's band for irregular event times
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_rod_thrown_on_the_floor_agrees_with_the_midpoint_method) {
    must_agree_in_first_order(PlanarBody::rod(0.3, 0.5), Three(0.0, 1.0, 0.6), Three(1.0, 0.0, 2.0),
                              0.8, 2, 10.0);
}

BOOST_AUTO_TEST_CASE(a_double_pendulum_against_a_wall_agrees_with_the_midpoint_method) {
    must_agree_in_first_order(DoublePendulum{.wall = 0.2, .law = {{0.3}, 0.5, 0.0}},
                              Two(-0.8, -0.8), Two(0.0, 0.0), 2.5, 2, 10.0);
}

/// What the event-driven method reports as its limits the midpoint step goes through.
BOOST_AUTO_TEST_CASE(the_midpoint_step_goes_through_where_events_end) {
    constexpr double angle = std::numbers::pi / 3.0, h = 1e-4;
    const SlidingRod rod(angle, 2.0, -1.0, 0.0);
    EventDriven<PlanarBody> events(rod.body, rod.q, rod.u);
    BOOST_TEST((events.advance(0.01).end == EventEnd::no_acceleration));
    LagrangianSimulation<PlanarBody> sim(rod.body, rod.q, rod.u, 0.0,
                                         {.h = h, .contact_tolerance = 1e-6});
    const auto& step = sim.step();
    BOOST_TEST((step.report.status == talus::SolveStatus::converged));
    const double s = std::sin(angle), c = std::cos(angle);
    BOOST_REQUIRE(step.contact_count() == 1u);
    BOOST_CHECK_SMALL(step.impulse[0][0] - 0.75 * s * c, 100.0 * h);  // an impact without collision
    BOOST_CHECK_SMALL(sim.velocity()[2] - 1.5 * s, 100.0 * h);

    const SlidingRod slide(std::numbers::pi / 6.0, 2.0, -12.0, 0.0);
    EventDriven<PlanarBody> to_border(slide.body, slide.q, slide.u);
    const auto run = to_border.advance(0.13);
    BOOST_TEST((run.end == EventEnd::no_acceleration));
    LagrangianSimulation<PlanarBody> through(slide.body, slide.q, slide.u, 0.0,
                                             {.h = 1.5625e-5, .contact_tolerance = 1e-6});
    double largest = 0.0, when = 0.0;
    const auto whole = through.run(0.13, [&](const auto& now) {
        const double impulse = now.data().impulse_at(0)[0];
        if (impulse <= largest) return;
        largest = impulse;
        when = now.data().t_mid;
    });
    BOOST_TEST(whole.certified());
    BOOST_TEST(largest > 0.05);
    BOOST_CHECK_SMALL(when - run.time, 1e-4);  // the catalogue's bound at this h
    const double energy = slide.body.energy(slide.q, slide.u);
    BOOST_TEST(slide.body.energy(through.position(), through.velocity()) < energy);

    PlanarBody ball;
    ball.restitution = 0.5;
    EventDriven<PlanarBody> bounces(ball, Three(0.0, 1.0, 0.0));
    BOOST_TEST((bounces.advance(2.0).end == EventEnd::accumulation));
    LagrangianSimulation<PlanarBody> rests(ball, Three(0.0, 1.0, 0.0));
    BOOST_TEST(rests.run(2.0).certified());
    BOOST_CHECK_SMALL(rests.velocity().norm(), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
