// SPDX-License-Identifier: BSL-1.0
#pragma once

/// What programs of rigid bodies are written with: shapes, laws, simulations with Gauss-Seidel, the
/// equilibrium test, measures. For examples and short programs; library headers include what they
/// use. Apart, since few programs need them and they cost more than as much again to compile: the
/// solvers that treat all contacts at once (solver/automatic.hpp, solver/cones, solver/oracle) and
/// those by name (solver/any_solver.hpp, solver/solver_registry.hpp), problems given by matrices
/// (problem/matrix_problem.hpp), rolling friction (law/rolling_coulomb.hpp), correction of
/// positions (stepping/gap_correction.hpp), walls that press (dynamics/servo.hpp), the measures of
/// networks, chains, cuts, rings, series and directions about an axis, and the folders sample,
/// feed, lagrangian and io.
#include <talus/collision/brute_force.hpp>
#include <talus/core/version.hpp>
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/signorini.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/fabric.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/measure/momentum.hpp>
#include <talus/measure/penetration.hpp>
#include <talus/measure/stress.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/spatial/tilt.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>
#include <talus/stepping/step_queries.hpp>
