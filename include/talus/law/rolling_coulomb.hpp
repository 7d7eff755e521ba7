// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/law/concepts.hpp>
#include <talus/law/rolling_block.hpp>
#include <talus/law/rolling_cone.hpp>

#include <string_view>

namespace talus {

/// Unilateral contact with Coulomb friction and rolling friction, in prospective form
/// [AcaryBourrier2021]:
///   u_n >= 0, r_n >= 0, u_n r_n = 0;
///   |r_t| <= mu r_n, and r_t = -mu r_n u_t / |u_t| if u_t != 0;
///   |r_m| <= mu_r r_n, and r_m = -mu_r r_n u_m / |u_m| if u_m != 0.
/// Local vectors have more rows than space has: 3 in the plane, (n, t, m), and 5 in space, (n, t1,
/// t2, m1, m2). The last ones of u are the relative spin about the tangents (about the normal of
/// the plane), those of r the moment impulses; spinning about the contact normal is free. A cone
/// with both pairs round. RollingBlock says which solution is taken where there are several.
///
/// In simulations of rigid bodies mu_r is a number [-]: contacts have rolling rows in the unit of
/// the others, by a length L of each, the effective radius of its bodies, 1 / L = 1 / R_a + 1 /
/// R_b [AiChenRotterOoi2011]. R is half the thickness of the shape (System::half_thickness): the
/// radius of balls and capsules; obstacles count as flat (1 / R = 0), whatever their shape. The
/// largest moment is mu_r L times the normal force, so a ball rests on slopes whose tangent is up
/// to mu_r, whatever its radius, and on steeper ones rolls with g (sin - mu_r cos) / (1 + I / (m
/// R^2)). Another L may be written into `rolling_length` of the Jacobian by a hook
/// (NoHooks::matrices_known): r, u and mu_r are then of that.
///
/// In problems given by matrices with rolling rows in rad/s and N m s, mu_r is the length by which
/// the normal force moves ahead in rolling [m]. These rows have other units than the first;
/// solutions do not mind, but the residual of a problem (ResidualMeasure), a sum over rows, does.
/// So give the rows one unit there too: spin times L [m/s], moment over L [N s], mu_r over L [-].
///
/// RollingCoulomb<3> is a law of the plane, not of space: RollingFriction<Dim> is that of a
/// dimension.
template <int Rows>
requires RollingRows<Rows>
struct RollingCoulomb {
    static constexpr bool rolling_rows = true, pushes_only = true;

    double mu = 0.0;    ///< friction coefficient [-], finite, not negative
    double mu_r = 0.0;  ///< of rolling friction [-], or [m] (see above), finite, not negative

    RollingBlock<Rows> prepare(const Matrix<Rows>& w) const { return RollingBlock<Rows>(w); }

    Vector<Rows> improved(const RollingBlock<Rows>& block, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return block.improved(mu, mu_r, u, r);
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>&) const {
        return RollingBlock<Rows>(p.W).solution(mu, mu_r, p.b);
    }
    /// P_K(r - rho (u + (mu |u_t| + mu_r |u_m|) n)): r is a fixed point iff it obeys the law.
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return RollingCone<Rows>{mu, mu_r}.project(r - rho * de_saxce_corrected<Rows>(u, mu, mu_r));
    }
    /// Throws input_error naming `item` unless mu and mu_r are finite and not negative.
    void require_valid(std::string_view item) const {
        require_non_negative(item, ".mu", mu);
        require_non_negative(item, ".mu_r", mu_r);
    }
};
TALUS_MODEL(PreparableLaw<RollingCoulomb<3>, 3>);
TALUS_MODEL(PreparableLaw<RollingCoulomb<5>, 5>);

/// Coulomb and rolling friction in the plane and in space: the Law of a Simulation<Dim>. Adaptors
/// of it are of rows_with_rolling<Dim> rows, as WeightedMean<rows_with_rolling<Dim>,
/// RollingFriction<Dim>>.
template <int Dim>
using RollingFriction = RollingCoulomb<rows_with_rolling<Dim>>;
TALUS_MODEL(BodyLaw<RollingFriction<2>, 2>);
TALUS_MODEL(BodyLaw<RollingFriction<3>, 3>);

}  // namespace talus
