// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/any_shape.hpp>
#include <talus/geometry/principal_shape.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(geometry_ball)

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_off_centre_lives_at_the_centre_of_its_principal_frame, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const talus::Vector<Dim> centre = talus::Vector<Dim>::Constant(0.75);
    const auto body = talus::in_principal_frame<Dim>(talus::Ball<Dim>(0.5, centre));
    BOOST_CHECK((body.shape.centre() == talus::Vector<Dim>::Zero()));
    BOOST_CHECK((body.frame.pose.position == centre));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_half_space_gives_no_body, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::AnyShape<Dim> floor = talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1));
    BOOST_CHECK_THROW(floor.mass_properties(), talus::input_error);
    BOOST_CHECK(!floor.aabb({}).bounded());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_bad_radius_is_refused, D, dimensions) {
    for (const double radius : {0.0, -1.0, std::nan(""), HUGE_VAL})
        BOOST_CHECK_THROW(talus::Ball<D::value>{radius}, talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
