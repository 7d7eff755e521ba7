// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Everything but io: for examples and short programs. Library headers include what they use.
#include <talus/collision/brute_force.hpp>
#include <talus/core/version.hpp>
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/law/signorini.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/measure/momentum.hpp>
#include <talus/measure/penetration.hpp>
#include <talus/problem/body_map.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/problem/matrix_problem.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>
