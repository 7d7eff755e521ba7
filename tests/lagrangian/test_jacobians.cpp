// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_jacobians)

using namespace machines;

namespace {

/// A double pendulum that gives its rows by hand as well, one of them wrong by `off`.
struct ByHand : DoublePendulum {
    double off_normal = 0.0, off_tangent = 0.0, off_prescribed = 0.0;

    void contacts(double t, const auto& q, auto& contacts) const {
        auto& c =
            contacts.add(wall + wall_speed * t - std::sin(q[0]) - std::sin(q[1]), law, "wall");
        c.rows << -std::cos(q[0]), -std::cos(q[1]) + off_normal, std::sin(q[0]) + off_tangent,
            std::sin(q[1]);
        c.prescribed[0] = wall_speed + off_prescribed;
    }
};
/// The same without its gaps in numbers that carry derivatives.
struct ByHandAlone : ByHand {
    void gaps(const auto&, const auto&, auto&) const = delete;
};
static_assert(talus::GivesGaps<ByHand> && !talus::GivesGaps<ByHandAlone>);
static_assert(talus::LagrangianSystem<ByHandAlone> && talus::LagrangianSystem<DoublePendulum>);

template <class System>
std::string complaint(const System& system) {
    try {
        talus::require_jacobians(system, 0.25, Two(0.3, 0.7));
    } catch (const talus::input_error& e) {
        return e.what();
    }
    return {};
}
bool mentions(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(derivatives_of_gaps_are_the_hand_written_rows) {
    DoublePendulum by_gaps{.wall = 1.0, .wall_speed = -0.3};
    ByHand by_hand;
    by_hand.wall = 1.0;
    by_hand.wall_speed = -0.3;
    const Two q(0.3, 0.7);
    talus::SystemEvaluation<DoublePendulum> one;
    talus::SystemEvaluation<ByHand> other;
    talus::LagrangianTypes<DoublePendulum>::Contacts a;
    talus::LagrangianTypes<ByHand>::Contacts b;
    one.contacts(by_gaps, 0.25, q, a);
    other.contacts(by_hand, 0.25, q, b);
    BOOST_TEST(a.size() == 1u);
    BOOST_CHECK_SMALL(a[0].gap - b[0].gap, 1e-15);
    BOOST_CHECK_SMALL((a[0].rows - b[0].rows).norm(), 1e-15);
    BOOST_CHECK_SMALL((a[0].prescribed - b[0].prescribed).norm(), 1e-15);
    BOOST_TEST(a[0].name == "wall");
}

BOOST_AUTO_TEST_CASE(where_the_number_of_coordinates_is_known_late) {
    const Eigen::VectorXd q = Eigen::Vector3d(0.05, 0.2, 0.4);
    talus::LagrangianSimulation by_hand(Stack{}, q, {.h = 1e-3});
    talus::LagrangianSimulation by_gaps(StackByGaps{}, q, {.h = 1e-3});
    BOOST_TEST(by_hand.run(0.5).certified());
    BOOST_TEST(by_gaps.run(0.5).certified());
    BOOST_CHECK_SMALL((by_hand.position() - by_gaps.position()).norm(), 1e-13);
}

BOOST_AUTO_TEST_CASE(the_check_finds_what_is_wrong) {
    ByHand right;
    right.wall = 1.0;
    right.wall_speed = -0.3;
    BOOST_TEST(complaint(right) == "");
    ByHandAlone alone;
    static_cast<ByHand&>(alone) = right;
    BOOST_TEST(complaint(alone) == "");

    ByHandAlone wrong = alone;
    wrong.off_normal = 1e-3;
    const std::string text = complaint(wrong);
    for (const char* word :
         {"normal row[1]", "contact 0 (wall)", "t = 0.25 s", "-0.763842187", "-0.764842187"})
        BOOST_TEST(mentions(text, word), text);
    wrong = alone;
    wrong.off_prescribed = 0.1;
    BOOST_TEST(mentions(complaint(wrong), "prescribed[0]"));
    ByHand tangent = right;
    tangent.off_tangent = 1e-6;
    BOOST_TEST(mentions(complaint(tangent), "tangential row 1[0]"), complaint(tangent));
}

namespace {

/// A finger that turns and slides over a ball, all of a size; defined close to the ball alone.
struct Finger {
    static constexpr int dof = 2;
    double radius, off = 0.0;

    void mass(double, const auto&, auto& a) const { a.setIdentity(); }
    void force(double, const auto&, const auto&, auto& f) const { f.setZero(); }
    void contacts(double, const auto& q, auto& contacts) const {
        const double height = std::sqrt(radius * radius - q[0] * q[0]);
        contacts.add(q[1] - height, PlaneLaw{}, "finger").rows.row(0) << q[0] / height + off, 1.0;
    }
};
/// A table whose motion is known from t = 0 on, and which is at full speed at once.
struct LateTable {
    static constexpr int dof = 1;
    double until = 1e9, off = 0.0;
    bool throws = true;

    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double, const auto&, const auto&, auto& f) const { f << -g; }
    void contacts(double t, const auto& q, auto& contacts) const {
        if (throws && (t < 0.0 || t > until)) throw std::out_of_range("no motion at that time");
        auto& c = contacts.add(q[0] - (t < 0.0 ? 0.0 : std::sin(3.0 * t)), PlaneLaw{}, "table");
        c.rows(0, 0) = 1.0;
        c.prescribed[0] = -3.0 * std::cos(3.0 * t) + off;
    }
};
template <class System, class Coordinates>
std::string complaint_at(const System& system, double t, const Coordinates& q, double scale = 1.0) {
    try {
        talus::require_jacobians(system, t, q, scale);
    } catch (const talus::input_error& e) {
        return e.what();
    }
    return {};
}

}  // namespace

BOOST_AUTO_TEST_CASE(machines_of_any_size_are_checked) {
    for (const double size : {1e-7, 1e-6, 1e-3, 1.0, 1e3, 1e6})
        for (const double scale : {1.0, size}) {
            const Two q = size * Two(0.6, 0.9);
            BOOST_TEST(complaint_at(Finger{size}, 0.0, q, scale) == "");
            BOOST_TEST(mentions(complaint_at(Finger{size, 1e-3}, 0.0, q, scale), "normal row[0]"));
            BOOST_TEST(mentions(complaint_at(Finger{size, 1e-4}, 0.0, q, scale), "normal row[0]"));
        }
    talus::LagrangianSimulation small(Finger{1e-6}, Two(0.6e-6, 0.9e-6));
    BOOST_TEST(small.run(0.01).certified());
}

BOOST_AUTO_TEST_CASE(motions_may_begin_and_end) {
    for (const bool throws : {true, false}) {
        BOOST_TEST(complaint_at(LateTable{.throws = throws}, 0.0, Angle(1.0)) == "");
        BOOST_TEST(mentions(complaint_at(LateTable{.off = 1e-3, .throws = throws}, 0.0, Angle(1.0)),
                            "prescribed[0] of contact 0 (table) at t = 0 s is -2.999"));
    }
    BOOST_TEST(complaint_at(LateTable{.until = 1.0}, 1.0, Angle(1.0)) == "");
    BOOST_TEST(mentions(complaint_at(LateTable{.until = 1.0, .off = 1e-3}, 1.0, Angle(1.0)),
                        "prescribed[0]"));
    talus::LagrangianSimulation sim(LateTable{}, Angle(1.0),
                                    {.check_jacobians = talus::CheckJacobians::each_step});
    BOOST_TEST(sim.run(0.01).certified());
    // What is defined at one time alone has no derivative: the system says so itself.
    BOOST_CHECK_THROW(talus::require_jacobians(LateTable{.until = 0.0}, 0.0, Angle(1.0)),
                      std::out_of_range);
}

BOOST_AUTO_TEST_CASE(a_simulation_asks_at_its_start) {
    ByHandAlone wrong;
    wrong.wall = 1.0;
    wrong.off_normal = 1e-3;
    const Two q(0.3, 0.7);
    BOOST_CHECK_THROW(talus::LagrangianSimulation(wrong, q), talus::input_error);
    talus::LagrangianSimulation unasked(wrong, q,
                                        {.check_jacobians = talus::CheckJacobians::never});
    BOOST_TEST(unasked.step().contact_count() == 0u);
    ByHandAlone right;
    right.wall = 1.0;
    talus::LagrangianSimulation always(right, q,
                                       {.check_jacobians = talus::CheckJacobians::each_step});
    BOOST_TEST(always.run(0.01).certified());
    always.system().off_normal = 1e-3;
    BOOST_CHECK_THROW(always.step(), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
