// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/solver/cone_engine.hpp>

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
    using Tangent = Eigen::Matrix<double, Dim - 1, 1>;

    struct Pair {
        Vector<Dim> r, u;
        Matrix<Dim> d;  ///< -du/dr along the pairs of this eps
    };

    /// The pair with r - u = x and complementarity eps.
    static Pair pair_at(const Vector<Dim>& x, double mu, double eps) {
        Pair p;
        p.d.setZero();
        const double root = std::sqrt(x[0] * x[0] + 4.0 * eps);
        p.r[0] = x[0] >= 0.0 ? 0.5 * (x[0] + root) : 2.0 * eps / (root - x[0]);
        p.u[0] = eps / p.r[0];
        p.d(0, 0) = p.u[0] / p.r[0];
        const Tangent x_t = x.template tail<Dim - 1>();
        const double length = x_t.norm(), radius = mu * p.r[0];
        if (radius == 0.0) {
            constexpr double rigid = 1e30;
            p.r.template tail<Dim - 1>().setZero();
            p.u.template tail<Dim - 1>() = -x_t;
            p.d.diagonal().template tail<Dim - 1>().setConstant(rigid);
            return p;
        }
        const double depth = depth_in_disc(length, radius, eps);
        const double reach = radius - depth;  // |r_t|
        const double room = depth * (radius + reach);
        const double lambda = eps / room;  // u_t = -lambda r_t
        const Tangent r_t = length > 0.0 ? Tangent(x_t * (reach / length)) : Tangent::Zero();
        p.r.template tail<Dim - 1>() = r_t;
        p.u.template tail<Dim - 1>() = -lambda * r_t;
        // Beyond `stiff` a number only says that something does not move: larger ones would drown
        // the others of their block.
        constexpr double stiff = 1e9;
        if (p.d(0, 0) > stiff) {
            p.d.diagonal().setConstant(stiff);
            return p;
        }
        auto block = p.d.template bottomRightCorner<Dim - 1, Dim - 1>();
        const double wall = 2.0 * lambda / room *
                            std::min(1.0, stiff * room / (2.0 * lambda * reach * reach + 1e-300));
        block = wall * r_t * r_t.transpose();
        block.diagonal().array() += std::min(lambda, stiff);
        p.d.template bottomLeftCorner<Dim - 1, 1>() = -(wall * radius * mu) * r_t;
        return p;
    }
    /// d in (0, R] with (R - d) (1 + eps / (d (2 R - d))) = length: how far inside the disc r_t
    /// ends. The left side falls with d; Newton in a bracket.
    static double depth_in_disc(double length, double radius, double eps) {
        double low = 0.0, high = radius;
        double d = length < radius ? radius - length / (1.0 + eps / (radius * radius))
                                   : radius * eps / (2.0 * radius * (length - radius) + eps);
        if (!(d > 0.0 && d < radius)) d = 0.5 * radius;
        for (int k = 0; k < 200; ++k) {
            const double left = radius - d, w = d * (radius + left);
            const double f = length * w - left * (w + eps);
            (f < 0.0 ? low : high) = d;
            const double slope = 2.0 * left * length + w + eps - 2.0 * left * left;
            double next = d - f / slope;
            if (!(next > low && next < high))
                next = low > 0.0 ? std::sqrt(low * high) : 1e-3 * high;
            const bool done = std::abs(next - d) <= 4e-16 * d;
            d = next;
            if (done) break;
        }
        return d;
    }

    /// Pairs at x; error = W r + q - u and the distance to `anchor` for the proximal term.
    void evaluate(const Vec& x, double eps) {
        const auto& system = this->system_;
        pairs_.resize(system.contact_count());
        r_.resize(x.size());
        for (std::size_t c = 0; c < pairs_.size(); ++c) {
            pairs_[c] = pair_at(x.template segment<Dim>(system.first(c)), system.cone(c).mu, eps);
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

    std::vector<Pair> pairs_;
    std::vector<Matrix<Dim>> d_;
    Vec r_, u_;
};

}  // namespace talus
