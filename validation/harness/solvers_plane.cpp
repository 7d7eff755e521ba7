// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/solver_registry.hpp>

#include "solvers.hpp"

template struct talus::SolverRegistry<2, validation::Law<2>>;
