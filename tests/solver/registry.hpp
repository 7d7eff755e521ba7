// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/bilateral.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/any_solver.hpp>

// Compiled apart, as users may do.
extern template struct talus::SolverRegistry<2, talus::Bilateral<2>>;
extern template struct talus::SolverRegistry<3, talus::Bilateral<3>>;
