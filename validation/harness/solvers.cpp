// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include "world.hpp"

std::vector<std::string> validation::solver_names() {
    std::vector<std::string> names;
    for (const auto& solver : talus::solver_names<3, Law<3>>()) names.emplace_back(solver.name);
    return names;
}
