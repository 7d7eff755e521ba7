// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/lagrangian/evaluation.hpp>
#include <talus/lagrangian/jacobian_check.hpp>
#include <talus/lagrangian/state.hpp>
#include <talus/lagrangian/step_data.hpp>
#include <talus/lagrangian/step_params.hpp>
#include <talus/lagrangian/velocity_forces.hpp>
#include <talus/law/concepts.hpp>
#include <talus/stepping/step_hooks.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// One step of [Moreau] section 2.3, equation (9), for a Lagrangian system, stage by stage; owns
/// what the stages share, and the impulses remembered for the next step.
///
///   q_mid  = q_begin + (h/2) u_begin             A, G, W, F, gaps taken at (t_mid, q_mid)
///   closed = { contacts with gap(t_mid, q_mid) <= contact_tolerance }
///   u_free = u_begin + h A^-1 F(t_mid, q_mid, u_begin)
///   law( mean of U_begin and U_end , r )  for every closed contact,  u_end = u_free + A^-1 G^T r
///   q_end  = q_mid + (h/2) u_end
template <LagrangianSystem System, class Hooks = NoHooks>
class LagrangianMidpoint {
  public:
    using Types = LagrangianTypes<System>;
    using Law = typename Types::Law;
    static constexpr int rows = Types::rows;
    using Coordinates = typename Types::Coordinates;
    using Data = LagrangianStepData<System>;

    /// Fills `data`, of which q_begin, begin and t_begin are given. Throws input_error on what the
    /// system gives that is not as it must be (matrices, forces, gaps, laws of closed contacts),
    /// and lets pass what the system, a hook or the solver throws; what is remembered is then as it
    /// was.
    template <AssembledSolver<rows, Law> Solver>
    void step(System& system, const LagrangianParams& params, Solver& solver, Data& data) {
        data.h = params.h;
        data.t_mid = data.t_begin + 0.5 * data.h;
        data.q_mid = data.q_begin + 0.5 * data.h * data.begin;
        hooks_.at_midpoint(system, data);
        evaluate(system, params, data);
        hooks_.matrices_known(system, data);
        data.factor.factor(data.mass, data.t_mid);
        free_velocity_.compute(evaluation_, system, params.velocity_forces, data);
        hooks_.forces_known(system, data);
        require_finite_velocity("free velocity", data.free, data.t_mid);
        pose_problem(data);
        hooks_.problem_known(system, data);
        const SolveReport& report =
            solver.solve(data.problem, std::span<Vector<rows>>(data.impulse));
        // As much room as the solver has: no history needs more.
        data.report.history.reserve(report.history.capacity());
        data.report = report;
        hooks_.solved(system, data);
        apply_impulses(data);
        hooks_.velocities_known(system, data);
        require_finite_velocity("velocity", data.end, data.t_end());
        data.q_end = data.q_mid + 0.5 * data.h * data.end;
        hooks_.finished(system, data);
        remember(data);
        free_velocity_.remember(data);
    }

    /// Called between the stages (stepping/step_hooks.hpp): with the system and this data. In
    /// `matrices_known` the mass matrix and the contacts may be changed, in `forces_known`
    /// data.free, in `finished` data.q_end.
    Hooks& hooks() { return hooks_; }

    /// Makes the next step start without impulses of the last.
    void forget() {
        memory_.clear();
        free_velocity_.forget();
    }
    /// What it remembers: into a state, and, of one of the right rows, back.
    void write_to(LagrangianState& state) const {
        state.rows = rows;
        for (const Vector<rows>& r : memory_)
            state.impulse.insert(state.impulse.end(), r.data(), r.data() + rows);
        state.largest_velocity = free_velocity_.largest();
    }
    void restore(const LagrangianState& state) {
        memory_.resize(state.impulse.size() / static_cast<std::size_t>(rows));
        for (std::size_t k = 0; k < state.impulse.size(); ++k)
            memory_[k / rows][static_cast<int>(k % rows)] = state.impulse[k];
        free_velocity_.forget(state.largest_velocity);
    }
    /// Throws input_error unless the system's functions give what they must at (t, q), and, if
    /// asked, unless its Jacobians are those of its gaps.
    void require_valid(const System& system, const LagrangianParams& params, double t,
                       const Coordinates& q, const Coordinates& u) {
        Data data;
        evaluation_.mass(system, t, q, data.mass);
        data.factor.factor(data.mass, t);
        evaluation_.force(system, t, q, u, data.force);
        evaluation_.contacts(system, t, q, data.contacts);
        evaluation_.require_laws(data.contacts, t);
        if (params.check_jacobians != CheckJacobians::never)
            check_.require(system, t, q, params.coordinate_scale);
    }

  private:
    void evaluate(const System& system, const LagrangianParams& params, Data& data) {
        evaluation_.mass(system, data.t_mid, data.q_mid, data.mass);
        evaluation_.contacts(system, data.t_mid, data.q_mid, data.contacts);
        if (params.check_jacobians == CheckJacobians::each_step)
            check_.require(system, data.t_mid, data.q_mid, params.coordinate_scale);
        data.closed.clear();
        for (std::size_t k = 0; k < data.contacts.size(); ++k)
            if (data.contacts[k].gap <= params.contact_tolerance) data.closed.push_back(k);
    }

    void pose_problem(Data& data) {
        const std::size_t n = data.contact_count();
        if (mobility_.size() < n) mobility_.resize(n);
        data.problem.laws.clear();
        data.problem.free_velocity.clear();
        data.impulse.clear();
        for (std::size_t c = 0; c < n; ++c) {
            const std::size_t place = data.closed[c];
            const auto& contact = data.contacts[place];
            evaluation_.require_law(contact, place, data.t_mid);
            mobility_[c] = contact.rows.transpose();
            data.factor.forward(mobility_[c]);
            Vector<rows> u = contact.relative_velocity(data.free);
            if constexpr (RestitutionLaw<Law, rows>)
                u += contact.law.restitution_shift(contact.relative_velocity(data.begin));
            data.problem.free_velocity.push_back(u);
            data.problem.laws.push_back(contact.law);
            data.impulse.push_back(place < memory_.size() ? memory_[place] : Vector<rows>::Zero());
        }
        data.problem.delassus.fill(n, [&](std::size_t i, std::size_t j) {
            Matrix<rows> w;
            w.noalias() = mobility_[i].transpose().lazyProduct(mobility_[j]);
            return w;
        });
    }

    void apply_impulses(Data& data) {
        change_.setZero(data.free.size());
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            for (int i = 0; i < rows; ++i) change_ += data.impulse[c][i] * mobility_[c].col(i);
        data.factor.backward(change_);
        data.end = data.free + change_;
    }

    /// For the warm start, by place in the list. What does not solve its problem and is out of all
    /// proportion to it is no start (MoreauMidpoint::complete).
    void remember(const Data& data) {
        constexpr double out_of_proportion = 1e-7;
        memory_.reserve(data.contacts.size());  // the one thing here that may throw
        memory_.assign(data.contacts.size(), Vector<rows>::Zero());
        if (data.report.status != SolveStatus::converged &&
            !(data.report.rounding <= out_of_proportion))
            return;
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            memory_[data.closed[c]] = data.impulse[c];
    }

    static void require_finite_velocity(std::string_view item, const Coordinates& u, double t) {
        if (!u.allFinite()) require_finite(detail::at_time(item, t), u);
    }

    SystemEvaluation<System> evaluation_;
    JacobianCheck<System> check_;
    FreeVelocity<System> free_velocity_;
    std::vector<Eigen::Matrix<double, Types::dof, rows>> mobility_;  ///< L^-1 G^T by contact
    Coordinates change_;
    Column<Vector<rows>> memory_;  ///< impulses of the last step, by place
    [[no_unique_address]] Hooks hooks_;
};

}  // namespace talus
