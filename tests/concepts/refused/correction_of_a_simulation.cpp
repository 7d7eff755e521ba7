// SPDX-License-Identifier: BSL-1.0
// expect: Types::GapCorrection must be a PositionCorrection
// expect: require_valid
#include <talus/stepping/simulation.hpp>

struct Mine : talus::SimulationTypes<3> {
    using GapCorrection = int;
};
talus::Simulation<3, Mine> simulation(talus::DefaultLaw<3>{});
