// SPDX-License-Identifier: BSL-1.0
//
// What bench/compile_times.py calls the small program: a disc falls on a floor, in the plane alone.
#include <talus/talus.hpp>

int main() {
    talus::Simulation<2> sim({talus::Coulomb<2>{.mu = 0.3}}, talus::SimulationParams{.h = 1e-3});
    sim.system().add_obstacle(talus::HalfSpace<2>{talus::Vector<2>::UnitY(), 0.0});
    sim.system().add(talus::Ball<2>{0.1}, 1000.0, {talus::Vector<2>::UnitY(), {}});
    return sim.run(1.0).certified() ? 0 : 1;
}
