// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/simulation.hpp>
#include <talus/solver/oracle/enumeration.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>

#include <boost/test/unit_test.hpp>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_solvers)

using namespace machines;
using talus::LagrangianSimulation;

BOOST_AUTO_TEST_CASE(solvers_agree) {
    DoublePendulum pendulum{.wall = 0.8};
    pendulum.law = {{0.3}, 0.4, 0.0};
    using System = DoublePendulum;
    LagrangianSimulation plain(pendulum, Two(1.0, -1.0), {.h = 1e-3});
    LagrangianSimulation<System, talus::Enumeration<2, PlaneLaw>> all(pendulum, Two(1.0, -1.0),
                                                                      {.h = 1e-3});
    LagrangianSimulation<System, talus::AcceleratedGaussSeidel<2, PlaneLaw>> fast(
        pendulum, Two(1.0, -1.0), {.h = 1e-3});
    BOOST_TEST(plain.run(2.0).certified());
    BOOST_TEST(all.run(2.0).certified());
    BOOST_TEST(fast.run(2.0).certified());
    BOOST_CHECK_SMALL((plain.position() - all.position()).norm(), 1e-9);
    BOOST_CHECK_SMALL((plain.position() - fast.position()).norm(), 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
