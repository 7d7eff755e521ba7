// SPDX-License-Identifier: BSL-1.0
// expect: Types::Hooks must be StepHooks
// expect: at_midpoint
#include <talus/stepping/simulation.hpp>

struct Mine : talus::SimulationTypes<2> {
    using Hooks = int;
};
talus::Simulation<2, Mine> simulation(talus::DefaultLaw<2>{});
