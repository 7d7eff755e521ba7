// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
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
template <int Dim, ContactLaw<Dim> Law>
class NewtonPolish : public ConeEngine<Dim, Law, NewtonPolish<Dim, Law>> {
  public:
    explicit NewtonPolish(NewtonPolishParams params = {}) : params(params) {}
    NewtonPolishParams params;

  private:
    using Base = ConeEngine<Dim, Law, NewtonPolish<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;

    /// Pairs at x; error = W r + q - u and the distance to `anchor` for the proximal term.
    void evaluate(const Vec& x, double eps) {
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

    void iterate(Vec& best) {
        auto& system = this->system_;
        Vec u, x, right, dr, dx;
        int iteration = 0;
        double share = 1e-2;  // sqrt(eps) over the error per contact
        int failures = 0;
        while (iteration < params.max_iterations && failures < 3) {
            system.multiply(best, u);
            u += system.free_velocity();
            x = best - u;
            const double error = this->best_residual() *
                                 std::max(best.norm(), system.free_velocity().norm()) /
                                 std::sqrt(static_cast<double>(system.contact_count()));
            const double eps = share * share * error * error + 1e-300;
            evaluate(x, eps);
            d_.resize(pairs_.size());
            right.resize(x.size());
            for (std::size_t c = 0; c < pairs_.size(); ++c) {
                d_[c] = pairs_[c].d + params.proximal * Matrix<Dim>::Identity();
                right.template segment<Dim>(system.first(c)) =
                    pairs_[c].u - u_.template segment<Dim>(system.first(c));
            }
            ++iteration;
            if (!system.factorize(d_)) break;
            system.solve(right, dr);
            if (!dr.allFinite()) break;
            dx = dr;
            for (std::size_t c = 0; c < pairs_.size(); ++c)
                dx.template segment<Dim>(system.first(c)) +=
                    pairs_[c].d * dr.template segment<Dim>(system.first(c));
            const double before = this->best_residual();
            double step = 1.0;
            bool done = false;
            for (int k = 0;
                 k < 6 && !(this->best_residual() < (1.0 - 0.1 * step) * before) && !done;
                 ++k, step *= 0.5) {
                evaluate(x + step * dx, eps);
                done = this->offer(iteration, r_, u_, best);
            }
            if (done) return;
            if (this->best_residual() < 0.9 * before) {
                failures = 0;
            } else {
                ++failures;
                share *= failures == 1 ? 30.0 : 1.0 / 900.0;
            }
        }
    }

    std::vector<CentralPair<Dim>> pairs_;
    std::vector<Matrix<Dim>> d_;
    Vec r_, u_;
};

}  // namespace talus
