// SPDX-License-Identifier: BSL-1.0
// expect: law.solve(p, r)
#include <talus/law/rolling_coulomb.hpp>
#include <talus/stepping/simulation.hpp>

struct Mine : talus::SimulationTypes<3> {
    using Law = talus::RollingFriction<2>;
};
talus::Simulation<3, Mine> simulation(Mine::Law{0.5, 0.1});
