// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
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
