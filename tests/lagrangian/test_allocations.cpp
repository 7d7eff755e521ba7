// SPDX-License-Identifier: BSL-1.0
// A steady step allocates nothing. Counts every operator new of this program.
#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include "common/allocation_counter.hpp"
#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_allocations)

using namespace machines;

namespace {

template <class Sim>
long allocations_after(Sim& sim, double start, double duration) {
    BOOST_TEST(sim.run(start).certified());
    const long before = allocation_count;
    const auto run = sim.run(duration);
    const long after = allocation_count;
    BOOST_TEST(run.certified());
    return after - before;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_steady_step_allocates_nothing) {
    DoublePendulum pendulum{.wall = 0.8};
    pendulum.law = {{0.3}, 0.4, 0.0};
    talus::LagrangianSimulation fixed(
        pendulum, Two(1.0, -1.0),
        {.h = 1e-3, .velocity_forces = talus::VelocityForces::implicit_midpoint});
    BOOST_TEST(allocations_after(fixed, 2.0, 1.0) == 0);
    const Eigen::VectorXd heights = Eigen::Vector3d(0.05, 0.2, 0.4);
    for (const auto forces :
         {talus::VelocityForces::explicit_begin, talus::VelocityForces::implicit_midpoint}) {
        talus::LagrangianSimulation stack(Stack{}, heights, {.h = 1e-3, .velocity_forces = forces});
        BOOST_TEST(allocations_after(stack, 0.5, 0.5) == 0);
        talus::LagrangianSimulation by_gaps(StackByGaps{}, heights,
                                            {.h = 1e-3, .velocity_forces = forces});
        BOOST_TEST(allocations_after(by_gaps, 0.5, 0.5) == 0);
    }
}

BOOST_AUTO_TEST_SUITE_END()
