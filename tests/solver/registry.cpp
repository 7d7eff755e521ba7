// SPDX-License-Identifier: BSL-1.0
#include "registry.hpp"

#include <talus/solver/solver_registry.hpp>

template struct talus::SolverRegistry<2, talus::Bilateral<2>>;
template struct talus::SolverRegistry<3, talus::Bilateral<3>>;
