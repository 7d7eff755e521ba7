// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/solver/cones/cone_engine.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bench {

struct ExtragradientParams {
    /// Steps allowed [-], not negative. Each takes two products with W, a rejected one takes one.
    int max_iterations = 10000;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-4;
};

/// Extragradient [Korpelevich1976] on Coulomb's law as a variational inequality: r in K with
/// F(r).(x - r) >= 0 for all x in K, F = W r + q + mu |u_t| n, u = W r + q. A trial step
/// ahead = P(r - step F(r)), then r := P(r - along step F(ahead)).
///
/// `step` follows the change of F: step |F(r) - F(ahead)| <= 0.9 |r - ahead|, or the trial is
/// repeated with a shorter one [Khobotov1987]; `along` is the projection of r - ahead on its
/// part that F does not explain, times 1.9 [HeLiao2002]: a third to a half fewer steps than along
/// = 1.
///
/// It asks nothing of F but to be monotone, and no potential, which the exact law does not have. So
/// it is the plain method to compare others with: never wrong and 5 to 20 times as slow to 1e-4 as
/// ProjectedGradient. Cost: two products with W and two projections per contact in a step. Memory:
/// some vectors beside W. Where F is not monotone (many slow slips, with much friction), or W very
/// ill-conditioned (towers, piles from a cold start), it creeps and ends as `iteration_limit` with
/// the best impulses met.
template <int Dim, talus::ConeLaw<Dim> Law>
class Extragradient : public talus::ConeEngine<Dim, Law, Extragradient<Dim, Law>> {
  public:
    explicit Extragradient(ExtragradientParams params = {}) : params(params) {}
    ExtragradientParams params;

  private:
    using Base = talus::ConeEngine<Dim, Law, Extragradient<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;

    void iterate(Vec& best);

    /// F = W r + q + mu |u_t| n, and the velocity in it.
    void evaluate(const Vec& r, Vec& u, Vec& f) const {
        const auto& system = this->system_;
        system.multiply(r, u);
        u += system.free_velocity();
        f.resize(u.size());
        for (std::size_t c = 0; c < system.contact_count(); ++c) {
            const Eigen::Index i = system.first(c);
            f.template segment<Dim>(i) =
                talus::de_saxce_corrected<Dim>(u.template segment<Dim>(i), system.cone(c).mu);
        }
    }
    /// to = P(r - step f).
    void project(const Vec& r, double step, const Vec& f, Vec& to) const {
        const auto& system = this->system_;
        to.resize(r.size());
        for (std::size_t c = 0; c < system.contact_count(); ++c) {
            const Eigen::Index i = system.first(c);
            to.template segment<Dim>(i) = system.cone(c).project(r.template segment<Dim>(i) -
                                                                 step * f.template segment<Dim>(i));
        }
    }

    Vec r_, u_, f_, ahead_, u_ahead_, f_ahead_, change_;
};

template <int Dim, talus::ConeLaw<Dim> Law>
void Extragradient<Dim, Law>::iterate(Vec& best) {
    const auto& system = this->system_;
    constexpr double contraction = 0.9, timid = 0.3, change_of_step = 2.0 / 3.0;
    constexpr double over_relaxation = 1.9;
    constexpr double shortest = 1e-12, longest = 1e6;
    constexpr int look = 10;
    r_ = best;
    evaluate(r_, u_, f_);
    double step = 1.0;
    for (int k = 1; k <= params.max_iterations; ++k) {
        project(r_, step, f_, ahead_);
        change_ = r_ - ahead_;
        const double move = change_.norm();
        if (!std::isfinite(move)) return;
        // The residual is at least what a move says [CalamaiMore1987].
        const double scale = std::max(r_.norm(), system.free_velocity().norm());
        const bool may_be_solved =
            std::min(1.0, 1.0 / step) * move <= 2.0 * params.tolerance * scale;
        if ((may_be_solved || k % look == 0 || k == params.max_iterations) &&
            this->offer(k, r_, u_, best))
            return;
        if (move == 0.0) return;
        evaluate(ahead_, u_ahead_, f_ahead_);
        const double ratio = step * (f_ - f_ahead_).norm() / move;
        if (ratio > contraction && step > shortest) {
            step *= change_of_step * std::min(1.0, 1.0 / ratio);
            continue;
        }
        // change_: r - ahead - step (F(r) - F(ahead)), after its product with the first two terms.
        double along = move * move - step * change_.dot(f_ - f_ahead_);
        change_ -= step * (f_ - f_ahead_);
        along *= over_relaxation / change_.squaredNorm();
        if (!(along > 0.0 && std::isfinite(along))) along = 1.0;
        project(r_, along * step, f_ahead_, r_);
        evaluate(r_, u_, f_);
        if (ratio < timid) step = std::min(step / change_of_step, longest);
    }
}

}  // namespace bench
