// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/matrix_problem.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/inexact_interior_point.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/projected_gradient.hpp>
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <array>
#include <span>
#include <string>
#include <string_view>

/// What every solver is asked.
struct SolverSettings {
    double tolerance = 1e-8;  ///< on the residual of problem/residual.hpp [-]
    int iterations = 10000;   ///< sweeps, factorisations...: what the solver counts
};

template <int Dim>
using FrictionProblem = talus::AssembledProblem<Dim, talus::Coulomb<Dim>>;

/// A solver that can be named on the command line.
template <int Dim>
struct SolverChoice {
    std::string_view name;
    /// Solves from r, into r. The problem's Delassus operator is left in use by the solver.
    talus::SolveReport (*solve)(FrictionProblem<Dim>&, std::span<talus::Vector<Dim>> r,
                                const SolverSettings&);
};

template <class Solver, int Dim>
talus::SolveReport solve_with(FrictionProblem<Dim>& p, std::span<talus::Vector<Dim>> r,
                              const SolverSettings& settings) {
    Solver solver;
    solver.params.tolerance = settings.tolerance;
    if constexpr (requires { solver.params.max_sweeps; })
        solver.params.max_sweeps = settings.iterations;
    else
        solver.params.max_iterations = settings.iterations;
    return solver.solve(p.delassus, p.free_velocity, p.laws, r);
}

/// The table of solvers: one line each.
template <int Dim>
inline constexpr std::array solver_choices{
    SolverChoice<Dim>{"automatic", &solve_with<talus::Automatic<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"gauss_seidel", &solve_with<talus::GaussSeidel<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"accelerated_gauss_seidel",
                      &solve_with<talus::AcceleratedGaussSeidel<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"projected_gradient",
                      &solve_with<talus::ProjectedGradient<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"interior_point",
                      &solve_with<talus::InteriorPoint<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"inexact_interior_point",
                      &solve_with<talus::InexactInteriorPoint<Dim, talus::Coulomb<Dim>>>},
    SolverChoice<Dim>{"proximal_newton",
                      &solve_with<talus::ProximalNewton<Dim, talus::Coulomb<Dim>>>},
};

inline std::string solver_names() {
    std::string names;
    for (const auto& choice : solver_choices<3>)
        names += (names.empty() ? "" : ", ") + std::string(choice.name);
    return names;
}

/// The solver of that name; throws input_error that lists those there are.
template <int Dim>
const SolverChoice<Dim>& solver_named(std::string_view name) {
    for (const auto& choice : solver_choices<Dim>)
        if (choice.name == name) return choice;
    throw talus::input_error("--solver is '" + std::string(name) + "', but must be one of " +
                             solver_names());
}
