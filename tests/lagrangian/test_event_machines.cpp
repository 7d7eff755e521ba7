// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/event_driven/event_driven.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lagrangian/systems.hpp"

/// What moves as told, and more contacts than are enumerated.
BOOST_AUTO_TEST_SUITE(lagrangian_event_machines)

using machines::g;
using machines::Stack;
using talus::ContactMode;
using talus::EventDrivenParams;
using talus::EventEnd;
using talus::EventKind;

namespace {

/// A ball of 1 kg above a table at a sin(w t).
struct Table {
    static constexpr int dof = 1;
    double a = 0.04, w = 20.0, restitution = 0.3;

    void mass(double, const auto&, auto& m) const { m << 1.0; }
    void force(double, const auto&, const auto&, auto& f) const { f << -g; }
    void gaps(const auto& t, const auto& q, auto& contacts) const {
        contacts.add(q[0] - a * sin(w * t), machines::PlaneLaw{{}, restitution, 0.0}, "table");
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_ball_is_thrown_by_a_table_when_the_table_falls_faster_than_it) {
    using Ball = Eigen::Vector<double, 1>;
    const Table table;
    talus::EventDriven<Table> sim(table, Ball(0.0), Ball(table.a * table.w), 0.0,
                                  EventDrivenParams{.time_scale = 1.0 / table.w});
    // Leaves with sin(w t) = g / (a w^2).
    const double s = g / (table.a * table.w * table.w), leaves = std::asin(s) / table.w;
    const double up = table.a * table.w * std::sqrt(1.0 - s * s);
    const auto height = [&](double t) {
        const double since = t - leaves;
        return table.a * s + up * since - 0.5 * g * since * since - table.a * std::sin(table.w * t);
    };
    double a = leaves + 0.05, b = 0.25;
    BOOST_REQUIRE((height(a) > 0.0 && height(b) < 0.0));
    for (int k = 0; k < 60; ++k) (height(0.5 * (a + b)) > 0.0 ? a : b) = 0.5 * (a + b);
    const double lands = 0.5 * (a + b);
    const double approach =
        up - g * (lands - leaves) - table.a * table.w * std::cos(table.w * lands);

    const auto run = sim.advance(lands + 1e-3);
    BOOST_TEST(run.done(), to_string(run));
    BOOST_TEST(run.events.size() == 2u);
    BOOST_TEST((run.events.at(0).kind == EventKind::detachment));
    BOOST_CHECK_SMALL(run.events[0].time - leaves, 1e-9);
    BOOST_TEST((run.events.at(1).kind == EventKind::impact));
    BOOST_CHECK_SMALL(run.events[1].time - lands, 1e-9);
    BOOST_CHECK_SMALL(run.events[1].approach - approach, 1e-8);
    BOOST_CHECK_SMALL(run.events[1].impulse + 1.3 * approach, 1e-8);
}

/// Seven blocks that lie one on the other: every contact is closed, and W is not diagonal.
BOOST_AUTO_TEST_CASE(a_stack_that_lands_stays_by_lemkes_algorithm) {
    constexpr Eigen::Index n = 7;
    Eigen::VectorXd q(n), u = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) q[i] = 0.2 + 0.1 * static_cast<double>(i);
    talus::EventDriven<Stack> sim(Stack{}, q, u);
    const auto run = sim.advance(1.0);
    BOOST_TEST((run.done() && !run.counted), to_string(run));
    const double fall = std::sqrt(2.0 * 0.2 / g);
    BOOST_TEST(run.count(EventKind::impact) == run.events.size());
    // A contact that had no gap has one by rounding at some instant: what lands is one after other.
    for (const auto& event : run.events) BOOST_CHECK_SMALL(event.time - fall, 1e-9);
    for (Eigen::Index i = 0; i < n; ++i) {
        BOOST_CHECK_SMALL(sim.position()[i] - 0.1 * static_cast<double>(i), 1e-12);
        BOOST_TEST((sim.mode(static_cast<std::size_t>(i)) != ContactMode::open));
    }
    BOOST_CHECK_SMALL(sim.velocity().norm(), 1e-14);
    // Enumerated it is the same, and known to be all.
    talus::EventDriven<Stack> counted(Stack{}, q, u, 0.0,
                                      EventDrivenParams{.enumeration_contacts = 8});
    const auto other = counted.advance(1.0);
    BOOST_TEST((other.done() && other.counted), to_string(other));
    BOOST_CHECK_SMALL((counted.position() - sim.position()).norm(), 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
