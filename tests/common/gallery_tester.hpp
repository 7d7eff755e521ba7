// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/body_map.hpp>
#include <talus/solver/report.hpp>

#include <functional>
#include <span>
#include <vector>

#include "common/effort.hpp"
#include "common/solver_gallery.hpp"

/// To which residual a solver promises to come; 0 where it promises nothing but a true report.
struct SolverPromises {
    double well_posed = 0.0;
    double hyperstatic = 0.0;
    double stiff = 0.0;
    double rough = 0.0;
    double solvable = 0.0;
    bool knows_infeasible = false;  ///< says no_solution, always

    static SolverPromises robust() { return {1e-10, 1e-8, 1e-8, 1e-10, 1e-8, true}; }
    double of(Kind kind) const {
        switch (kind) {
            case Kind::well_posed:
                return well_posed;
            case Kind::hyperstatic:
                return hyperstatic;
            case Kind::stiff:
                return stiff;
            case Kind::rough:
                return rough;
            case Kind::solvable:
                return solvable;
            default:
                return 0.0;
        }
    }
};

/// A solver whose type does not matter any more.
template <int Dim>
struct SolverUnderTest {
    using Law = talus::Coulomb<Dim>;
    using Problem = talus::ContactProblem<Dim, Law>;
    using Impulses = std::vector<talus::Vector<Dim>>;
    using Solve = std::function<talus::SolveReport(const Problem&, Impulses&)>;

    std::function<Solve(double tolerance)> make;  ///< a new object, to be used again and again
    SolverPromises promises;
    int max_iterations;  ///< what the report may not go beyond
};

/// Problems of bodies as such: `make(tolerance)` returns a solver.
template <int Dim, class Make>
SolverUnderTest<Dim> of_bodies(Make make, SolverPromises promises, int max_iterations) {
    return {[make](double tolerance) -> typename SolverUnderTest<Dim>::Solve {
                return [solver = make(tolerance)](const auto& p, auto& r) mutable {
                    return solver.solve(p, std::span(r));
                };
            },
            promises, max_iterations};
}
/// The same problems given by the blocks of W.
template <int Dim, class Make>
SolverUnderTest<Dim> of_blocks(Make make, SolverPromises promises, int max_iterations) {
    return {[make](double tolerance) -> typename SolverUnderTest<Dim>::Solve {
                return [solver = make(tolerance)](const auto& p, auto& r) mutable {
                    talus::DelassusSparse<Dim> w(p.jacobian, p.inverse_mass);
                    return solver.solve(w, p.free_velocity, p.laws, std::span(r));
                };
            },
            promises, max_iterations};
}
/// Mass and contact map of a problem, with masses that are not 1 to go through.
template <int Dim>
talus::DelassusGlobal<Dim> with_masses(const talus::ContactJacobian<Dim>& jacobian,
                                       const talus::InverseMass<Dim>& inverse_mass);
/// The same problems given by mass and contact map.
template <int Dim, class Make>
SolverUnderTest<Dim> of_matrices(Make make, SolverPromises promises, int max_iterations) {
    return {[make](double tolerance) -> typename SolverUnderTest<Dim>::Solve {
                return [solver = make(tolerance)](const auto& p, auto& r) mutable {
                    talus::DelassusGlobal<Dim> w = with_masses<Dim>(p.jacobian, p.inverse_mass);
                    return solver.solve(w, p.free_velocity, p.laws, std::span(r));
                };
            },
            promises, max_iterations};
}

// For Dim 2 and 3, compiled once.

/// Checks what every solver owes to every problem.
template <int Dim>
void test_on_problems(const SolverUnderTest<Dim>& solver,
                      const std::vector<GalleryProblem<Dim>>& problems);
template <int Dim>
void test_on_gallery(const SolverUnderTest<Dim>& solver, unsigned seed = 200,
                     int rounds = repetitions(3, 1)) {
    test_on_problems(solver, gallery_problems<Dim>(seed, rounds));
}
/// All forms of a problem lead to the same velocities, where these are unique.
template <int Dim>
void test_forms_agree(const std::vector<SolverUnderTest<Dim>>& solvers, double tolerance,
                      double agreement, unsigned seed = 210);
