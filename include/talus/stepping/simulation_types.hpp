// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/hierarchical_grid.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/step_hooks.hpp>
#include <talus/stepping/system.hpp>

#include <concepts>
#include <type_traits>

namespace talus {

/// Stands for Gauss-Seidel with whatever law the simulation has.
struct DefaultSolver {};

/// A simulation without correction of positions: the paper's, and the default. Costs nothing.
struct NoGapCorrection {
    void require_valid() const {}
    template <class SystemType, class Data>
    void apply(SystemType&, Data&) {}
};

/// The types that a simulation is made of. Derive from it and name those that are to be others; the
/// rest need not be spelt:
///
///     struct Mine : SimulationTypes<3> {
///         using Solver = Automatic<3, Law>;
///     };
///     Simulation<3, Mine> sim(...);
///
/// (In a template for both dimensions the law is `typename SimulationTypes<Dim>::Law`.)
template <int Dim>
requires SpaceDimension<Dim>
struct SimulationTypes {
    using Law = DefaultLaw<Dim>;               ///< a ContactLaw: of every contact
    using Shape = AnyShape<Dim>;               ///< of every body; AnyShapeOf for a list of your own
    using Solver = DefaultSolver;              ///< a ContactSolver for that law
    using BroadPhase = HierarchicalGrid<Dim>;  ///< a BroadPhase
    using Hooks = NoHooks;                     ///< called between the stages (step_hooks.hpp)
    using GapCorrection = NoGapCorrection;     ///< or GapCorrection<Dim> (gap_correction.hpp)
};

/// The solver that such types ask for.
template <int Dim, class Types>
using SolverOf = std::conditional_t<std::same_as<typename Types::Solver, DefaultSolver>,
                                    GaussSeidel<Dim, typename Types::Law>, typename Types::Solver>;

}  // namespace talus
