// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/solver/any_solver.hpp>

#include "setting.hpp"

// Compiled in solvers_plane.cpp and solvers_space.cpp.
extern template struct talus::SolverRegistry<2, validation::Law<2>>;
extern template struct talus::SolverRegistry<3, validation::Law<3>>;
