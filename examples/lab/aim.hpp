// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/stepping/simulation.hpp>

namespace lab {

/// The default solver with another aim (DefaultSolver): 1e-3, its tolerance, is enough for what
/// flows, and takes a part of the time. Where grains that slide lock at once, it is given five
/// times the iterations.
template <int Dim>
talus::SolverOf<Dim, talus::SimulationTypes<Dim>> solver_with_aim(double aim) {
    auto params = talus::DefaultSolver::params;
    params.aim = aim;
    params.max_iterations *= 5;
    return talus::SolverOf<Dim, talus::SimulationTypes<Dim>>(params);
}

}  // namespace lab
