// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "solver_registry.hpp"

namespace bench {

/// Solvers of Siconos numerics (Debian: libsiconos-numerics-dev) with its own defaults, but for the
/// tolerance and the limit of iterations. They are given the assembled W as it is, block by block.
std::vector<RegisteredSolver> siconos_solvers(PeerUnits units);

}  // namespace bench
