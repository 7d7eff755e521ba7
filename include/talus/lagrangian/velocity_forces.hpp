// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/evaluation.hpp>
#include <talus/lagrangian/step_data.hpp>
#include <talus/lagrangian/step_params.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace talus {

/// u_free = u_begin + h A^-1 F, with F at the velocity that is asked for. Keeps its memory.
template <LagrangianSystem System>
class FreeVelocity {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;
    using Data = LagrangianStepData<System>;

    /// Fills `data.force` and `data.free` from what is before them in `data`. Throws input_error on
    /// forces that are not finite, and if no velocity is found (implicit_midpoint, where h times
    /// the derivative of A^-1 F by u is large and changes much within the step).
    void compute(const SystemEvaluation<System>& evaluation, const System& system,
                 VelocityForces kind, Data& data) {
        evaluation.force(system, data.t_mid, data.q_mid, data.begin, data.force);
        change_ = data.h * data.force;
        data.factor.solve(change_);
        data.free = data.begin + change_;
        if (kind == VelocityForces::explicit_begin) return;
        const bool depends = differentiate(evaluation, system, data);
        if (depends) iterate(evaluation, system, data);
    }

  private:
    /// A - (h/2) dF/du at u_begin, by differences. Whether F depends on u.
    bool differentiate(const SystemEvaluation<System>& evaluation, const System& system,
                       const Data& data) {
        constexpr double relative = 1e-6;
        const Eigen::Index n = data.begin.size();
        matrix_ = data.mass;
        bool depends = false;
        for (Eigen::Index j = 0; j < n; ++j) {
            const double size = std::max(std::abs(data.begin[j]), std::abs(data.free[j]));
            const double delta = relative * (size > 0.0 ? size : 1.0);
            moved_ = data.begin;
            moved_[j] += delta;
            evaluation.force(system, data.t_mid, data.q_mid, moved_, force_);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double slope = (force_[i] - data.force[i]) / delta;
                depends = depends || slope != 0.0;
                matrix_(i, j) -= 0.5 * data.h * slope;
            }
        }
        // At u = 0 what is quadratic in u has no slope: at u_free it shows.
        evaluation.force(system, data.t_mid, data.q_mid, data.free, force_);
        return depends || force_ != data.force;
    }
    /// Newton's method with that matrix, to rounding.
    void iterate(const SystemEvaluation<System>& evaluation, const System& system, Data& data) {
        constexpr int most = 60;
        constexpr double done = 1e-15, rounding = 1e-12;
        lu_.compute(matrix_);
        double last = 0.0, share = 0.0;
        for (int k = 0; k < most; ++k) {
            moved_ = 0.5 * (data.begin + data.free);
            evaluation.force(system, data.t_mid, data.q_mid, moved_, data.force);
            change_ = data.free - data.begin;
            residual_.noalias() = data.h * data.force;
            residual_.noalias() -= data.mass.lazyProduct(change_);
            change_ = lu_.solve(residual_);
            data.free += change_;
            share = data.factor.norm(change_) /
                    std::max(data.factor.norm(data.begin), data.factor.norm(data.free));
            if (!(share > done) || (k > 0 && share <= rounding && share >= 0.5 * last)) return;
            last = share;
        }
        detail::reject(
            detail::at_time("change of the free velocity in the last iteration", data.t_mid), share,
            "below 1e-12 of it, as it is with a smaller h");
    }

    Coordinates moved_, force_, change_, residual_;
    typename Types::MassMatrix matrix_;
    Eigen::PartialPivLU<typename Types::MassMatrix> lu_;
};

}  // namespace talus
