// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace talus {

/// Stabilised biconjugate gradients [VanDerVorst1992], preconditioned from the right, so that the
/// residual watched is the true one: A y = b for an A that need not be symmetric, known by
/// `multiply(x, y)` and by a `precondition(x)` that replaces x by about A^-1 x. Two of each per
/// iteration, eight vectors of memory. Of restarted GMRES and this, this went on where GMRES(40)
/// stood still.
class Bicgstab {
  public:
    using Vec = Eigen::VectorXd;

    /// From y = 0 until |b - A y| <= tolerance, or as far as it goes: after `limit` iterations, or
    /// where a product vanishes. Returns the number of iterations. y is finite if b is and A y for
    /// finite y.
    template <class Matrix>
    int solve(const Matrix& a, const Vec& b, Vec& y, double tolerance, int limit) {
        y.setZero(b.size());
        residual_ = shadow_ = p_ = b;
        // The shadow residual is the first one, the usual choice: rho begins as its square.
        double rho = residual_.squaredNorm();
        for (int k = 0; k < limit; ++k) {
            if (!(residual_.norm() > tolerance)) return k;
            preconditioned_ = p_;
            a.precondition(preconditioned_);
            a.multiply(preconditioned_, ap_);
            const double alpha = rho / shadow_.dot(ap_);
            // Breakdowns show as a division by zero. The caller begins anew from y, with its
            // residual as the new shadow, which is the usual cure.
            if (!std::isfinite(alpha)) return k + 1;
            y += alpha * preconditioned_;
            residual_ -= alpha * ap_;
            preconditioned_ = residual_;
            a.precondition(preconditioned_);
            a.multiply(preconditioned_, as_);
            // The half step was biconjugate; this one makes |residual - omega A s| least.
            const double omega = as_.dot(residual_) / as_.squaredNorm();
            if (!std::isfinite(omega)) return k + 1;
            y += omega * preconditioned_;
            residual_ -= omega * as_;
            const double next = shadow_.dot(residual_);
            const double beta = next / rho * (alpha / omega);
            if (!std::isfinite(beta)) return k + 1;
            rho = next;
            p_ = residual_ + beta * (p_ - omega * ap_);
        }
        return limit;
    }

  private:
    Vec residual_, shadow_, p_, preconditioned_, ap_, as_;  ///< of b; A p and A s are kept apart
};

}  // namespace talus
