// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/convex_polytope.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>

#include "common/hull_tester.hpp"

using hull_tester::Source;
using talus::Vector;

BOOST_AUTO_TEST_SUITE(collision_rounded_faces)

/// Area of the convex hull of points seen from above.
double spanned(const talus::Column<talus::ContactPoint<3>>& contacts) {
    std::vector<Vector<2>> p;
    for (const auto& c : contacts) p.emplace_back(c.point[0], c.point[1]);
    try {
        return talus::HullOfPoints<2>(std::span<const Vector<2>>(p))
            .polytope.mass_properties()
            .volume;
    } catch (const talus::input_error&) {
        return 0.0;  // too few, or on a line
    }
}

BOOST_AUTO_TEST_CASE(prisms_of_rounded_corners_touch_over_the_whole_common_face) {
    Source random(81);
    for (int trial = 0; trial < 12; ++trial)
        for (const int n : {3, 4, 5, 6, 7, 12, 16, 24})
            for (const double unit : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
                const auto turn = random.rotation();
                const double radius = 0.5;
                const talus::ConvexPolytope<3> prism(hull_tester::rounded(
                    hull_tester::turned(hull_tester::prism(n, radius, 0.5), turn), unit));
                const double full = 0.5 * n * radius * radius * std::sin(2 * std::numbers::pi / n);
                for (const double sink : {1e-9, 1e-7, 1e-5, 1e-3}) {
                    talus::Column<talus::ContactPoint<3>> contacts;
                    talus::contact_points<3>(prism, {Vector<3>::Zero(), turn.inverse()}, prism,
                                             {Vector<3>(0.001, 0.002, 0.5 - sink), turn.inverse()},
                                             0.0, contacts);
                    // The shift leaves out 0.0023 times the width across it.
                    BOOST_TEST(spanned(contacts) / full > 0.985,
                               n << " sides, unit " << unit << ", sink " << sink << ": "
                                 << contacts.size() << " contacts span "
                                 << spanned(contacts) / full);
                    for (const auto& c : contacts) {
                        BOOST_TEST(c.gap <= 4.1 * unit);
                        BOOST_TEST(std::abs(c.gap + sink) <= 4.1 * unit + 1e-15);
                        BOOST_TEST(c.normal[2] < -1.0 + 1e-6);
                    }
                }
            }
}

BOOST_AUTO_TEST_CASE(a_ball_on_an_uneven_face_is_pushed_along_its_normal) {
    Source random(82);
    for (int trial = 0; trial < 200; ++trial) {
        const auto turn = random.rotation();
        const talus::ConvexPolytope<3> prism(hull_tester::rounded(
            hull_tester::turned(hull_tester::prism(12, 0.5, 0.5), turn), 1e-5));
        const Vector<3> place(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.55 - 1e-4);
        talus::Column<talus::ContactPoint<3>> contacts;
        talus::contact_points<3>(talus::Ball<3>(0.3), {place, {}}, prism,
                                 {Vector<3>::Zero(), turn.inverse()}, 0.0, contacts);
        BOOST_TEST_REQUIRE(contacts.size() == 1u);
        BOOST_TEST(contacts[0].normal[2] > 1.0 - 1e-8);
        BOOST_TEST(std::abs(contacts[0].gap + 1e-4) < 4e-5);
    }
}

BOOST_AUTO_TEST_CASE(a_prism_of_rounded_corners_stands_on_all_of_its_face) {
    Source random(83);
    for (const double unit : {0.0, 1e-8, 1e-6, 1e-4})
        for (const int n : {3, 5, 12, 24}) {
            const auto turn = random.rotation();
            const talus::ConvexPolytope<3> prism(hull_tester::rounded(
                hull_tester::turned(hull_tester::prism(n, 0.5, 0.5), turn), unit));
            talus::Column<talus::ContactPoint<3>> contacts;
            talus::contact_points<3>(prism, {Vector<3>(0, 0, 0.25 - 1e-9), turn.inverse()},
                                     talus::HalfSpace<3>(Vector<3>::UnitZ()), {}, 0.0, contacts);
            BOOST_TEST(contacts.size() == static_cast<std::size_t>(n));
        }
}

BOOST_AUTO_TEST_CASE(corners_that_may_be_exact_do_not_touch_before_they_meet) {
    // Few digits, flat faces: nothing says that these were rounded.
    for (const double h : {0.5, 0.25, 0.005}) {
        std::vector<Vector<3>> v;
        for (int i = 0; i < 8; ++i) v.emplace_back(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h);
        const talus::ConvexPolytope<3> cube(v);
        talus::Column<talus::ContactPoint<3>> contacts;
        const auto at = [&](double z) { return talus::Pose<3>{Vector<3>(0, 0, z), {}}; };
        talus::contact_points<3>(cube, at(0.0), cube, at(2 * h * (1 + 1e-12)), 0.0, contacts);
        BOOST_TEST(contacts.empty());
        talus::contact_points<3>(cube, at(0.0), cube, at(2 * h * (1 - 1e-12)), 0.0, contacts);
        BOOST_TEST(contacts.size() == 4u);
    }
}

BOOST_AUTO_TEST_SUITE_END()
