// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/law/signorini.hpp>
#include <talus/solver/cones/cone_system.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// Looks for a proof that no impulses keep the contacts of a problem from closing: normal impulses
/// l >= 0 that move nothing, W (l n) = 0, and yet meet a free velocity with l . u_free < 0. Then
/// sum l_c u_n,c = sum l_c u_free,c < 0 whatever the impulses are, so some contact must close, and
/// no solution exists (Farkas' lemma). W (l n) vanishes to rounding: a solution, if any, has
/// impulses 1e9 times those that would stop u_free. Where nothing can separate the contacts,
/// iterations without friction run away along such an l.
///
/// No proof found does not mean that there is none. The system given must be that of the problem;
/// its friction plays no part in `by_sweeps`.
template <int Dim>
class OverlapCertificate {
  public:
    using System = ConeSystem<Dim>;

    /// From 64 sweeps without friction.
    template <class W>
    bool by_sweeps(W& w, std::span<const Vector<Dim>> free_velocity, const System& system) {
        const std::size_t n = w.contact_count();
        laws_.assign(n, Signorini<Dim>{});
        r_.assign(n, Vector<Dim>::Zero());
        constexpr int sweeps = 32;
        gauss_seidel_.params = {.max_sweeps = sweeps, .tolerance = 0.0};
        // Along such an l impulses grow by the same amount in every sweep, while all that can
        // settle settles: the growth of the second half is l.
        gauss_seidel_.solve(w, free_velocity, std::span<const Signorini<Dim>>(laws_), r_);
        before_ = r_;
        gauss_seidel_.solve(w, free_velocity, std::span<const Signorini<Dim>>(laws_), r_);
        for (std::size_t i = 0; i < n; ++i) {
            const double growth = r_[i][0] - before_[i][0];
            r_[i] = std::max(growth, 0.0) * Vector<Dim>::Unit(0);
            // Between obstacles every impulse moves nothing.
            if (w.diagonal_block(i).isZero(0.0) && free_velocity[i][0] < 0.0) return true;
        }
        system.to_scaled(r_, l_);
        return holds(l_, system);
    }
    /// From some steps of Newton's method, an engine with `improve`, also where sweeps take too
    /// long. `system` must be without friction.
    template <class Newton>
    bool by_newton(Newton& newton, System& system, int steps = 30) {
        const Eigen::VectorXd& q = system.free_velocity();
        l_ = Eigen::VectorXd::Zero(q.size());
        newton.params = {.max_iterations = steps, .tolerance = 0.0};
        newton.improve(system, l_, system.residual(l_, q));
        for (std::size_t c = 0; c < system.contact_count(); ++c) {
            const double l_n = std::max(l_[System::first(c)], 0.0);
            l_.template segment<Dim>(System::first(c)) = l_n * Vector<Dim>::Unit(0);
        }
        return holds(l_, system);
    }
    /// Whether scaled normal impulses l are a proof.
    bool holds(const Eigen::VectorXd& l, const System& system) {
        // Two numbers without units: how little l moves, and how clearly it meets the velocity.
        system.multiply(l, u_);
        constexpr double rounding = 1e-9, clear = 1e-6;
        const double size = l.norm();
        const double speed = system.free_velocity().template lpNorm<Eigen::Infinity>();
        return size > 0.0 && u_.norm() <= rounding * size &&
               l.dot(system.free_velocity()) < -clear * size * speed;
    }

  private:
    GaussSeidel<Dim, Signorini<Dim>> gauss_seidel_;
    std::vector<Signorini<Dim>> laws_;
    std::vector<Vector<Dim>> r_, before_;
    Eigen::VectorXd l_, u_;
};

}  // namespace talus
