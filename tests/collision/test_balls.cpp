// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(collision_balls)

const double rounding = 1e-15;  // a few operations on numbers of order one

BOOST_AUTO_TEST_CASE_TEMPLATE(overlapping_balls_touch_half_way, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::AnyShape<Dim> a = talus::Ball<Dim>(1.0), b = talus::Ball<Dim>(0.5);
    talus::Pose<Dim> at;
    at.position[0] = 1.25;
    talus::Column<talus::ContactPoint<Dim>> out;
    talus::contact_points<Dim>(a, at, b, talus::Pose<Dim>{}, 0.0, out);
    BOOST_REQUIRE_EQUAL(out.size(), 1u);
    BOOST_CHECK_SMALL(out[0].gap + 0.25, rounding);
    BOOST_CHECK_SMALL((out[0].normal - talus::Vector<Dim>::Unit(0)).norm(), rounding);
    BOOST_CHECK_SMALL((out[0].point - 0.375 * talus::Vector<Dim>::Unit(0)).norm(), rounding);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_margin_decides_what_counts, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::AnyShape<Dim> ball = talus::Ball<Dim>(1.0);
    const talus::AnyShape<Dim> floor = talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1));
    talus::Pose<Dim> at;
    at.position[Dim - 1] = 1.5;
    talus::Column<talus::ContactPoint<Dim>> out;
    talus::contact_points<Dim>(ball, at, floor, talus::Pose<Dim>{}, 0.4, out);
    BOOST_CHECK(out.empty());
    talus::contact_points<Dim>(floor, talus::Pose<Dim>{}, ball, at, 0.5, out);
    BOOST_REQUIRE_EQUAL(out.size(), 1u);
    BOOST_CHECK_SMALL(out[0].gap - 0.5, rounding);
    BOOST_CHECK_SMALL((out[0].normal + talus::Vector<Dim>::Unit(Dim - 1)).norm(), rounding);
    BOOST_CHECK_SMALL(out[0].point[Dim - 1] - 0.25, rounding);
}

BOOST_AUTO_TEST_SUITE_END()
