// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/event_driven/contact_motion.hpp>
#include <talus/law/concepts.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/solver/report.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// The impact of contacts that touch: a midpoint step in no time, with the same laws, so that
/// friction and restitution mean the same,
///
///   law( mean of U_begin and U_end , r ) ,   u_end = u_begin + A^-1 G^T r .
template <LagrangianSystem System>
class EventImpact {
  public:
    using Types = LagrangianTypes<System>;
    static constexpr int rows = Types::rows;

    /// Impulses of the contacts at `places` of an evaluated motion, which is left posed for them;
    /// `impulse` has them row by row.
    template <AssembledSolver<rows, typename Types::Law> Solver>
    const SolveReport& solve(ContactMotion<System>& motion, std::span<const std::size_t> places,
                             Solver& solver) {
        motion.pose(places);
        problem_.laws.clear();
        problem_.free_velocity.clear();
        impulse_.assign(places.size(), Vector<rows>::Zero());
        for (const std::size_t place : places) {
            const auto& contact = motion.contacts[place];
            Vector<rows> velocity = contact.relative_velocity(motion.u);
            if constexpr (RestitutionLaw<typename Types::Law, rows>)
                velocity += contact.law.restitution_shift(velocity);
            problem_.free_velocity.push_back(velocity);
            problem_.laws.push_back(contact.law);
        }
        problem_.delassus.fill(places.size(), [&](std::size_t i, std::size_t j) {
            Matrix<rows> w;
            for (int a = 0; a < rows; ++a)
                for (int b = 0; b < rows; ++b)
                    w(a, b) =
                        motion.problem.w(motion.problem.row(i) + a, motion.problem.row(j) + b);
            return w;
        });
        const SolveReport& report = solver.solve(problem_, std::span<Vector<rows>>(impulse_));
        impulse.resize(rows * static_cast<Eigen::Index>(places.size()));
        for (std::size_t c = 0; c < places.size(); ++c)
            for (int a = 0; a < rows; ++a) impulse[motion.problem.row(c) + a] = impulse_[c][a];
        return report;
    }

    Eigen::VectorXd impulse;  ///< of the last one [N s]

  private:
    AssembledProblem<rows, typename Types::Law> problem_;
    std::vector<Vector<rows>> impulse_;
};

}  // namespace talus
