// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/solver_registry.hpp>

#include "solvers.hpp"

template struct talus::SolverRegistry<3, validation::Law<3>>;
