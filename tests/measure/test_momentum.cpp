// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/momentum.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(measure_momentum)

BOOST_AUTO_TEST_CASE_TEMPLATE(momentum_is_the_sum_over_the_particles_of_a_body, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    std::mt19937 rng(101);
    // A rigid cross of particles on the body axes at distances chosen to give the moments.
    const auto pose = random_input::pose<Dim>(rng);
    const talus::Twist<Dim> twist{random_input::vector<V>(rng),
                                  random_input::vector<talus::AngularVector<Dim>>(rng)};
    V second = V::Zero();  // sum of m x_k^2 on axis k
    const double m = 0.25;
    V linear = V::Zero();
    talus::AngularVector<Dim> angular = talus::AngularVector<Dim>::Zero();
    for (int axis = 0; axis < Dim; ++axis)
        for (double sign : {1.0, -1.0}) {
            const double distance = 0.5 + 0.3 * axis;
            second[axis] += m * distance * distance;
            const V arm = pose.rotation * V(sign * distance * V::Unit(axis));
            const V p = m * twist.at(arm);
            linear += p;
            angular += talus::moment<Dim>(V(pose.position + arm), p);
        }
    talus::AngularVector<Dim> moments = talus::AngularVector<Dim>::Constant(second.sum());
    if constexpr (Dim == 3) moments -= second;
    talus::Bodies<Dim> bodies;
    bodies.add({2 * Dim * m, moments}, pose, twist);
    bodies.add_obstacle(pose, twist);
    const auto total = talus::momentum(bodies);
    BOOST_CHECK_SMALL((total.linear - linear).norm(), 1e-14);
    BOOST_CHECK_SMALL((total.angular - angular).norm(), 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
