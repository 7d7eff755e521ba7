// SPDX-License-Identifier: BSL-1.0
#include <talus/assembly/apply_impulses.hpp>
#include <talus/assembly/contact_jacobian.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(assembly_contact_jacobian)

/// Two random bodies, an obstacle and random contacts between them.
template <int Dim>
struct RandomContacts {
    talus::Bodies<Dim> bodies;
    talus::ContactSet<Dim> contacts;
    talus::ContactJacobian<Dim> jacobian;
    talus::InverseMass<Dim> inverse_mass;

    explicit RandomContacts(std::mt19937& rng) {
        using V = talus::Vector<Dim>;
        for (int i = 0; i < 2; ++i) {
            talus::AngularVector<Dim> moments;
            for (int k = 0; k < moments.size(); ++k)
                moments[k] = random_input::uniform(rng, 1.0, 1.9);
            const double mass = random_input::uniform(rng, 1.0, 2.0);
            bodies.add({mass, moments}, random_input::pose<Dim>(rng));
        }
        bodies.add_obstacle(random_input::pose<Dim>(rng));
        for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}, {1, 2}})
            contacts.push_back(a, b,
                               {random_input::vector<V>(rng),
                                random_input::unit<V>(rng),
                                0.0,
                                {contacts.count()}});
        talus::assemble_jacobian(contacts, bodies, jacobian);
        talus::assemble_inverse_mass(bodies, inverse_mass);
    }
};

template <int Dim>
std::vector<talus::Twist<Dim>> random_twists(std::mt19937& rng, std::size_t n) {
    std::vector<talus::Twist<Dim>> twists(n);
    for (auto& t : twists)
        t = {random_input::vector<talus::Vector<Dim>>(rng),
             random_input::vector<talus::AngularVector<Dim>>(rng)};
    return twists;
}

// Some ten roundings of numbers of order 1.
constexpr double tolerance = 1e-14;

BOOST_AUTO_TEST_CASE_TEMPLATE(relative_velocity_is_that_of_the_two_material_points, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(71);
    const RandomContacts<Dim> s(rng);
    const auto twists = random_twists<Dim>(rng, 3);
    // Finite difference of the positions of the material points at the contact.
    const double dt = 1e-6;
    for (std::size_t c = 0; c < s.contacts.count(); ++c) {
        const auto moved = [&](talus::BodyIndex body) {
            const auto i = static_cast<std::size_t>(body);
            const talus::Vector<Dim> arm = s.contacts.point[c] - s.bodies.position[i];
            const auto turn = talus::Rotation<Dim>::exp(dt * twists[i].angular);
            return talus::Vector<Dim>(s.bodies.position[i] + dt * twists[i].linear + turn * arm);
        };
        const talus::Vector<Dim> apart = (moved(s.jacobian.a[c]) - moved(s.jacobian.b[c])) / dt;
        const talus::Vector<Dim> u = talus::relative_velocity<Dim>(s.jacobian, c, twists);
        BOOST_CHECK_SMALL(u[0] - s.contacts.normal[c].dot(apart), 1e-5);
        BOOST_CHECK_SMALL((u - s.jacobian.frame[c] * apart).norm(), 1e-5);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(velocity_and_impulse_maps_are_transposes, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(72);
    const RandomContacts<Dim> s(rng);
    const auto v = random_twists<Dim>(rng, 3);
    std::vector<talus::Vector<Dim>> r(s.contacts.count());
    for (auto& x : r) x = random_input::vector<talus::Vector<Dim>>(rng);
    // r . H^T v = (H r) . v, with H r = M (M^-1 H r); the obstacle's share is not moved.
    double left = 0.0;
    auto at_rest_obstacle = v;
    at_rest_obstacle[2] = {};
    for (std::size_t c = 0; c < r.size(); ++c)
        left += r[c].dot(talus::relative_velocity<Dim>(s.jacobian, c, at_rest_obstacle));
    std::vector<talus::Twist<Dim>> dv(3);
    talus::apply_impulses<Dim>(s.jacobian, s.inverse_mass, r, dv);
    double right = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
        right +=
            s.bodies.mass(i) * dv[i].linear.dot(v[i].linear) +
            (talus::tensor_world<Dim>(s.bodies.rotation[i], s.bodies.inertia(i)) * dv[i].angular)
                .dot(v[i].angular);
    BOOST_CHECK_SMALL(left - right, 4 * tolerance);
    BOOST_CHECK(dv[2].linear.isZero(0.0) && dv[2].angular.isZero(0.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_impulse_pushes_a_along_the_normal, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(73);
    const RandomContacts<Dim> s(rng);
    std::vector<talus::Vector<Dim>> r(s.contacts.count(), talus::Vector<Dim>::Zero());
    r[0][0] = 1.0;
    std::vector<talus::Twist<Dim>> dv(3);
    talus::apply_impulses<Dim>(s.jacobian, s.inverse_mass, r, dv);
    BOOST_CHECK_SMALL((dv[0].linear - s.contacts.normal[0] / s.bodies.mass(0)).norm(), tolerance);
    BOOST_CHECK_SMALL((dv[1].linear + s.contacts.normal[0] / s.bodies.mass(1)).norm(), tolerance);
    BOOST_CHECK_GT(talus::relative_velocity<Dim>(s.jacobian, 0, dv)[0], 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_jacobian_of_another_size_is_that_in_all_its_parts, D, dimensions) {
    talus::ContactJacobian<D::value> jacobian;
    jacobian.resize(2);
    jacobian.held.assign(2, 0.5);
    jacobian.make_room(10);
    BOOST_TEST(jacobian.held.capacity() >= 10U);
    jacobian.resize(5);
    BOOST_TEST(jacobian.held.size() == 5U);
    BOOST_TEST((jacobian.held[1] == 0.5 && jacobian.held[4] == 0.0));
}

BOOST_AUTO_TEST_SUITE_END()
