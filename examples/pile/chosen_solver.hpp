// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/solver/any_solver.hpp>
#include <talus/stepping/simulation_types.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"

namespace pile {

/// The solver of the library that was asked for by name; or by default that of simulations, and
/// `automatic` for the few problems that it does not solve.
///
/// The library is compiled with solvers by name for Coulomb's law alone. Restitution only shifts
/// the free velocity, and assembly has done that: what is solved is Coulomb's law.
template <int Dim>
class ChosenSolver {
  public:
    using Law = talus::DefaultLaw<Dim>;

    ChosenSolver() : ChosenSolver("", {}) {}
    /// An empty name: the default. Throws input_error that lists the names there are.
    ChosenSolver(const std::string& name, talus::SolverSettings settings)
        : default_(talus::DefaultSolver::params),
          is_default_(name.empty()),
          named_(talus::make_solver<Dim, talus::Coulomb<Dim>>(name.empty() ? "automatic" : name,
                                                              settings)) {
        default_.params.tolerance = settings.tolerance;
        default_.params.aim = settings.tolerance;  // one accuracy in all steps
        if (settings.max_iterations) default_.params.max_iterations = *settings.max_iterations;
    }

    const talus::SolveReport& solve(const talus::ContactProblem<Dim, Law>& problem,
                                    std::span<talus::Vector<Dim>> r) {
        if (!is_default_) return solve_with_named(problem, r);
        const talus::SolveReport& first = default_.solve(problem, r);
        if (first.status == talus::SolveStatus::converged) return first;
        kept_.assign(r.begin(), r.end());
        const talus::SolveReport& second = solve_with_named(problem, r);
        if (second.residual < first.residual) return second;
        std::copy(kept_.begin(), kept_.end(), r.begin());
        return first;
    }

  private:
    const talus::SolveReport& solve_with_named(const talus::ContactProblem<Dim, Law>& problem,
                                               std::span<talus::Vector<Dim>> r) {
        problem_.inverse_mass = problem.inverse_mass;
        problem_.jacobian = problem.jacobian;
        problem_.free_velocity = problem.free_velocity;
        problem_.laws.clear();
        for (const Law& law : problem.laws) problem_.laws.push_back(law.law);
        return named_.solve(problem_, r);
    }

    talus::AcceleratedGaussSeidel<Dim, Law> default_;
    bool is_default_;
    talus::AnySolver<Dim, talus::Coulomb<Dim>> named_;
    std::vector<talus::Vector<Dim>> kept_;
    talus::ContactProblem<Dim, talus::Coulomb<Dim>> problem_;  ///< what the named one is given
};

}  // namespace pile
