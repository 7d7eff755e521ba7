// SPDX-License-Identifier: BSL-1.0
// expect: has_rolling_rows
// Engines that treat all contacts at once do not know the rows of rolling friction.
#include <talus/law/rolling_coulomb.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/stepping/simulation.hpp>

struct Mine : talus::SimulationTypes<2> {
    using Law = talus::RollingFriction<2>;
    using Solver = talus::InteriorPoint<2, Law>;
};
talus::Simulation<2, Mine> simulation(Mine::Law{0.5, 0.1});
