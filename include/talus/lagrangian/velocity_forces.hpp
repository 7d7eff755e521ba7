// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/evaluation.hpp>
#include <talus/lagrangian/small_lu.hpp>
#include <talus/lagrangian/step_data.hpp>
#include <talus/lagrangian/step_params.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

/// u_free = u_begin + h A^-1 F, with F at the velocity that is asked for. Keeps its memory, and
/// the largest velocity of the run: what rounding leaves of it is no velocity.
template <LagrangianSystem System>
class FreeVelocity {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;
    using Data = LagrangianStepData<System>;

    /// Fills `data.force`, `data.free` and `data.free_report` from what is before them in `data`.
    /// Where the velocity of implicit_midpoint is not found (h times the derivative of A^-1 F by u
    /// is large and changes much within the step) the report says so, and the velocity is the best
    /// that was met. Throws input_error on forces that are not finite.
    void compute(const SystemEvaluation<System>& evaluation, const System& system,
                 VelocityForces kind, Data& data) {
        evaluation.force(system, data.t_mid, data.q_mid, data.begin, data.force);
        change_ = data.h * data.force;
        data.factor.solve(change_);
        data.free = data.begin + change_;
        data.free_report = {};
        if (kind == VelocityForces::explicit_begin) return;
        measure(data);
        const bool depends = differentiate(evaluation, system, data, data.begin);
        if (!depends) {  // at u = 0 what is quadratic in u has no slope: at u_free it shows
            evaluation.force(system, data.t_mid, data.q_mid, data.free, force_);
            if (force_ == data.force) return;
        }
        iterate(evaluation, system, data);
    }

    /// The largest velocity of the run so far, sqrt(u^T A u) [sqrt(J)]: of free velocities that
    /// were found by implicit_midpoint, and of those that their steps began with.
    double largest() const { return largest_; }
    /// Notes that of a step that has come to its end.
    void remember(const Data& data) {
        if (data.free_report.iterations == 0 ||
            data.free_report.status != FreeVelocityStatus::converged)
            return;
        largest_ = std::max({largest_, data.factor.norm(data.begin), data.factor.norm(data.free)});
    }
    /// Begins a run, or goes on with one whose largest velocity is known.
    void forget(double largest = 0.0) { largest_ = largest; }

  private:
    /// The sizes of this step by which differences and rounding are judged, none of which vanishes
    /// as the system comes to rest.
    void measure(const Data& data) {
        scale_ = std::max(largest_, data.factor.norm(data.begin));
        reach_ = std::max(scale_, data.factor.norm(data.free));
        // Velocities that change no digit of q in a step. What q leaves in F by rounding is not
        // larger, where the step is short enough for the stiffness of F.
        resolution_ = data.factor.norm(data.q_mid) / data.h;
    }
    /// A - (h/2) dF/du at a velocity, by differences; F there is `data.force`. Whether F depends
    /// on u.
    bool differentiate(const SystemEvaluation<System>& evaluation, const System& system,
                       const Data& data, const Coordinates& at) {
        constexpr double relative = 1e-6, of_scale = 1e-9, of_resolution = 1e-11, least = 1e-150;
        const Eigen::Index n = data.begin.size();
        matrix_ = data.mass;
        bool depends = false;
        for (Eigen::Index j = 0; j < n; ++j) {
            // Energies as velocities of this coordinate.
            const double unit = 1.0 / std::sqrt(data.mass(j, j));
            const double free = std::abs(data.free[j]);
            const double size =
                std::max(std::abs(at[j]), scale_ > 0.0 ? std::min(free, scale_ * unit) : free);
            double delta = std::max(
                {relative * size, of_scale * scale_ * unit, of_resolution * resolution_ * unit});
            if (!(delta > least)) delta = relative;
            moved_ = at;
            moved_[j] += delta;
            evaluation.force(system, data.t_mid, data.q_mid, moved_, force_);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double slope = (force_[i] - data.force[i]) / delta;
                depends = depends || slope != 0.0;
                matrix_(i, j) -= 0.5 * data.h * slope;
            }
        }
        return depends;
    }
    /// Newton's method with that matrix, to rounding; the matrix is made again where it is too far
    /// from what it should be. F at u_begin is `data.force`.
    void iterate(const SystemEvaluation<System>& evaluation, const System& system, Data& data) {
        constexpr int most = 100, most_matrices = 10;
        constexpr double done = 1e-15, run_away = 1e6;
        FreeVelocityReport& report = data.free_report;
        report.status = FreeVelocityStatus::iteration_limit;
        lu_.factor(matrix_);
        residual_ = data.h * data.force;
        best_ = data.free;  // the paper's
        data.free = data.begin;
        double last = 0.0, least = std::numeric_limits<double>::infinity(), size = reach_;
        for (int matrices = 1; report.iterations < most;) {
            change_ = residual_;
            lu_.solve(change_);
            const double change = data.factor.norm(change_);
            ++report.iterations;
            if (!(change <= run_away * reach_)) {
                report.status = FreeVelocityStatus::diverged;
                break;
            }
            data.free += change_;
            size = std::max(scale_, data.factor.norm(data.free));
            if (change < least) {
                least = change;
                best_ = data.free;
            }
            const double own = std::max(data.factor.norm(data.begin), data.factor.norm(data.free));
            const bool stands = report.iterations > 1 && change >= 0.5 * last;
            last = change;
            middle_ = 0.5 * (data.begin + data.free);
            evaluation.force(system, data.t_mid, data.q_mid, middle_, data.force);
            if (change <= done * own || (stands && is_rounding(change, size, matrices))) {
                report.status = FreeVelocityStatus::converged;
                break;
            }
            if (stands && matrices < most_matrices) {
                differentiate(evaluation, system, data, middle_);
                lu_.factor(matrix_);
                ++matrices;
                last = std::numeric_limits<double>::infinity();
            }
            moved_ = data.free - data.begin;
            residual_.noalias() = data.h * data.force;
            residual_.noalias() -= data.mass.lazyProduct(moved_);
        }
        report.error = size > 0.0 ? last / size : 0.0;
        if (report.status == FreeVelocityStatus::converged) return;
        report.error = std::min(least, reach_) / reach_;
        data.free = best_;
        middle_ = 0.5 * (data.begin + data.free);
        evaluation.force(system, data.t_mid, data.q_mid, middle_, data.force);
    }

    /// Whether a change that no longer shrinks is what rounding leaves, beside velocities of that
    /// size. Forces that cancel (springs under tension) leave more than their sum tells: with new
    /// derivatives at the velocity itself it is not they that are wrong.
    bool is_rounding(double change, double size, int matrices) const {
        constexpr double of_resolution = 1e-14, of_scale = 1e-12, of_cancelling = 1e-9;
        const double part = matrices > 2 ? of_cancelling : of_scale;
        return change <= std::max(part * size, of_resolution * resolution_);
    }

    double largest_ = 0.0, scale_ = 0.0, reach_ = 0.0, resolution_ = 0.0;
    Coordinates moved_, middle_, best_, force_, change_, residual_;
    typename Types::MassMatrix matrix_;
    SmallLu<Types::dof> lu_;
};

}  // namespace talus
