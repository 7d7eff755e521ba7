// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <talus/solver/solver_registry.hpp>

#include "world.hpp"

template struct talus::SolverRegistry<2, validation::Law<2>>;
template struct talus::SolverRegistry<3, validation::Law<3>>;

std::vector<std::string> validation::solver_names() {
    std::vector<std::string> names;
    for (const auto& solver : talus::solver_names<3, Law<3>>()) names.emplace_back(solver.name);
    return names;
}
