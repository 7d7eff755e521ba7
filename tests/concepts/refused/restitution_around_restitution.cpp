// SPDX-License-Identifier: BSL-1.0
// expect: LawWithoutRestitution
// The inner restitution would be ignored: a weighted mean is of a law that has none.
#include <talus/stepping/simulation.hpp>

struct Mine : talus::SimulationTypes<3> {
    using Law = talus::WeightedMean<3, talus::DefaultLaw<3>>;
};
talus::Simulation<3, Mine> simulation(Mine::Law{{{0.3}, 0.5}, 0.5});
