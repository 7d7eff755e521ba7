// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/law/concepts.hpp>
#include <talus/law/coulomb_block.hpp>
#include <talus/law/friction_cone.hpp>

#include <string_view>

namespace talus {

/// Unilateral contact with isotropic Coulomb friction, in prospective form [Moreau, (6)(7)(8)]:
///   u_n >= 0, r_n >= 0, u_n r_n = 0;  |r_t| <= mu r_n, and r_t = -mu r_n u_t / |u_t| if u_t != 0.
/// The cone is the round one. One solution whatever b if mu |W_tn| < W_nn; CoulombBlock says which
/// one is taken otherwise.
template <int Dim>
requires SpaceDimension<Dim>
struct Coulomb {
    static constexpr bool pushes_only = true;

    double mu = 0.0;  ///< friction coefficient [-], finite, not negative

    CoulombBlock<Dim> prepare(const Matrix<Dim>& w) const { return CoulombBlock<Dim>(w); }

    Vector<Dim> improved(const CoulombBlock<Dim>& block, const Vector<Dim>& u,
                         const Vector<Dim>& r) const {
        return block.improved(mu, u, r);
    }
    Vector<Dim> solve(const LocalProblem<Dim>& p, const Vector<Dim>&) const {
        return CoulombBlock<Dim>(p.W).general_solution(mu, p.b);
    }
    /// P_K(r - rho (u + mu |u_t| n)): r is a fixed point iff it obeys the law [DeSaxceFeng1998].
    Vector<Dim> natural_map(const Vector<Dim>& u, const Vector<Dim>& r, double rho) const {
        return FrictionCone<Dim>{mu}.project(r - rho * de_saxce_corrected<Dim>(u, mu));
    }
    double steep_error(const Vector<Dim>& u, const Vector<Dim>& r, double rho) const {
        return friction_cone().steep_error(u, r, rho);
    }
    FrictionCone<Dim> friction_cone() const { return {mu}; }
    /// Throws input_error naming `item` unless mu is finite and not negative.
    void require_valid(std::string_view item) const { require_non_negative(item, ".mu", mu); }
};
TALUS_MODEL(PreparableLaw<Coulomb<2>, 2>);
TALUS_MODEL(PreparableLaw<Coulomb<3>, 3>);

}  // namespace talus
