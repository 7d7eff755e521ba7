// SPDX-License-Identifier: BSL-1.0
#include <talus/dynamics/bodies.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(dynamics_bodies)

// A few roundings of numbers of order 1.
constexpr double tolerance = 1e-14;

template <int Dim>
talus::Inertia<Dim> inertia(double mass, double moment) {
    return {mass, talus::AngularVector<Dim>::Constant(moment)};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_body_keeps_what_it_was_given, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(51);
    talus::Bodies<Dim> bodies;
    const auto pose = random_input::pose<Dim>(rng);
    const talus::Twist<Dim> twist{random_input::vector<talus::Vector<Dim>>(rng),
                                  random_input::vector<talus::AngularVector<Dim>>(rng)};
    const auto i = static_cast<std::size_t>(bodies.add(inertia<Dim>(2.0, 0.5), pose, twist));
    BOOST_CHECK_EQUAL(bodies.count(), 1u);
    BOOST_CHECK_EQUAL(bodies.mass(i), 2.0);
    BOOST_CHECK(!bodies.is_obstacle(i));
    BOOST_CHECK_SMALL((bodies.twist(i).angular - twist.angular).norm(), tolerance);
    const double energy =
        0.5 * (2.0 * twist.linear.squaredNorm() + 0.5 * twist.angular.squaredNorm());
    BOOST_CHECK_CLOSE(talus::kinetic_energy(bodies, i), energy, 1e-11);

    const auto wall = static_cast<std::size_t>(bodies.add_obstacle(pose, twist));
    BOOST_CHECK(bodies.is_obstacle(wall));
    BOOST_CHECK_EQUAL(talus::kinetic_energy(bodies, wall), 0.0);
    BOOST_CHECK(talus::inverse_inertia_world<Dim>(bodies, wall).isZero(0.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impossible_bodies_are_rejected_and_nothing_is_added, D, dimensions) {
    constexpr int Dim = D::value;
    const double nan = std::nan("");
    const double inf = std::numeric_limits<double>::infinity();
    talus::Bodies<Dim> bodies;
    for (double bad : {0.0, -1.0, nan, inf})
        BOOST_CHECK_THROW(bodies.add(inertia<Dim>(bad, 1.0), {}), talus::input_error);
    for (double bad : {0.0, -1.0, nan})
        BOOST_CHECK_THROW(bodies.add(inertia<Dim>(1.0, bad), {}), talus::input_error);
    talus::Pose<Dim> lost;
    lost.position[1] = nan;
    BOOST_CHECK_THROW(bodies.add(inertia<Dim>(1.0, 1.0), lost), talus::input_error);
    talus::Twist<Dim> mad;
    mad.angular[0] = inf;
    BOOST_CHECK_THROW(bodies.add(inertia<Dim>(1.0, 1.0), {}, mad), talus::input_error);
    BOOST_CHECK_THROW(bodies.add(inertia<Dim>(1.0, 1.0), {}, {}, -1), talus::input_error);
    BOOST_CHECK_EQUAL(bodies.count(), 0u);
}

BOOST_AUTO_TEST_CASE(moments_that_no_mass_distribution_has_are_rejected) {
    talus::Bodies<3> bodies;
    BOOST_CHECK_NO_THROW(bodies.add({1.0, {1.0, 2.0, 3.0}}, {}));  // flat body: the limit
    BOOST_CHECK_THROW(bodies.add({1.0, {1.0, 2.0, 3.1}}, {}), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_point_mass_does_not_turn, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Bodies<Dim> bodies;
    bodies.add(inertia<Dim>(3.0, std::numeric_limits<double>::infinity()), {},
               {talus::Vector<Dim>::Unit(0), talus::AngularVector<Dim>::Zero()});
    BOOST_CHECK(talus::inverse_inertia_world<Dim>(bodies, 0).isZero(0.0));
    BOOST_CHECK_EQUAL(talus::kinetic_energy(bodies, 0), 1.5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_inverse_tensor_inverts_the_tensor, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(52);
    talus::Bodies<Dim> bodies;
    talus::AngularVector<Dim> moments = talus::AngularVector<Dim>::Constant(2.0);
    moments[0] = 1.3;
    bodies.add({1.0, moments}, random_input::pose<Dim>(rng));
    const auto product = (talus::inverse_inertia_world<Dim>(bodies, 0) *
                          talus::tensor_world<Dim>(bodies.rotation[0], moments))
                             .eval();
    BOOST_CHECK_SMALL((product - decltype(product)::Identity()).norm(), tolerance);
}

BOOST_AUTO_TEST_SUITE_END()
