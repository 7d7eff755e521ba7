// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/solver/any_solver.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench_problem.hpp"
#include "limited_run.hpp"

namespace bench {

/// What a solver says of its run, in plain bytes.
struct Outcome {
    double seconds = 0.0;         ///< CPU time of the solve alone [s]
    int iterations = 0;           ///< as the solver counts them
    bool converged = false;       ///< by its own verdict
    std::array<char, 24> word{};  ///< its own word for how it ended

    void set_word(std::string_view text) {
        word.fill('\0');
        text.copy(word.data(), word.size() - 1);
    }
};

/// Solves from the impulses in r, into r. Starts the clock after, and stops it before, all that a
/// simulation would not do for every solve.
template <int Dim>
using SolveFunction = std::function<Outcome(const BenchProblem<Dim>& problem, double tolerance,
                                            LimitedClock& clock, std::span<talus::Vector<Dim>> r)>;

/// A solver by name; a function that is empty says that it does not solve problems of that
/// dimension.
struct RegisteredSolver {
    std::string name;
    SolveFunction<2> plane;
    SolveFunction<3> space;
    /// A solve that is stopped leaves its impulses so far in r.
    bool in_place = true;
    bool assembles = false;  ///< it uses BenchProblem::assembled also where bodies are known
    std::size_t most_contacts = std::numeric_limits<std::size_t>::max();  ///< fits into memory

    /// Whether it solves problems of a dimension, where that is known.
    bool applies(int dimension) const {
        return (dimension != 2 || plane) && (dimension != 3 || space);
    }
    template <int Dim>
    const SolveFunction<Dim>& function() const {
        if constexpr (Dim == 2)
            return plane;
        else
            return space;
    }
};

/// No limit of iterations: LimitedClock sees to the end.
inline constexpr int unlimited = std::numeric_limits<int>::max() - 1;

/// A talus solver, which `make(tolerance)` returns.
template <int Dim>
using SolverMaker = std::function<talus::AnySolver<Dim, Law<Dim>>(double tolerance)>;
template <int Dim>
SolveFunction<Dim> solve_with(SolverMaker<Dim> make) {
    return [make = std::move(make)](const BenchProblem<Dim>& problem, double tolerance,
                                    LimitedClock& clock, std::span<talus::Vector<Dim>> r) {
        auto solver = make(tolerance);
        talus::SolveReport report;
        Outcome outcome;
        if (problem.bodies() != nullptr) {
            clock.start();
            const talus::SolveReport& result = solver.solve(*problem.bodies(), r);
            outcome.seconds = clock.stop();
            report = result;
        } else if (problem.global() != nullptr) {
            auto w = *problem.global();
            clock.start();
            const talus::SolveReport& result =
                solver.solve(w, problem.free_velocity(), problem.laws(), r);
            outcome.seconds = clock.stop();
            report = result;
        } else {
            auto w = problem.assembled().delassus;
            clock.start();
            const talus::SolveReport& result =
                solver.solve(w, problem.free_velocity(), problem.laws(), r);
            outcome.seconds = clock.stop();
            report = result;
        }
        outcome.iterations = report.iterations;
        outcome.converged = report.status == talus::SolveStatus::converged;
        outcome.set_word(to_string(report.status));
        return outcome;
    };
}

/// The solvers of talus. A new one is one entry in solver_registry.cpp.
std::vector<RegisteredSolver> own_solvers();

/// In which units peers whose steps and stopping tests depend on them are given a problem.
enum class PeerUnits {
    given,   ///< those of the problem
    scaled,  ///< effective masses of mean 1 and free velocities of root mean square 1
};

/// Solvers of other libraries that this build found; empty if none.
std::vector<RegisteredSolver> peer_solvers(PeerUnits units);

}  // namespace bench
