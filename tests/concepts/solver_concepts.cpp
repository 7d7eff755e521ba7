// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/law/signorini.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/solver/any_solver.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/cones/inexact_interior_point.hpp>
#include <talus/solver/oracle/enumeration.hpp>

namespace solver_concepts {

using Law = talus::Signorini<3>;
using Problem = talus::ContactProblem<3, Law>;

struct Archetype {
    talus::SolveReport solve(const Problem&, std::span<talus::Vector<3>>) { return {}; }
};
static_assert(talus::ContactSolver<Archetype, 3, Law>);
static_assert(!talus::ContactSolver<Archetype, 2, talus::Signorini<2>>);

// What an AnySolver is made of keeps its report: a returned copy would not outlive the call.
template <class Report>
struct OfAllForms {
    talus::SolveReport kept;
    Report solve(const Problem&, std::span<talus::Vector<3>>) { return kept; }
    Report solve(talus::DelassusSparse<3>&, std::span<const talus::Vector<3>>, std::span<const Law>,
                 std::span<talus::Vector<3>>) {
        return kept;
    }
    Report solve(talus::DelassusGlobal<3>&, std::span<const talus::Vector<3>>, std::span<const Law>,
                 std::span<talus::Vector<3>>) {
        return kept;
    }
    Report report() const { return kept; }
};
static_assert(talus::FormsSolver<OfAllForms<const talus::SolveReport&>, 3, Law>);
static_assert(!talus::FormsSolver<OfAllForms<talus::SolveReport>, 3, Law>);

struct WithoutReport {
    void solve(const Problem&, std::span<talus::Vector<3>>) {}
};
static_assert(!talus::ContactSolver<WithoutReport, 3, Law>);

struct ChangesTheProblem {
    talus::SolveReport solve(Problem&, std::span<talus::Vector<3>>) { return {}; }
};
static_assert(!talus::ContactSolver<ChangesTheProblem, 3, Law>);

// Solvers that treat all contacts at once take laws with a cone, and refuse others when compiled.
template <template <int, class> class Solver, int Dim, class L>
concept Takes = requires {
    typename Solver<Dim, L>;
};
template <int Dim, class L>
constexpr bool cone_engines_take =
    Takes<talus::InteriorPoint, Dim, L>&& Takes<talus::InexactInteriorPoint, Dim, L>&&
        Takes<talus::NewtonPolish, Dim, L>&& Takes<talus::ProjectedGradient, Dim, L>&&
            Takes<talus::ProximalNewton, Dim, L>&& Takes<talus::Enumeration, Dim, L>;
template <int Dim, class L>
constexpr bool cone_engines_refuse =
    !Takes<talus::InteriorPoint, Dim, L> && !Takes<talus::InexactInteriorPoint, Dim, L> &&
    !Takes<talus::NewtonPolish, Dim, L> && !Takes<talus::ProjectedGradient, Dim, L> &&
    !Takes<talus::ProximalNewton, Dim, L> && !Takes<talus::Enumeration, Dim, L>;

/// A law with a cone by name, but of another type: a near-miss.
struct HalfACone : talus::Bilateral<3> {
    double friction_cone() const { return 0.5; }
};

template <int Dim>
constexpr bool cones_are_told_apart =
    cone_engines_take<Dim, talus::Coulomb<Dim>>&& cone_engines_take<Dim, talus::Signorini<Dim>>&&
        cone_engines_take<Dim, talus::WeightedMean<Dim, talus::Coulomb<Dim>>>&&
            cone_engines_take<Dim, talus::AnyLaw<Dim, talus::Coulomb<Dim>, talus::Bilateral<Dim>>>&&
                cone_engines_refuse<Dim, talus::Bilateral<Dim>>&&
                    cone_engines_refuse<Dim, talus::CohesiveCoulomb<Dim>> &&
    !Takes<talus::InteriorPoint, Dim, talus::Coulomb<5 - Dim>>;
static_assert(cones_are_told_apart<2> && cones_are_told_apart<3>);
static_assert(cone_engines_refuse<3, HalfACone> &&
              cone_engines_refuse<3, talus::RollingCoulomb<3>>);
// Sweeps know rolling rows, in a simulation too; nobody else does, whatever adapts the law.
template <template <int, class> class Solver, int Dim, class L>
constexpr bool steps_with = talus::ContactSolver<Solver<talus::law_rows<L, Dim>, L>, Dim, L>;
template <int Dim, class L = talus::RollingFriction<Dim>>
constexpr bool sweeps_alone_take =
    steps_with<talus::GaussSeidel, Dim, L>&& steps_with<talus::AcceleratedGaussSeidel, Dim, L>&&
        cone_engines_refuse<Dim, L> &&
    !Takes<talus::Automatic, talus::law_rows<L, Dim>, L> && !Takes<talus::AnySolver, Dim, L>;
template <int Dim>
using Bouncing = talus::WeightedMean<talus::rows_with_rolling<Dim>, talus::RollingFriction<Dim>>;
static_assert(sweeps_alone_take<2> && sweeps_alone_take<3>);
static_assert(sweeps_alone_take<2, Bouncing<2>> && cone_engines_refuse<3, Bouncing<2>>);
static_assert(Takes<talus::Automatic, 3, talus::Bilateral<3>> &&
              Takes<talus::Automatic, 3, HalfACone>);

}  // namespace solver_concepts
