// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/stepping/step_hooks.hpp>
#include <talus/stepping/system.hpp>

#include <concepts>
#include <type_traits>

namespace talus {

/// Stands for Gauss-Seidel with momentum, with whatever law the simulation has, and settings that
/// let piles come to rest with hardly a step that misses its tolerance.
///
/// At the tolerance, 1e-3, no contact violates its law by more than a hundredth of the largest
/// violation that there would be in its island without impulses: overlaps of some 1e-4 of a radius
/// in piles that flow. Towers of fifty blocks fall with that within seconds and stand with a tenth
/// of it. So each step goes on to 1e-4 within its first half million visits of contacts, and up to
/// 50 double sweeps in large systems: some hundred contacts get there in nearly every step. What
/// was reached is in the report of the step, and the worst of a run in `RunSummary::residual`.
/// For one accuracy in all steps, and in scenes of thousands of contacts that stand by little, set
/// both `tolerance` and `aim` to it.
struct DefaultSolver {
    static constexpr AcceleratedGaussSeidelParams params{.max_iterations = 20000,
                                                         .tolerance = 1e-3,
                                                         .acceleration = Acceleration::nesterov,
                                                         .aim = 1e-4};
};

/// A simulation without correction of positions: the paper's, and the default. Costs nothing.
struct NoGapCorrection {
    void require_valid() const {}
    template <class SystemType, class Data>
    void apply(SystemType&, Data&) {}
};

/// What corrects positions after a step, which has the settings it finds valid. If it remembers
/// anything from step to step it also has `write(NumberRecord&)` and
/// `restore(NumberRecordReader&)`, so that checkpoints hold it (GapCorrection).
template <class C, class SystemType, class Data>
concept PositionCorrection = requires(C& correction, SystemType& system, Data& data) {
    correction.require_valid();
    correction.apply(system, data);
};

/// The types that a simulation is made of. Derive from it and name those that are to be others; the
/// rest need not be spelt (and one whose name is misspelt stays as it was):
///
///     struct Mine : SimulationTypes<3> {
///         using Solver = Automatic<3, Law>;
///     };
///     Simulation<3, Mine> sim({Coulomb<3>{.mu = 0.4}});
///
/// (In a template for both dimensions the law is `typename SimulationTypes<Dim>::Law`.) Of a law
/// with rolling friction, GaussSeidel and AcceleratedGaussSeidel are solvers, for its law_rows in
/// place of `Dim`.
template <int Dim>
requires SpaceDimension<Dim>
struct SimulationTypes {
    using Law = DefaultLaw<Dim>;               ///< a ContactLaw: of every contact
    using Shape = AnyShape<Dim>;               ///< of every body; AnyShapeOf for a list of your own
    using Solver = DefaultSolver;              ///< or a ContactSolver for that law
    using BroadPhase = HierarchicalGrid<Dim>;  ///< a BroadPhase
    using Hooks = NoHooks;                     ///< called between the stages (step_hooks.hpp)
    using GapCorrection = NoGapCorrection;     ///< or GapCorrection<Dim> (gap_correction.hpp)
};

/// The solver that such types ask for.
template <int Dim, class Types>
using SolverOf = std::conditional_t<
    std::same_as<typename Types::Solver, DefaultSolver>,
    AcceleratedGaussSeidel<law_rows<typename Types::Law, Dim>, typename Types::Law>,
    typename Types::Solver>;
/// One with its own defaults, or with those of DefaultSolver.
template <int Dim, class Types>
SolverOf<Dim, Types> default_solver() {
    if constexpr (std::same_as<typename Types::Solver, DefaultSolver>)
        return SolverOf<Dim, Types>(DefaultSolver::params);
    else
        return SolverOf<Dim, Types>();
}

}  // namespace talus

TALUS_IN_PLANE(class talus::AcceleratedGaussSeidel<2, talus::DefaultLaw<2>>)
TALUS_IN_SPACE(class talus::AcceleratedGaussSeidel<3, talus::DefaultLaw<3>>)
