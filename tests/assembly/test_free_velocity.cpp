// SPDX-License-Identifier: BSL-1.0
#include <talus/assembly/free_velocity.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(assembly_free_velocity)

BOOST_AUTO_TEST_CASE_TEMPLATE(newton_and_euler_give_the_free_velocity, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(91);
    talus::Bodies<Dim> bodies;
    talus::AngularVector<Dim> moments = talus::AngularVector<Dim>::Constant(2.0);
    moments[0] = 1.5;
    const talus::Twist<Dim> twist{random_input::vector<talus::Vector<Dim>>(rng),
                                  random_input::vector<talus::AngularVector<Dim>>(rng)};
    bodies.add({3.0, moments}, random_input::pose<Dim>(rng), twist);
    bodies.add_obstacle(random_input::pose<Dim>(rng), twist);
    const talus::Vector<Dim> gravity = -9.81 * talus::Vector<Dim>::Unit(Dim - 1);
    const talus::Wrench<Dim> applied{random_input::vector<talus::Vector<Dim>>(rng),
                                     random_input::vector<talus::AngularVector<Dim>>(rng)};
    const double h = 0.01;
    const auto gyro =
        talus::gyroscopic_change<Dim>(bodies, 0, h, talus::Gyroscopic::explicit_term).spin;
    const auto free = talus::free_velocity<Dim>(bodies, 0, h, gravity, applied, gyro);

    const talus::Vector<Dim> acceleration = gravity + applied.force / 3.0;
    BOOST_CHECK_SMALL((free.linear - twist.linear - h * acceleration).norm(), 1e-15);
    // Euler's equations in world axes: J w' = torque - w x J w.
    const talus::AngularMatrix<Dim> tensor = talus::tensor_world<Dim>(bodies.rotation[0], moments);
    const talus::AngularVector<Dim> change = tensor * (free.angular - twist.angular) / h;
    talus::AngularVector<Dim> expected = applied.torque;
    if constexpr (Dim == 3) expected -= twist.angular.cross(tensor * twist.angular);
    BOOST_CHECK_SMALL((change - expected).norm(), 1e-12);

    const auto still = talus::free_velocity<Dim>(bodies, 1, h, gravity, applied,
                                                 talus::AngularVector<Dim>::Zero());
    BOOST_CHECK_SMALL((still.linear - twist.linear).norm(), 1e-15);
    BOOST_CHECK_SMALL((still.angular - twist.angular).norm(), 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
