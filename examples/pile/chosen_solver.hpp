// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/solver/any_solver.hpp>
#include <talus/stepping/simulation_types.hpp>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"

namespace pile {

/// The solver of the library that was asked for by name, or that of simulations by default.
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
        : default_({.max_sweeps = settings.max_iterations, .tolerance = settings.tolerance}) {
        if (!name.empty())
            named_.emplace(talus::make_solver<Dim, talus::Coulomb<Dim>>(name, settings));
    }

    const talus::SolveReport& solve(const talus::ContactProblem<Dim, Law>& problem,
                                    std::span<talus::Vector<Dim>> r) {
        if (!named_) return default_.solve(problem, r);
        problem_.inverse_mass = problem.inverse_mass;
        problem_.jacobian = problem.jacobian;
        problem_.free_velocity = problem.free_velocity;
        problem_.laws.clear();
        for (const Law& law : problem.laws) problem_.laws.push_back(law.law);
        return named_->solve(problem_, r);
    }

  private:
    talus::GaussSeidel<Dim, Law> default_;
    std::optional<talus::AnySolver<Dim, talus::Coulomb<Dim>>> named_;
    talus::ContactProblem<Dim, talus::Coulomb<Dim>> problem_;  ///< what the named one is given
};

}  // namespace pile
