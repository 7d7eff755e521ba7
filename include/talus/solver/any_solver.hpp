// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/body_map.hpp>
#include <talus/solver/concepts.hpp>

#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace talus {

/// A solver that takes problems in every form: of bodies, as the blocks of W, and as mass and
/// contact map; and that keeps its report, to which it returns a reference.
template <class S, int Dim, class Law>
concept FormsSolver = ContactSolver<S, Dim, Law> && std::copyable<S> &&
    requires(S& solver, const S& solved, const ContactProblem<Dim, Law>& problem,
             DelassusSparse<Dim>& blocks, DelassusGlobal<Dim>& matrices,
             std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
             std::span<Vector<Dim>> r) {
    { solver.solve(problem, r) } -> std::same_as<const SolveReport&>;
    { solver.solve(blocks, free_velocity, laws, r) } -> std::same_as<const SolveReport&>;
    { solver.solve(matrices, free_velocity, laws, r) } -> std::same_as<const SolveReport&>;
    { solved.report() } -> std::same_as<const SolveReport&>;
};

/// Any solver, chosen at run time: the Solver of a Simulation, say. Behaves as the solver it was
/// made of, at the cost of a virtual call per solve. Copies are independent of each other.
template <int Dim, LawWithoutRolling<Dim> Law>
class AnySolver {
  public:
    // Asked in this order: the second question, of an AnySolver, would come back to the first.
    template <class Solver>
    requires(!std::same_as<Solver, AnySolver>) &&
        FormsSolver<Solver, Dim, Law> explicit AnySolver(Solver solver)
        : self_(std::make_unique<Model<Solver>>(std::move(solver))) {}
    AnySolver(const AnySolver& other) : self_(other.self_->copy()) {}
    AnySolver(AnySolver&&) noexcept = default;  ///< what was moved from may only be assigned to
    AnySolver& operator=(const AnySolver& other) {
        self_ = other.self_->copy();
        return *this;
    }
    AnySolver& operator=(AnySolver&&) noexcept = default;
    ~AnySolver() = default;

    /// Solves from the warm start `r`, into `r`. Throws what the solver throws: input_error on
    /// arrays of different lengths, and where a contact's law is not one of those it solves.
    const SolveReport& solve(const ContactProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return self_->solve(problem, r);
    }
    const SolveReport& solve(AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r) {
        return self_->solve(w, free_velocity, laws, r);
    }
    const SolveReport& solve(DelassusGlobal<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r) {
        return self_->solve(w, free_velocity, laws, r);
    }

    const SolveReport& report() const { return self_->report(); }  ///< of the last solve

  private:
    // The interface and its model, out of a user's sight.
    struct Concept {
        virtual ~Concept() = default;
        virtual std::unique_ptr<Concept> copy() const = 0;
        virtual const SolveReport& solve(const ContactProblem<Dim, Law>&,
                                         std::span<Vector<Dim>>) = 0;
        virtual const SolveReport& solve(DelassusSparse<Dim>&, std::span<const Vector<Dim>>,
                                         std::span<const Law>, std::span<Vector<Dim>>) = 0;
        virtual const SolveReport& solve(DelassusGlobal<Dim>&, std::span<const Vector<Dim>>,
                                         std::span<const Law>, std::span<Vector<Dim>>) = 0;
        virtual const SolveReport& report() const = 0;
    };
    template <class Solver>
    struct Model final : Concept {
        explicit Model(Solver s) : solver(std::move(s)) {}
        std::unique_ptr<Concept> copy() const override { return std::make_unique<Model>(solver); }
        const SolveReport& solve(const ContactProblem<Dim, Law>& problem,
                                 std::span<Vector<Dim>> r) override {
            return solver.solve(problem, r);
        }
        const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                                 std::span<const Law> laws, std::span<Vector<Dim>> r) override {
            return solver.solve(w, free_velocity, laws, r);
        }
        const SolveReport& solve(DelassusGlobal<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                                 std::span<const Law> laws, std::span<Vector<Dim>> r) override {
            return solver.solve(w, free_velocity, laws, r);
        }
        const SolveReport& report() const override { return solver.report(); }
        Solver solver;
    };
    // Null after a move.
    std::unique_ptr<Concept> self_;
};

/// What every solver can be asked.
struct SolverSettings {
    double tolerance = 1e-8;  ///< on the residual of problem/residual.hpp [-]
    /// Sweeps, factorisations...: what the solver counts [-]; unset, its own limit. Of a solver
    /// that counts both, Automatic, each of them is limited.
    std::optional<int> max_iterations = std::nullopt;
};

/// A solver as the registry knows it.
struct SolverName {
    std::string_view name;
    std::string_view description;  ///< one line: what it is, and where it wins
};

/// The solvers of the library by name, for a law; defined in solver/solver_registry.hpp. To have
/// them compiled once (a minute or two per dimension), files include this header and say
///
///     extern template struct talus::SolverRegistry<3, Law>;
///
/// and one file includes solver_registry.hpp and says the same without `extern`.
template <int Dim, LawWithoutRolling<Dim> Law>
struct SolverRegistry {
    /// Those that take the law: the ones that treat all contacts at once need a ConeLaw.
    static std::span<const SolverName> names();
    /// Throws input_error that lists the names there are, or on settings out of range.
    static AnySolver<Dim, Law> make(std::string_view name, SolverSettings settings);
};

/// The solvers that take a law, in the order in which to try them.
template <int Dim, LawWithoutRolling<Dim> Law>
std::span<const SolverName> solver_names() {
    return SolverRegistry<Dim, Law>::names();
}

/// The solver of that name. Throws input_error that lists those there are.
template <int Dim, LawWithoutRolling<Dim> Law>
AnySolver<Dim, Law> make_solver(std::string_view name, SolverSettings settings = {}) {
    return SolverRegistry<Dim, Law>::make(name, settings);
}

}  // namespace talus

// The library itself makes them where they are defined, in solver_registry.hpp: not before.
#ifdef TALUS_COMPILED
TALUS_IN_PLANE(struct talus::SolverRegistry<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(struct talus::SolverRegistry<3, talus::Coulomb<3>>)
#endif
