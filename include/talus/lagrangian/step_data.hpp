// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/mass_factor.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/solver/report.hpp>

#include <cstddef>
#include <vector>

namespace talus {

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
    MassFactor<Types::dof> factor;  ///< of `mass`
    Coordinates force = none();     ///< F at the velocity that it was taken at

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
    /// Of the contact at a place in `contacts`; zero if it was open [N s].
    Vector<rows> impulse_at(std::size_t place) const {
        for (std::size_t c = 0; c < closed.size(); ++c)
            if (closed[c] == place) return impulse[c];
        return Vector<rows>::Zero();
    }
    /// The energy that contacts gave in the step, the sum of r . (U_begin + U_end) / 2 [J]: exact,
    /// with A frozen at the midpoint.
    double contact_work() const {
        double work = 0.0;
        for (std::size_t c = 0; c < closed.size(); ++c)
            work += 0.5 * impulse[c].dot(begin_velocity(c) + end_velocity(c));
        return work;
    }

  private:
    /// Before the first step.
    static constexpr Eigen::Index unused = Types::dof == Eigen::Dynamic ? 0 : Types::dof;
    static Coordinates none() { return Coordinates::Zero(unused); }
};

}  // namespace talus
