// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>
#include <talus/solver/cones/cone_engine.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bench {

struct AdmmParams {
    /// Iterations allowed [-], not negative: a solve with the factors of W + penalty each.
    int max_iterations = 2000;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-4;
    /// First penalty, in the scaled units where the diagonal blocks of W have the mean eigenvalue 1
    /// [-], positive.
    double penalty = 0.05;
    /// Factorisations allowed in a solve [-], at least 1.
    int max_factorizations = 12;
};

/// Alternating direction method of multipliers [BoydEtAl2011] on Coulomb's law: the impulses are
/// doubled, r obeys the dynamics, z is in the friction cones, and a multiplier y draws them
/// together:
///
///   (W + penalty) r = penalty (z - y) - q - s,  z := P(a r + (1 - a) z + y),  y := y + ... - z.
///
/// When r = z, -penalty y is the velocity u + s of de Saxce's cone complementarity. The shift s_c =
/// mu |u_t| n is renewed in every iteration from the tangential part of that velocity, so that no
/// product is spent on it and the fixed point is the exact law. a = 1.6 over-relaxes
/// [EcksteinBertsekas1992], worth a fifth to a third of the iterations.
///
/// One factorisation serves all iterations of a penalty. The penalty balances |r - z| and
/// penalty |change of z| [HeYangWang2000]: they are compared rarely and later and later, over all
/// iterations since, and a new penalty is worth its factors only if they differ 5-fold. If the
/// residual wanders far above the best one met, the shift spoils convergence: then the penalty is
/// doubled, and never less again.
///
/// Cost: a factorisation (as one iteration of InteriorPoint) and some 2 to 5 times a product with W
/// per iteration. Memory: the factors. The pattern is analysed again only if it changed since the
/// last solve of this object. 15 to 60 iterations to 1e-4 in hyperstatic systems and masonry, some
/// hundreds in piles, with 1 to 5 factorisations. It loses where factors are expensive, and at
/// tight tolerances, as all methods here that move the shift, to slow slips: ends as
/// `iteration_limit`.
template <int Dim, talus::ConeLaw<Dim> Law>
class Admm : public talus::ConeEngine<Dim, Law, Admm<Dim, Law>> {
  public:
    explicit Admm(AdmmParams params = {}) : params(params) {}
    AdmmParams params;

  private:
    using Base = talus::ConeEngine<Dim, Law, Admm<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;

    static constexpr double relaxation = 1.6;
    static constexpr int look = 5;       ///< iterations between residuals
    static constexpr int patience = 50;  ///< iterations without progress

    void iterate(Vec& best);

    bool factorize() {
        d_.assign(this->system_.contact_count(), penalty_ * talus::Matrix<Dim>::Identity());
        ++factorizations_;
        return this->system_.factorize(d_);
    }
    /// False if the new matrix cannot be factorised.
    bool change_penalty(double factor) {
        penalty_ *= factor;
        y_ /= factor;
        primal_ = dual_ = 0.0;
        return factorize();
    }
    /// z = the warm start, y = its velocity.
    void start(const Vec& r) {
        const auto& system = this->system_;
        z_ = r;
        system.multiply(z_, u_);
        u_ += system.free_velocity();
        y_.resize(z_.size());
        shift_.resize(static_cast<Eigen::Index>(system.contact_count()));
        for (std::size_t c = 0; c < system.contact_count(); ++c) {
            const Eigen::Index i = system.first(c);
            talus::Vector<Dim> u = u_.template segment<Dim>(i);
            const double shift = system.cone(c).mu * u.template tail<Dim - 1>().norm();
            u[0] += shift;
            shift_[static_cast<Eigen::Index>(c)] = shift;
            y_.template segment<Dim>(i) = -system.cone(c).project_dual(u) / penalty_;
        }
    }
    /// r, then z, y and the shift; adds to primal_ and dual_. Returns the larger of the two errors
    /// of this iteration.
    double advance();

    double penalty_ = 0.0, primal_ = 0.0, dual_ = 0.0;
    int factorizations_ = 0;
    std::vector<talus::Matrix<Dim>> d_;
    Vec r_, z_, y_, right_, u_, shift_;
};

template <int Dim, talus::ConeLaw<Dim> Law>
double Admm<Dim, Law>::advance() {
    auto& system = this->system_;
    right_ = penalty_ * (z_ - y_) - system.free_velocity();
    for (std::size_t c = 0; c < system.contact_count(); ++c)
        right_[system.first(c)] -= shift_[static_cast<Eigen::Index>(c)];
    system.solve(right_, r_, 0);
    double primal = 0.0, dual = 0.0;
    for (std::size_t c = 0; c < system.contact_count(); ++c) {
        const Eigen::Index i = system.first(c);
        const talus::Vector<Dim> r = r_.template segment<Dim>(i);
        const talus::Vector<Dim> z = z_.template segment<Dim>(i);
        const talus::Vector<Dim> x =
            relaxation * r + (1.0 - relaxation) * z + y_.template segment<Dim>(i);
        const talus::Vector<Dim> nearest = system.cone(c).project(x);
        const talus::Vector<Dim> y = x - nearest;
        primal += (r - nearest).squaredNorm();
        dual += (nearest - z).squaredNorm();
        shift_[static_cast<Eigen::Index>(c)] =
            system.cone(c).mu * penalty_ * y.template tail<Dim - 1>().norm();
        z_.template segment<Dim>(i) = nearest;
        y_.template segment<Dim>(i) = y;
    }
    dual *= penalty_ * penalty_;
    primal_ += primal;
    dual_ += dual;
    // Not std::max alone, which may drop a NaN.
    return std::sqrt(std::max(primal, dual)) + 0.0 * (primal + dual);
}

template <int Dim, talus::ConeLaw<Dim> Law>
void Admm<Dim, Law>::iterate(Vec& best) {
    talus::require_positive("penalty", params.penalty);
    constexpr double imbalance = 5.0, largest_change = 20.0;
    const auto& system = this->system_;
    penalty_ = params.penalty;
    primal_ = dual_ = 0.0;
    factorizations_ = 0;
    start(best);
    if (!factorize()) return;
    double least_penalty = 0.0, mark = this->best_residual();
    int compare = 10, marked = 0;
    for (int k = 1; k <= params.max_iterations; ++k) {
        const double error = advance();
        if (!std::isfinite(error)) return;
        const double scale = std::max(z_.norm(), system.free_velocity().norm());
        if (error <= params.tolerance * scale || k % look == 0 || k == params.max_iterations) {
            system.multiply(z_, u_);
            u_ += system.free_velocity();
            if (this->offer(k, z_, u_, best)) return;
        }
        if (factorizations_ >= params.max_factorizations) continue;
        if (this->best_residual() < 0.9 * mark) {
            mark = this->best_residual();
            marked = k;
        } else if (k - marked >= patience) {
            marked = k;
            if (this->report_.history.back().residual > 2.0 * mark) {
                if (!change_penalty(2.0)) return;
                least_penalty = penalty_;
                compare = k + k / 2;
            }
        }
        if (k < compare) continue;
        compare = k + k / 2;
        const double ratio = std::sqrt(primal_ / dual_);
        primal_ = dual_ = 0.0;
        if (!std::isfinite(ratio) || (ratio < imbalance && ratio > 1.0 / imbalance)) continue;
        const double factor =
            std::max(std::clamp(std::sqrt(ratio), 1.0 / largest_change, largest_change),
                     least_penalty / penalty_);
        if (factor != 1.0 && !change_penalty(factor)) return;
    }
}

}  // namespace bench
