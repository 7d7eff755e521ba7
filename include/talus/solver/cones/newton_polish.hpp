// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/central_pair.hpp>
#include <talus/solver/cones/cone_engine.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

struct NewtonPolishParams {
    /// Newton steps allowed [-], not negative.
    int max_iterations = 30;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-12;
    /// Added to the diagonal of W, whose entries are of order 1 in scaled units [-]: chooses among
    /// the impulses of a hyperstatic system those nearest to the present ones. Each step leaves
    /// this share of its error or more.
    double proximal = 1e-10;
};

/// Guarded Newton steps on Coulomb's law, from impulses whose contact statuses are nearly right:
/// the last digits, or steps after a small change. The unknown is x = r - u of each contact, as in
/// smoothing methods [ChenMangasarian1996]: r and u are the pair with r - u = x on the central path
/// of InteriorPoint at a complementarity eps far below the error reached, so that the law holds by
/// construction, the active set (open, stick, slip) is what x says, the direction of slip turns as
/// it should, and only u = W r + q is left to Newton. A step, or a half, a quarter... of it, is
/// taken only if the residual falls.
///
/// Converges in 2 to 6 factorisations near a solution with clear statuses; from afar it ends as
/// `stalled` with whatever was gained.
template <int Dim, ConeLaw<Dim> Law>
class NewtonPolish : public ConeEngine<Dim, Law, NewtonPolish<Dim, Law>> {
  public:
    explicit NewtonPolish(NewtonPolishParams params = {}) : params(params) {}
    NewtonPolishParams params;

  private:
    using Base = ConeEngine<Dim, Law, NewtonPolish<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;

    void evaluate(const Vec& x, double eps);
    void iterate(Vec& best);
    double complementarity(const Vec& best, double share) const;
    bool find_step(const Vec& x);
    bool search(const Vec& x, double eps, int iteration, Vec& best);

    std::vector<CentralPair<Dim>> pairs_;
    std::vector<Matrix<Dim>> d_;
    Vec r_, u_;  ///< impulses of the pairs, and W r + q
    Vec right_, dr_, dx_;
};

/// The pairs at x, and the velocities that their impulses lead to.
template <int Dim, ConeLaw<Dim> Law>
void NewtonPolish<Dim, Law>::evaluate(const Vec& x, double eps) {
    const auto& system = this->system_;
    pairs_.resize(system.contact_count());
    r_.resize(x.size());
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
        pairs_[c] =
            central_pair<Dim>(x.template segment<Dim>(system.first(c)), system.cone(c).mu, eps);
        r_.template segment<Dim>(system.first(c)) = pairs_[c].r;
    }
    system.multiply(r_, u_);
    u_ += system.free_velocity();
}

/// eps of the pairs [J]: sqrt(eps) is a share of the error per contact, so that smoothing is never
/// what limits a step, and statuses nearer than that to their border are not decided.
template <int Dim, ConeLaw<Dim> Law>
double NewtonPolish<Dim, Law>::complementarity(const Vec& best, double share) const {
    const auto& system = this->system_;
    const double error = this->best_residual() *
                         std::max(best.norm(), system.free_velocity().norm()) /
                         std::sqrt(static_cast<double>(system.contact_count()));
    return share * share * error * error + 1e-300;
}

/// Newton's step dx_ for W r(x) + q = u(x) from the pairs at x: with dr = dx + du and du = -D dr,
/// (W + D) dr = u - (W r + q) and dx = (1 + D) dr. False if there is none.
template <int Dim, ConeLaw<Dim> Law>
bool NewtonPolish<Dim, Law>::find_step(const Vec& x) {
    auto& system = this->system_;
    d_.resize(pairs_.size());
    right_.resize(x.size());
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
        d_[c] = pairs_[c].d + params.proximal * Matrix<Dim>::Identity();
        right_.template segment<Dim>(system.first(c)) =
            pairs_[c].u - u_.template segment<Dim>(system.first(c));
    }
    if (!system.factorize(d_)) return false;
    system.solve(right_, dr_);
    if (!dr_.allFinite()) return false;
    dx_ = dr_;
    for (std::size_t c = 0; c < pairs_.size(); ++c)
        dx_.template segment<Dim>(system.first(c)) +=
            pairs_[c].d * dr_.template segment<Dim>(system.first(c));
    return true;
}

/// Offers the step, a half, a quarter... of it, until the residual has fallen by a tenth of what
/// the length promises. True if the tolerance is reached.
template <int Dim, ConeLaw<Dim> Law>
bool NewtonPolish<Dim, Law>::search(const Vec& x, double eps, int iteration, Vec& best) {
    constexpr int tries = 6;  // to 1/32
    const double before = this->best_residual();
    double step = 1.0;
    for (int k = 0; k < tries && !(this->best_residual() < (1.0 - 0.1 * step) * before);
         ++k, step *= 0.5) {
        evaluate(x + step * dx_, eps);
        if (this->offer(iteration, r_, u_, best)) return true;
    }
    return false;
}

template <int Dim, ConeLaw<Dim> Law>
void NewtonPolish<Dim, Law>::iterate(Vec& best) {
    Vec u, x;
    double share = 1e-2;
    int failures = 0;
    for (int iteration = 1; iteration <= params.max_iterations && failures < 3; ++iteration) {
        this->system_.multiply(best, u);
        u += this->system_.free_velocity();
        x = best - u;
        const double eps = complementarity(best, share), before = this->best_residual();
        evaluate(x, eps);
        if (!find_step(x) || search(x, eps, iteration, best)) return;
        if (this->best_residual() < 0.9 * before) {
            failures = 0;
        } else {
            // Statuses may be too sharp, or too blurred: once each.
            ++failures;
            share *= failures == 1 ? 30.0 : 1.0 / 900.0;
        }
    }
}

}  // namespace talus

TALUS_IN_PLANE(
    class talus::ConeEngine<2, talus::Coulomb<2>, talus::NewtonPolish<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(
    class talus::ConeEngine<3, talus::Coulomb<3>, talus::NewtonPolish<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::NewtonPolish<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(class talus::NewtonPolish<3, talus::Coulomb<3>>)
