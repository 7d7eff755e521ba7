// SPDX-License-Identifier: BSL-1.0
// What is written as a Lagrangian system moves as the same bodies do.
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/stepping/simulation.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_rigid_bodies)

using namespace machines;

namespace {

constexpr double radius = 0.1, slope = 0.3, mass_of_disc = 2.0;
constexpr double inertia_of_disc = 0.5 * mass_of_disc * radius * radius;
const PlaneLaw law{{0.2}, 0.5, 0.0};

/// A disc over the plane y = 0, gravity leaning: (x, y, angle).
struct Disc {
    static constexpr int dof = 3;

    void mass(double, const auto&, auto& a) const {
        a.diagonal() << mass_of_disc, mass_of_disc, inertia_of_disc;
    }
    void force(double, const auto&, const auto&, auto& f) const {
        f << mass_of_disc * g * std::sin(slope), -mass_of_disc * g * std::cos(slope), 0.0;
    }
    void contacts(double, const auto& q, auto& contacts) const {
        contacts.add(q[1] - radius, law).rows << 0.0, 1.0, 0.0,  // normal
            1.0, 0.0, radius;                                    // tangent
    }
};

/// A point over a floor in space.
struct Puck {
    static constexpr int dof = 3, rows = 3;
    using Law = talus::Coulomb<3>;

    void mass(double, const auto&, auto& a) const { a.setIdentity(); }
    void force(double, const auto&, const auto&, auto& f) const { f << 0.0, 0.0, -g; }
    void contacts(double, const auto& q, auto& contacts) const {
        contacts.add(q[2], Law{0.3}).rows << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_disc_on_a_slope) {
    const double h = 1e-3;
    const Eigen::Vector3d q(0.0, 0.15, 0.0), u(-0.5, -0.2, 3.0);
    talus::LagrangianSimulation disc(Disc{}, q, u, 0.0, {.h = h});
    talus::SimulationParams params{.h = h};
    params.step.contact_tolerance = 0.0;
    talus::Simulation<2> body({law}, params);
    body.solver().params.tolerance = body.solver().params.aim = 1e-12;
    auto& system = body.system();
    system.gravity = g * talus::Vector<2>(std::sin(slope), -std::cos(slope));
    system.add_obstacle(talus::HalfSpace<2>{talus::Vector<2>(0.0, 1.0), 0.0});
    const talus::Inertia<2> inertia{mass_of_disc, talus::AngularVector<2>(inertia_of_disc)};
    const auto i = system.add(talus::Ball<2>{radius}, inertia, {{q[0], q[1]}, {}},
                              {{u[0], u[1]}, talus::AngularVector<2>(u[2])});
    double worst = 0.0, slowest_slip = 1.0;
    std::size_t touched = 0;
    for (int k = 0; k < 1500; ++k) {
        body.step();
        const auto& data = disc.step();
        const auto twist = system.bodies.twist(static_cast<std::size_t>(i));
        const auto& x = system.bodies.position[i];
        const Eigen::Vector3d v(twist.linear[0], twist.linear[1], twist.angular[0]);
        worst = std::max({worst, (v - disc.velocity()).norm(),
                          (x - talus::Vector<2>(disc.position()[0], disc.position()[1])).norm()});
        touched += data.contact_count();
        if (data.contact_count() == 1)
            slowest_slip = std::min(slowest_slip, std::abs(data.end_velocity(0)[1]));
    }
    BOOST_CHECK_SMALL(worst, 1e-10);
    BOOST_TEST(touched > 500u);              // it bounces, slides
    BOOST_CHECK_SMALL(slowest_slip, 1e-10);  // and rolls
}

BOOST_AUTO_TEST_CASE(a_puck_slides_to_rest_in_space) {
    const double h = 1e-3, mu = 0.3;
    const Eigen::Vector3d speed(0.6, 0.8, 0.0);
    talus::LagrangianSimulation puck(Puck{}, Eigen::Vector3d(0.0, 0.0, 0.0), speed, 0.0, {.h = h});
    BOOST_TEST(puck.run(0.2).certified());
    BOOST_CHECK_SMALL((puck.velocity() - (1.0 - mu * g * 0.2) * speed).norm(), 1e-12);
    const auto run = puck.run(0.3);
    BOOST_TEST(run.certified());
    BOOST_CHECK_SMALL(puck.velocity().norm(), 1e-12);
    BOOST_TEST(run.overlap.value == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
