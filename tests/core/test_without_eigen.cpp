// SPDX-License-Identifier: BSL-1.0
// A program of the default solver compiles without a header of Eigen's.
#include <talus/talus.hpp>

#ifdef EIGEN_WORLD_VERSION
#error "talus.hpp includes Eigen"
#endif

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(without_eigen)

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_falls, D, dimensions) {
    constexpr int Dim = D::value;
    using talus::Vector;
    talus::Simulation<Dim> simulation({talus::Coulomb<Dim>{.mu = 0.3}}, {.h = 1e-3});
    auto& system = simulation.system();
    system.gravity = -10.0 * Vector<Dim>::Unit(Dim - 1);
    system.add_obstacle(talus::HalfSpace<Dim>{Vector<Dim>::Unit(Dim - 1), 0.0});
    Vector<Dim> start;
    start[Dim - 1] = 0.15;
    system.add(talus::Ball<Dim>{0.1}, 1000.0, {start, {}});
    BOOST_TEST(simulation.run(0.5).missed == 0);
    BOOST_TEST(std::abs(system.bodies.position[1][Dim - 1] - 0.1) < 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
