// SPDX-License-Identifier: BSL-1.0
// expect: natural_map
// A law must name the map whose fixed points obey it: no residual can be measured without.
#include <talus/stepping/simulation.hpp>

struct Sticky {
    talus::Vector<3> solve(const talus::LocalProblem<3>& p, const talus::Vector<3>&) const {
        return -p.b;
    }
};
struct Mine : talus::SimulationTypes<3> {
    using Law = Sticky;
};
talus::Simulation<3, Mine> simulation(Sticky{});
