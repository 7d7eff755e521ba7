// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/evaluation.hpp>
#include <talus/lagrangian/event_driven/acceleration_problem.hpp>
#include <talus/lagrangian/event_driven/dense_step.hpp>
#include <talus/lagrangian/event_driven/event_params.hpp>
#include <talus/lagrangian/event_driven/smooth_phase.hpp>
#include <talus/lagrangian/mass_factor.hpp>
#include <talus/law/cone_of.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// A system at one instant, its contacts, and how it is accelerated,
///
///   A u' = F + G^T r ,     a = G u' + G' u + W' .
///
/// G' u + W', what relative velocities change by along the motion at constant u, is taken by
/// differences of order 4 along (1, u); it is exactly 0 where G and W are constant. Keeps its
/// memory.
template <LagrangianSystem System>
class ContactMotion {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;
    using State = DenseStep::State;  ///< q, then u
    static constexpr int rows = Types::rows;
    static_assert(
        ConeLaw<typename Types::Law, rows>,
        "EventDriven is for laws of round cones: Coulomb, Signorini and WeightedMean of them");

    ContactMotion(const EventDrivenParams& params, std::size_t contact_count)
        : params_(params), contact_count_(contact_count) {}

    /// Evaluates A, F and all contacts. Throws input_error on what is not as it must be.
    void evaluate(const System& system, double t, const State& x) {
        const auto n = static_cast<Eigen::Index>(x.size() / 2);
        q = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
        u = Eigen::Map<const Eigen::VectorXd>(x.data() + n, n);
        time_ = t;
        evaluation_.mass(system, t, q, mass_);
        factor_.factor(mass_, t);
        evaluation_.force(system, t, q, u, free_);
        factor_.solve(free_);
        evaluation_.contacts(system, t, q, contacts);
        require_contact_count(contacts.size());
    }
    /// G, W = G A^-1 G^T and friction of some contacts, by place, of what was evaluated.
    void pose(std::span<const std::size_t> places) {
        const Eigen::Index n = q.size(), size = rows * static_cast<Eigen::Index>(places.size());
        rows_.resize(size, n);
        problem.rows = rows;
        problem.mu.resize(places.size());
        problem.slip.setZero(rows - 1, static_cast<Eigen::Index>(places.size()));
        for (std::size_t c = 0; c < places.size(); ++c) {
            const auto& contact = contacts[places[c]];
            rows_.middleRows(problem.row(c), rows) = contact.rows;
            problem.mu[c] = friction(places[c]);
            if (problem.mu[c] == 0.0) continue;
            const Eigen::VectorXd slip = slip_velocity(places[c]);
            const double speed = slip.norm();
            if (speed > params_.resting_speed) problem.slip.col(problem.column(c)) = slip / speed;
        }
        mobility_ = rows_.transpose();
        factor_.forward(mobility_);
        problem.w.noalias() = mobility_.transpose() * mobility_;
    }
    /// The same, with b.
    void pose_accelerations(const System& system, std::span<const std::size_t> places) {
        pose(places);
        problem.b.noalias() = rows_ * free_;
        if (!places.empty()) add_bias(system, places);
    }
    /// Evaluates, and solves for the forces of a phase. Of contacts that slide in the plane the
    /// direction is the phase's, in space that of their velocity.
    void solve(const System& system, double t, const State& x, const SmoothPhase& phase) {
        evaluate(system, t, x);
        pose_accelerations(system, phase.closed);
        modes_ = phase.modes;
        if (rows > 2)
            for (std::size_t c = 0; c < phase.closed.size(); ++c)
                if (problem.slides(c))
                    modes_.slip.col(problem.column(c)) = problem.slip.col(problem.column(c));
        forces.solve(problem, modes_);
    }
    /// x' of that motion. Whether it is one: not beyond a phase's end by forces that went to
    /// infinity or by a slip in space that turned round; it is then the free one.
    bool derivative(const System& system, double t, const State& x, const SmoothPhase& phase,
                    State& dx) {
        solve(system, t, x, phase);
        const bool good = within(phase);
        change_ = free_;
        if (good) {
            step_.noalias() = mobility_ * forces.force;
            factor_.backward(step_);
            change_ += step_;
        }
        const std::size_t n = x.size() / 2;
        std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(n), n, dx.begin());
        std::copy_n(change_.data(), n, dx.begin() + static_cast<std::ptrdiff_t>(n));
        return good;
    }
    /// Whether forces are on their side of the border of Painleve's paradox, and slips in space on
    /// theirs.
    bool within(const SmoothPhase& phase) const {
        constexpr double border = 1e-8;
        if (!phase.singular && !(forces.determinant / phase.determinant > border)) return false;
        if (rows > 2)
            for (std::size_t c = 0; c < phase.closed.size(); ++c)
                if (problem.slides(c) && phase.modes.mode[c] == ContactMode::sliding &&
                    problem.slip.col(problem.column(c))
                            .dot(phase.modes.slip.col(problem.column(c))) < 0.0)
                    return false;
        return true;
    }
    /// Puts gaps of closed contacts back to 0, and velocities that their modes hold, along A^-1
    /// G^T: what is nearest in kinetic energy. Notes what there was.
    void project(const System& system, double t, State& x, const SmoothPhase& phase,
                 double& gap_correction, double& velocity_correction) {
        if (phase.closed.empty()) return;
        constexpr int most = 3;
        constexpr double rounding = 1e-14;
        evaluate(system, t, x);
        pose(phase.closed);
        for (int k = 0; k < most; ++k) {
            hold(phase, true);
            const double worst = violation_.template lpNorm<Eigen::Infinity>();
            if (k == 0) gap_correction = std::max(gap_correction, worst);
            if (worst <= rounding * params_.coordinate_scale) break;
            correct(x.data());
            evaluate(system, t, x);
            pose(phase.closed);
        }
        hold(phase, false);
        velocity_correction =
            std::max(velocity_correction, violation_.template lpNorm<Eigen::Infinity>());
        correct(x.data() + q.size());
    }
    /// u + A^-1 G^T r of impulses of contacts that were posed.
    void apply(const Eigen::VectorXd& impulse, State& x) {
        step_.noalias() = mobility_ * impulse;
        factor_.backward(step_);
        const std::size_t n = x.size() / 2;
        for (std::size_t i = 0; i < n; ++i) x[n + i] += step_[static_cast<Eigen::Index>(i)];
    }

    double normal_velocity(std::size_t place) const {
        return contacts[place].relative_velocity(u)[0];
    }
    Eigen::VectorXd slip_velocity(std::size_t place) const {
        const Vector<rows> all = contacts[place].relative_velocity(u);
        Eigen::VectorXd slip(rows - 1);
        for (int i = 1; i < rows; ++i) slip[i - 1] = all[i];
        return slip;
    }
    /// mu of a contact. Throws input_error unless its law is valid, and has a cone.
    double friction(std::size_t place) const {
        const auto& contact = contacts[place];
        evaluation_.require_law(contact, place, time_);
        const auto cone = std::optional<FrictionCone<rows>>(cone_of<rows>(contact.law));
        if (!cone)
            throw input_error(
                detail::at_time("law of " + detail::contact_text(place, contact.name), time_) +
                " has no friction cone, but must have one");
        return cone->mu;
    }

    Coordinates q, u;                                     ///< of the last evaluation
    typename Types::Contacts contacts;                    ///< the same
    AccelerationProblem problem;                          ///< of the contacts posed last
    ModeSystem forces;                                    ///< of the last `solve`
    const ContactModes& modes() const { return modes_; }  ///< of that

  private:
    void require_contact_count(std::size_t count) const {
        require_count("contacts of the system", count, "its first state", contact_count_);
    }
    /// Adds G' u + W' to b.
    void add_bias(const System& system, std::span<const std::size_t> places) {
        constexpr double width = 1e-3, of_slope = 1e-5, of_size = 1e-6, narrower = 0.25;
        constexpr int most = 5;
        const double speed = u.template lpNorm<Eigen::Infinity>();
        const double first = width * (speed * params_.time_scale > params_.coordinate_scale
                                          ? params_.coordinate_scale / speed
                                          : params_.time_scale);
        double delta = first;
        const double size = (rows_.cwiseAbs() * u.cwiseAbs()).size() == 0
                                ? 0.0
                                : (rows_.cwiseAbs() * u.cwiseAbs()).maxCoeff();
        for (int k = 0;; ++k, delta *= narrower) {
            difference(system, places, delta, near_);
            difference(system, places, 2.0 * delta, far_);
            const double differ = (near_ - far_).template lpNorm<Eigen::Infinity>();
            const double slope = near_.template lpNorm<Eigen::Infinity>();
            if (k == most || differ <= of_slope * slope + of_size * size / first * width) break;
        }
        problem.b += (4.0 * near_ - far_) / 3.0;
    }
    void difference(const System& system, std::span<const std::size_t> places, double delta,
                    Eigen::VectorXd& slope) {
        slope.setZero(problem.b.size());
        for (const double sign : {1.0, -1.0}) {
            shifted_q_ = q + sign * delta * u;
            evaluation_.contacts(system, time_ + sign * delta, shifted_q_, shifted_);
            require_contact_count(shifted_.size());
            for (std::size_t c = 0; c < places.size(); ++c) {
                const Vector<rows> velocity = shifted_[places[c]].relative_velocity(u);
                for (int i = 0; i < rows; ++i)
                    slope[problem.row(c) + i] += sign / (2.0 * delta) * velocity[i];
            }
        }
    }
    /// What is off, and the rows that it is of: gaps, or velocities of contacts that stay or stick.
    void hold(const SmoothPhase& phase, bool gaps) {
        held_.clear();
        for (std::size_t c = 0; c < phase.closed.size(); ++c) {
            const Eigen::Index more =
                !gaps && phase.modes.mode[c] == ContactMode::sticking ? rows : 1;
            for (Eigen::Index i = 0; i < more; ++i) held_.push_back(problem.row(c) + i);
        }
        violation_.resize(static_cast<Eigen::Index>(held_.size()));
        held_mobility_.resize(q.size(), violation_.size());
        for (std::size_t i = 0; i < held_.size(); ++i) {
            const auto& contact = contacts[phase.closed[static_cast<std::size_t>(held_[i]) / rows]];
            violation_[static_cast<Eigen::Index>(i)] =
                gaps ? contact.gap
                     : contact.relative_velocity(u)[static_cast<int>(held_[i] % rows)];
            held_mobility_.col(static_cast<Eigen::Index>(i)) = mobility_.col(held_[i]);
        }
    }
    void correct(double* x) {
        constexpr double redundant = 1e-11;
        least_.setThreshold(redundant);
        least_.compute(held_mobility_.transpose() * held_mobility_);
        step_.noalias() = held_mobility_ * least_.solve(violation_);
        factor_.backward(step_);
        for (Eigen::Index i = 0; i < step_.size(); ++i) x[i] -= step_[i];
    }

    EventDrivenParams params_;
    std::size_t contact_count_;
    SystemEvaluation<System> evaluation_;
    double time_ = 0.0;
    typename Types::MassMatrix mass_;
    MassFactor<Types::dof> factor_;
    Coordinates free_, change_, shifted_q_;  ///< A^-1 F
    typename Types::Contacts shifted_;
    Eigen::MatrixXd rows_, mobility_, held_mobility_;  ///< G, L^-1 G^T
    Eigen::VectorXd near_, far_, violation_;
    Eigen::Matrix<double, Eigen::Dynamic, 1> step_;
    std::vector<Eigen::Index> held_;
    ContactModes modes_;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_;
};

}  // namespace talus
