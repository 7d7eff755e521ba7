// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/cone_engine.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace talus {

/// How a projected gradient method chooses its steps.
enum class GradientStep {
    spectral,     ///< step lengths of Barzilai and Borwein, a line search that lets f rise at times
    accelerated,  ///< momentum of Nesterov with restarts, step lengths found by trial
};

/// Which law a convex method works on.
enum class ShiftRule {
    exact,       ///< Coulomb's: the shift mu |u_t| follows the velocity in every iteration
    convexified  ///< no shift: sliding contacts open at mu |u_t|. The residual reported is still
                 ///< that of Coulomb's law, so `converged` is for systems that do not slide
};

struct ProjectedGradientParams {
    /// Products with W allowed, about [-], not negative.
    int max_iterations = 10000;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-4;
    GradientStep step = GradientStep::spectral;
    ShiftRule shift = ShiftRule::exact;
};

/// Projected gradients on  f(r) = r.(W r / 2 + q + s)  over the product of the friction cones, with
/// s_c = mu |u_t| n, de Saxce's shift, which makes the minimum obey Coulomb's law if s belongs to
/// it. For a shift that is held this is a convex program; here s follows u in every iteration, and
/// the fixed point, if one is reached, is the exact law. What was measured: to hold s until the
/// convex program is solved, and then renew it, is slower nearly everywhere.
///
/// `spectral`: r += lambda d with d = P(r - alpha g) - r, g = u + s [BirginMartinezRaydan2000]. As
/// f is quadratic, W d gives everything the line search wants: one product per iteration, no trial.
/// Of five alphas one is the long and four are the short step of Barzilai and Borwein
/// [BarzilaiBorwein1988], both with the change of s in the change of the gradient: where slip makes
/// the shift react, steps become shorter. The line search takes f with the present s; the largest f
/// of ten iterations counts the work done on the way, as no single f is left when s moves.
///
/// `accelerated`: Nesterov's momentum, dropped when it points uphill, a step that is halved where
/// f curves more and regained slowly [MazharEtAl2015]. One product per iteration or trial. Where
/// the shift makes momentum grow instead of f fall, momentum is limited, and freed again later.
///
/// The first is faster to 1e-4 and never far off where contacts slide, the second is faster to
/// tight tolerances in stacks and towers and may stay at 1e-4 in heaps that flow.
///
/// Cost: a product with W and a projection per contact in an iteration, the latter twice if the
/// residual is evaluated; that is done in every tenth iteration and where the step does not rule
/// out that the tolerance is reached. Memory: some vectors beside W. 30 to 200 iterations to 1e-4
/// in small hyperstatic systems, some hundreds in piles and masonry, thousands in high towers with
/// large ratios of masses. Tight tolerances take long where contacts slip slowly: the exact law has
/// no potential there, the residual wanders, and the best impulses met are returned as
/// `iteration_limit`.
template <int Dim, ConeLaw<Dim> Law>
class ProjectedGradient : public ConeEngine<Dim, Law, ProjectedGradient<Dim, Law>> {
  public:
    explicit ProjectedGradient(ProjectedGradientParams params = {}) : params(params) {}
    ProjectedGradientParams params;

  private:
    using Base = ConeEngine<Dim, Law, ProjectedGradient<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;

    static constexpr int refresh = 50;   ///< iterations between exact products, against drift
    static constexpr int look = 10;      ///< iterations between residuals
    static constexpr int patience = 50;  ///< iterations without progress
    static constexpr double longest_step = 1e6, shortest_step = 1e-6;

    void iterate(Vec& best) {
        const auto& system = this->system_;
        r_ = best;
        renew_velocity(r_, u_);
        shift_.setZero(static_cast<Eigen::Index>(system.contact_count()));
        if (params.shift == ShiftRule::exact)
            for (std::size_t c = 0; c < system.contact_count(); ++c)
                shift_[static_cast<Eigen::Index>(c)] = shift_at(c, u_);
        scale_ = std::max(r_.norm(), system.free_velocity().norm());
        if (params.step == GradientStep::spectral)
            iterate_spectral(best);
        else
            iterate_accelerated(best);
    }
    void iterate_spectral(Vec& best);
    void iterate_accelerated(Vec& best);

    void renew_velocity(const Vec& r, Vec& u) const {
        this->system_.multiply(r, u);
        u += this->system_.free_velocity();
    }
    double shift_at(std::size_t c, const Vec& u) const {
        return this->system_.cone(c).mu *
               u.template segment<Dim - 1>(this->system_.first(c) + 1).norm();
    }

    /// Offers r. What u = W r + q has gathered of rounding errors must not decide.
    bool is_over(int iteration, Vec& best) {
        if (this->system_.residual(r_, u_) <= params.tolerance) renew_velocity(r_, u_);
        return this->offer(iteration, r_, u_, best);
    }

    /// What a projected step from x is. Fills `d` with it.
    struct Step {
        double slope = 0.0;   ///< g.d
        double square = 0.0;  ///< |d|^2
    };
    Step projected_step(const Vec& x, const Vec& u, double alpha, Vec& d) const {
        const auto& system = this->system_;
        Step step;
        d.resize(x.size());
        for (std::size_t c = 0; c < system.contact_count(); ++c) {
            const Eigen::Index i = system.first(c);
            const Vector<Dim> from = x.template segment<Dim>(i);
            Vector<Dim> g = u.template segment<Dim>(i);
            g[0] += shift_[static_cast<Eigen::Index>(c)];
            const Vector<Dim> move = system.cone(c).project(from - alpha * g) - from;
            step.slope += g.dot(move);
            step.square += move.squaredNorm();
            d.template segment<Dim>(i) = move;
        }
        return step;
    }
    /// Whether the residual must be looked at after a step of length sqrt(square): that of step
    /// alpha is at least min(1, alpha) times that of step 1 [CalamaiMore1987].
    bool may_be_solved(double square, double alpha) const {
        return std::min(1.0, 1.0 / alpha) * std::sqrt(square) <= 2.0 * params.tolerance * scale_;
    }

    Vec r_, u_, shift_, d_, w_;
    Vec y_, uy_, next_, u_next_;
    double scale_ = 0.0;
};

template <int Dim, ConeLaw<Dim> Law>
void ProjectedGradient<Dim, Law>::iterate_spectral(Vec& best) {
    const auto& system = this->system_;
    constexpr int short_steps = 4;  // after each long one
    constexpr double sufficient = 1e-4;
    std::array<double, 10> recent{};
    double f = 0.0, alpha = 1.0;
    for (int k = 1; k <= params.max_iterations; ++k) {
        const Step step = projected_step(r_, u_, alpha, d_);
        if (!std::isfinite(step.square)) return;
        if (step.square == 0.0) {
            is_over(k, best);
            return;
        }
        system.multiply(d_, w_);
        // Of f along d: with r, u and W d at hand no further product is needed.
        const double curvature = d_.dot(w_);

        // The longest lambda with f(r + lambda d) <= max f + sufficient lambda g.d; where that is
        // not 1, the minimum of f on the way.
        double lambda = 1.0;
        if (curvature > 0.0) {
            const double to_minimum = -step.slope / curvature;
            const double half = (1.0 - sufficient) * to_minimum;
            const double room = *std::max_element(recent.begin(), recent.end()) - f;
            if (half + std::sqrt(half * half + 2.0 * room / curvature) < 1.0)
                lambda = std::clamp(to_minimum, 1e-3, 1.0);
        }
        r_ += lambda * d_;
        u_ += lambda * w_;
        f += lambda * (step.slope + 0.5 * lambda * curvature);
        recent[static_cast<std::size_t>(k) % recent.size()] = f;
        if (k % refresh == 0) {
            renew_velocity(r_, u_);
            scale_ = std::max(r_.norm(), system.free_velocity().norm());
        }

        const bool solved = may_be_solved(step.square, alpha);
        // Change of the gradient per lambda: w and the change of the shift.
        double along = curvature, square = w_.squaredNorm();
        if (params.shift == ShiftRule::exact)
            for (std::size_t c = 0; c < system.contact_count(); ++c) {
                const auto place = static_cast<Eigen::Index>(c);
                const Eigen::Index i = system.first(c);
                const double shift = shift_at(c, u_);
                const double change = (shift - shift_[place]) / lambda;
                along += change * d_[i];
                square += change * (change + 2.0 * w_[i]);
                shift_[place] = shift;
            }
        along = std::abs(along);
        if (k % (short_steps + 1) == 0)
            alpha = step.square / along;
        else
            alpha = along / square;
        // Also where 0/0 makes it NaN.
        if (!(alpha > shortest_step)) alpha = 1.0;
        alpha = std::min(alpha, longest_step);

        if ((solved || k % look == 0 || k == params.max_iterations) && is_over(k, best)) return;
    }
}

template <int Dim, ConeLaw<Dim> Law>
void ProjectedGradient<Dim, Law>::iterate_accelerated(Vec& best) {
    const auto& system = this->system_;
    y_ = r_;
    uy_ = u_;
    double theta = 1.0, alpha = 1.0;
    double least_theta = 0.0;  // momentum is at most 1 - theta, about
    double mark = this->best_residual();
    int marked = 0, since_renewal = 0;
    for (int k = 1; k <= params.max_iterations; ++k) {
        const Step step = projected_step(y_, uy_, alpha, d_);
        if (!std::isfinite(step.square)) return;
        system.multiply(d_, w_);
        const double curvature = d_.dot(w_);
        // f curves more than 1 / alpha along the step: momentum would not be justified.
        if (curvature * alpha > step.square && alpha > shortest_step) {
            alpha = std::max(shortest_step, std::min(0.5 * alpha, 0.9 * step.square / curvature));
            continue;
        }
        next_ = y_ + d_;
        u_next_ = uy_ + w_;
        // Both: the momentum would multiply a jump of one.
        if (++since_renewal >= refresh) {
            since_renewal = 0;
            renew_velocity(r_, u_);
            renew_velocity(next_, u_next_);
            scale_ = std::max(next_.norm(), system.free_velocity().norm());
        }
        d_ = next_ - r_;
        w_ = u_next_ - u_;
        // Gradient at y times the step from r: momentum that points uphill is dropped.
        double uphill = uy_.dot(d_);
        for (std::size_t c = 0; c < system.contact_count(); ++c)
            uphill += shift_[static_cast<Eigen::Index>(c)] * d_[system.first(c)];
        r_.swap(next_);
        u_.swap(u_next_);
        if (uphill > 0.0) {
            theta = 1.0;
            y_ = r_;
            uy_ = u_;
        } else {
            const double square = theta * theta;
            const double next_theta = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
            const double beta = theta * (1.0 - theta) / (square + next_theta);
            theta = std::max(next_theta, least_theta);
            y_ = r_ + beta * d_;
            uy_ = u_ + beta * w_;
        }
        const bool solved = may_be_solved(step.square, alpha);
        alpha = std::min(alpha / 0.9, longest_step);
        if (params.shift == ShiftRule::exact)
            for (std::size_t c = 0; c < system.contact_count(); ++c)
                shift_[static_cast<Eigen::Index>(c)] = shift_at(c, uy_);
        if (!solved && k % look != 0 && k != params.max_iterations) continue;
        if (is_over(k, best)) return;
        if (this->best_residual() < 0.9 * mark) {
            mark = this->best_residual();
            marked = k;
        } else if (k - marked >= patience) {
            // No progress. Far above the best, the moving shift feeds the momentum: less of it.
            marked = k;
            if (this->report_.history.back().residual > 2.0 * this->best_residual()) {
                least_theta = std::clamp(2.0 * least_theta, 0.02, 0.5);
                theta = 1.0;
                y_ = r_;
                uy_ = u_;
            } else {
                least_theta *= 0.5;
            }
        }
    }
}

}  // namespace talus

TALUS_IN_PLANE(
    class talus::ConeEngine<2, talus::Coulomb<2>, talus::ProjectedGradient<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(
    class talus::ConeEngine<3, talus::Coulomb<3>, talus::ProjectedGradient<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::ProjectedGradient<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(class talus::ProjectedGradient<3, talus::Coulomb<3>>)
