// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/contact_list.hpp>
#include <talus/lagrangian/gap_derivatives.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/solver/report.hpp>

#include <Eigen/Core>

#include <concepts>
#include <span>

namespace talus {

namespace detail {

template <class S>
constexpr int rows_of_system() {
    if constexpr (requires { S::rows; })
        return S::rows;
    else
        return 2;
}
template <class S>
struct LawOfSystem {
    using type = WeightedMean<rows_of_system<S>(), Coulomb<rows_of_system<S>()>>;
};
template <class S>
requires requires { typename S::Law; }
struct LawOfSystem<S> {
    using type = typename S::Law;
};

}  // namespace detail

/// What follows from a system's own words: `dof`, the number of its coordinates or Eigen::Dynamic;
/// `rows` of a contact, 2 (the plane) unless it says 3; `Law`, friction and restitution unless it
/// names another.
template <class S>
struct LagrangianTypes {
    static constexpr int dof = S::dof;
    static constexpr int rows = detail::rows_of_system<S>();
    static_assert(dof == Eigen::Dynamic || dof > 0, "dof must be positive, or Eigen::Dynamic");
    static_assert(ContactRows<rows>, "a contact has 2 rows in the plane and 3 in space");
    using Law = typename detail::LawOfSystem<S>::type;
    static_assert(ContactLaw<Law, rows>, "Law must be a ContactLaw of the system's rows");
    using Coordinates = Eigen::Matrix<double, dof, 1>;   ///< q, u and F
    using MassMatrix = Eigen::Matrix<double, dof, dof>;  ///< A
    using Contacts = ContactList<rows, dof, Law>;
    using Number = GapNumber<dof>;
    using NumberCoordinates = Eigen::Matrix<Number, dof, 1>;
    using Gaps = GapList<Number, rows, Law>;
};

/// A system that gives G and W itself.
template <class S>
concept GivesJacobians = requires(const S& s, double t,
                                  const typename LagrangianTypes<S>::Coordinates& q,
                                  typename LagrangianTypes<S>::Contacts& contacts) {
    s.contacts(t, q, contacts);
};

/// A system that gives gaps and tangential displacements, in any numbers: G and W are their
/// derivatives.
template <class S>
concept GivesGaps = requires(const S& s, const typename LagrangianTypes<S>::Number& t,
                             const typename LagrangianTypes<S>::NumberCoordinates& q,
                             typename LagrangianTypes<S>::Gaps& contacts) {
    s.gaps(t, q, contacts);
};

/// A mechanical system with coordinates q and velocities u = dq/dt [Moreau, section 1.2 and (3)],
///
///   A(t, q) du = F(t, q, u) dt + G^T dr ,     U = G u + W ,
///
/// with as many coordinates as the system has degrees of freedom. (Other velocities than dq/dt, as
/// the spins of a body in space, are those of Simulation.) It says:
///
///   static constexpr int dof = 2;                             // or Eigen::Dynamic
///   void mass(double t, const auto& q, auto& a) const;        // A, in full, both triangles
///   void force(double t, const auto& q, const auto& u, auto& f) const;  // F, Coriolis included
///   void contacts(double t, const auto& q, auto& contacts) const;       // a ContactList
///
/// or, in place of `contacts`, `void gaps(const auto& t, const auto& q, auto& contacts) const` (a
/// GapList): t and q are then numbers that carry derivatives. It calls `sin(q[0])`, not
/// `std::sin`, and keeps results as `Real`, not `auto`, which would keep references to what is
/// gone. With both, `contacts` is what counts, and `require_jacobians` compares the two.
///
/// A and F arrive as zeros of the right size, contacts as an empty list. All functions depend on
/// their arguments alone while a step is made.
template <class S>
concept LagrangianSystem = requires {
    { S::dof } -> std::convertible_to<int>;
}
&&requires(const S& s, double t, const typename LagrangianTypes<S>::Coordinates& q,
           typename LagrangianTypes<S>::MassMatrix& a,
           typename LagrangianTypes<S>::Coordinates& f) {
    s.mass(t, q, a);
    s.force(t, q, q, f);
}
&&(GivesJacobians<S> || GivesGaps<S>);

/// Finds impulses for a problem given by its W. The same promises as of ContactSolver.
template <class S, int Rows, class Law>
concept AssembledSolver = requires(S& solver, AssembledProblem<Rows, Law>& problem,
                                   std::span<Vector<Rows>> r) {
    { solver.solve(problem, r) } -> std::convertible_to<const SolveReport&>;
};

}  // namespace talus
