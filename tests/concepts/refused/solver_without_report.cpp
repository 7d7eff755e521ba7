// SPDX-License-Identifier: BSL-1.0
// expect: must be a ContactSolver
// A solver returns a report of what it reached.
#include <talus/stepping/simulation.hpp>

struct Silent {
    void solve(const talus::ContactProblem<2, talus::DefaultLaw<2>>&, std::span<talus::Vector<2>>) {
    }
};
struct Mine : talus::SimulationTypes<2> {
    using Solver = Silent;
};
talus::Simulation<2, Mine> simulation(talus::DefaultLaw<2>{});
