// SPDX-License-Identifier: BSL-1.0
// expect: find_pairs
#include <talus/stepping/simulation.hpp>

struct Nothing {};
struct Mine : talus::SimulationTypes<2> {
    using BroadPhase = Nothing;
};
talus::Simulation<2, Mine> simulation(talus::DefaultLaw<2>{});
