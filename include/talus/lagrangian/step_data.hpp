// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/mass_factor.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/solver/report.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace talus {

/// How the search for the free velocity ended.
enum class FreeVelocityStatus {
    converged,        ///< to rounding; or there was nothing to search for
    iteration_limit,  ///< F(u) jumps or bends within the step: take a smaller h, make F smooth, or
                      ///< give what jumps (dry friction) as a contact
    diverged,         ///< A^-1 F(u) grows too fast with u: take a smaller h
};

/// What is known of the free velocity of a step (VelocityForces).
struct FreeVelocityReport {
    FreeVelocityStatus status = FreeVelocityStatus::converged;
    int iterations = 0;  ///< of Newton's method: calls of `force`, but those for derivatives
    /// The last change, by sqrt(u^T A u), of the largest velocity of the run [-]. Of a velocity
    /// that was not found: the least change there was; the velocity is the one after it.
    double error = 0.0;
};

/// Everything that one step of a Lagrangian system computed.
template <LagrangianSystem System>
struct LagrangianStepData {
    using Types = LagrangianTypes<System>;
    static constexpr int rows = Types::rows;
    using Coordinates = typename Types::Coordinates;

    double t_begin = 0.0;  ///< [s]
    double t_mid = 0.0;    ///< of A, F, gaps, G and W [s]
    double h = 0.0;        ///< [s]
    double t_end() const { return t_begin + h; }

    Coordinates q_begin = none(), q_mid = none(), q_end = none();
    Coordinates begin = none();  ///< u at the beginning
    Coordinates free = none();   ///< u at the end, had there been no contact impulses
    Coordinates end = none();    ///< u at the end
    typename Types::MassMatrix mass = Types::MassMatrix::Zero(unused, unused);
    MassFactor<Types::dof> factor;   ///< of `mass`
    Coordinates force = none();      ///< F at the velocity that it was taken at
    FreeVelocityReport free_report;  ///< whether `free` is what it should be

    typename Types::Contacts contacts;  ///< all of them, at the midpoint
    Column<std::size_t> closed;         ///< places in `contacts` of those that are effective
    /// Of these, as the solver was given it; free velocities with the shifts of restitution.
    AssembledProblem<rows, typename Types::Law> problem;
    std::vector<Vector<rows>> impulse;  ///< of these, normal first [N s]
    SolveReport report;

    std::size_t contact_count() const { return closed.size(); }
    /// Of closed contact c.
    Vector<rows> begin_velocity(std::size_t c) const {
        return contacts[closed[c]].relative_velocity(begin);
    }
    Vector<rows> end_velocity(std::size_t c) const {
        return contacts[closed[c]].relative_velocity(end);
    }
    /// The mean of the two.
    Vector<rows> mean_velocity(std::size_t c) const {
        return 0.5 * (begin_velocity(c) + end_velocity(c));
    }
    /// Of the contact at a place in `contacts`; zero if it was open [N s].
    Vector<rows> impulse_at(std::size_t place) const {
        for (std::size_t c = 0; c < closed.size(); ++c)
            if (closed[c] == place) return impulse[c];
        return Vector<rows>::Zero();
    }
    /// Energy that the system gained by its contacts in the step [J]: the sum of r . (U - W) with
    /// U = (U_begin + U_end) / 2. Exact, with A frozen at the midpoint. What moves as told gives
    /// contact_work() + contact_loss(), the sum of -r . W.
    double contact_work() const {
        double work = 0.0;
        for (std::size_t c = 0; c < closed.size(); ++c)
            work += impulse[c].dot(mean_velocity(c) - contacts[closed[c]].prescribed);
        return work;
    }
    /// Energy that was lost within the contacts in the step, by friction and impacts [J]: the sum
    /// of -r . U. (Below zero where the law makes energy, as unequal restitutions may.)
    double contact_loss() const {
        double loss = 0.0;
        for (std::size_t c = 0; c < closed.size(); ++c) loss -= impulse[c].dot(mean_velocity(c));
        return loss;
    }

  private:
    /// Before the first step.
    static constexpr Eigen::Index unused = Types::dof == Eigen::Dynamic ? 0 : Types::dof;
    static Coordinates none() { return Coordinates::Zero(unused); }
};

}  // namespace talus
