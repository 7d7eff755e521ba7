// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/prepared.hpp>

#include <string_view>

namespace talus {

/// `Law` obeyed by r + c n instead of r: contacts that hold up to a tensile impulse c. With
/// Coulomb's law, on the cone shifted down the normal [RadjaiRichefeu2009]:
///   u_n >= 0,  r_n >= -c,  u_n (r_n + c) = 0;  |r_t| <= mu (r_n + c), against sliding.
/// Friction thus holds |r_t| <= mu c without any load. Exact: as u = W r + b = W (r + c n) + (b - c
/// W n), the velocity is the same in both variables and the contact's problem is `Law`'s own.
///
/// Laws do not know the step size: c is the cohesion *force* times h, to be set again when h
/// changes.
///
/// What an opening contact does. u_n > 0 implies r = -c n, not 0: cohesion pulls throughout every
/// step whose contact set has the pair in it, be it parting, and no more once the gap takes it out
/// of the set. So a pair pulled harder than c leaves with the velocity that the surplus gives it,
/// and is free from the next step whose midpoint finds it apart; the contact tolerance is the range
/// of the attraction, and the work lost in breaking goes to zero with h. A pair that meets again
/// is cohesive again: a capillary bridge or van der Waals attraction. A bond that breaks for
/// good needs a memory, which a law has not: set `cohesion` to 0 in the contacts of broken pairs
/// once `problem.laws` of the step is known (NoHooks::problem_known), which is also the place to
/// write h times a force.
template <int Rows, ContactLaw<Rows> Law>
struct Cohesive {
    static constexpr bool rolling_rows = has_rolling_rows<Law>;

    Law law;                ///< the relation obeyed by r + c n
    double cohesion = 0.0;  ///< c [N s], finite, not negative: cohesion force times h

    Prepared<Law, Rows> prepare(const Matrix<Rows>& w) const {
        return talus::prepare<Rows>(law, w);
    }
    Vector<Rows> improved(const Prepared<Law, Rows>& prepared, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return lowered(talus::improved<Rows>(law, prepared, u, raised(r)));
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>& r) const {
        return lowered(law.solve({p.W, p.b - cohesion * p.W.col(0)}, raised(r)));
    }
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return lowered(law.natural_map(u, raised(r), rho));
    }
    double steep_error(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return talus::steep_error<Rows>(law, u, raised(r), rho);
    }
    /// That of `law`, where it has one: restitution shifts velocities, cohesion impulses.
    Vector<Rows> restitution_shift(const Vector<Rows>& u_begin) const requires
        RestitutionLaw<Law, Rows> {
        return law.restitution_shift(u_begin);
    }
    /// Throws input_error naming `item` unless c is finite and not negative and `law` is valid.
    void require_valid(std::string_view item) const {
        require_non_negative(item, ".cohesion", cohesion);
        if constexpr (requires { law.require_valid(item); }) law.require_valid(item);
    }

  private:
    Vector<Rows> raised(Vector<Rows> r) const {
        r[0] += cohesion;
        return r;
    }
    Vector<Rows> lowered(Vector<Rows> r) const {
        r[0] -= cohesion;
        return r;
    }
};

/// Cohesion and Coulomb friction: Cohesive<Dim, Coulomb<Dim>>, `{{mu}, c}`.
template <int Dim>
using CohesiveCoulomb = Cohesive<Dim, Coulomb<Dim>>;
TALUS_MODEL(PreparableLaw<CohesiveCoulomb<2>, 2>);
TALUS_MODEL(PreparableLaw<CohesiveCoulomb<3>, 3>);
TALUS_MODEL(!RestitutionLaw<CohesiveCoulomb<3>, 3>);

}  // namespace talus
