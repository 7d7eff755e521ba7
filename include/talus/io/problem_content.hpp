// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/matrix_problem.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// What a problem file says of itself, in words.
struct ProblemInfo {
    std::string title;
    std::string description;
    std::string math_info;  ///< known properties: existence, uniqueness...
};

/// A solution of a contact problem, or a guess at one.
template <int Dim>
struct ProblemSolution {
    Eigen::VectorXd velocity;                    ///< v of a global problem; empty for a local one
    std::vector<Vector<Dim>> relative_velocity;  ///< u [m/s]
    std::vector<Vector<Dim>> impulse;            ///< r [N s]
};

/// Everything that a problem file may hold: a problem in one form or in both, words, a solution and
/// guesses.
template <int Dim>
struct ProblemContent {
    std::optional<AssembledProblem<Dim, Coulomb<Dim>>> local;
    std::optional<GlobalProblem<Dim, Coulomb<Dim>>> global;
    ProblemInfo info;
    std::optional<ProblemSolution<Dim>> solution;
    std::vector<ProblemSolution<Dim>> guesses;
};

/// The problem of a file in the form that solvers take. Throws input_error as `assembled` does, and
/// if there is none.
template <int Dim>
AssembledProblem<Dim, Coulomb<Dim>> assembled(const ProblemContent<Dim>& content) {
    if (content.local) return *content.local;
    if (content.global) return assembled(*content.global);
    throw input_error("number of problems is 0, but must be at least 1");
}

/// The velocities that belong to impulses r: u = W r + free_velocity. Throws input_error unless
/// there is one impulse per contact.
template <int Dim, class Law>
ProblemSolution<Dim> solution_of(const AssembledProblem<Dim, Law>& p,
                                 std::span<const Vector<Dim>> r) {
    require_count("impulses", r.size(), "contacts", p.contact_count());
    ProblemSolution<Dim> s{{}, p.free_velocity, {r.begin(), r.end()}};
    p.delassus.multiply(r, s.relative_velocity);
    for (std::size_t i = 0; i < r.size(); ++i) s.relative_velocity[i] += p.free_velocity[i];
    return s;
}

/// The same for a global problem: v = M^-1 (H r + f), u = H^T v + velocity_offset. Throws
/// input_error also if M cannot be factorised.
template <int Dim, class Law>
ProblemSolution<Dim> solution_of(const GlobalProblem<Dim, Law>& p, std::span<const Vector<Dim>> r) {
    require_count("impulses", r.size(), "contacts", p.contact_count());
    const auto size = static_cast<Eigen::Index>(Dim * r.size());
    ProblemSolution<Dim> s{p.force, p.velocity_offset, {r.begin(), r.end()}};
    if (p.mass.rows() == 0) return s;
    Eigen::VectorXd impulses(size);
    for (std::size_t i = 0; i < r.size(); ++i)
        impulses.template segment<Dim>(static_cast<Eigen::Index>(Dim * i)) = r[i];
    s.velocity = detail::solved_mass(p.mass, p.contact_map * impulses + p.force);
    const Eigen::VectorXd u = p.contact_map.transpose() * s.velocity;
    for (std::size_t i = 0; i < r.size(); ++i)
        s.relative_velocity[i] += u.template segment<Dim>(static_cast<Eigen::Index>(Dim * i));
    return s;
}

}  // namespace talus
