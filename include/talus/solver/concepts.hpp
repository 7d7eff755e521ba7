// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/contact_problem.hpp>
#include <talus/solver/report.hpp>

#include <concepts>
#include <span>

namespace talus {

/// Finds impulses for a contact problem. `r` carries the warm start in and the result out. Never
/// throws for want of convergence and never reports `converged` at an iteration cap.
template <class S, int Dim, class Law>
concept ContactSolver = requires(S& solver, const ContactProblem<Dim, Law>& problem,
                                 std::span<Vector<law_rows<Law, Dim>>> r) {
    { solver.solve(problem, r) } -> std::convertible_to<const SolveReport&>;
};

}  // namespace talus
