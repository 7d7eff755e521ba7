// SPDX-License-Identifier: BSL-1.0
#include <talus/talus.hpp>

#ifndef TALUS_COMPILED
#error "talus::compiled says that it is there"
#endif

/// Succeeds when a ball comes to rest on a floor.
int main() {
    talus::Simulation<3> sim({talus::Coulomb<3>{.mu = 0.3}}, {.h = 1e-3});
    sim.system().gravity[2] = -9.81;
    sim.system().add_obstacle(talus::HalfSpace<3>({0.0, 0.0, 1.0}));
    sim.system().add(talus::Ball<3>(0.1), 1000.0, {{0.0, 0.0, 0.11}, {}});
    const talus::RunSummary run = sim.run(0.2);
    return run.certified() && sim.system().bodies.velocity[1].norm() < 1e-9 ? 0 : 1;
}
