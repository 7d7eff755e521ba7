// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/law/prepared.hpp>

#include <optional>
#include <string_view>

namespace talus {

/// `Law` applied to a weighted mean of the relative velocities at begin and end of the step,
/// (1 - theta) u_begin + theta u_end, with weights of their own for the normal and the tangential
/// part [Moreau, section 3]. Restitution e and weight are tied by theta = 1 / (1 + e), e in [0, 1].
///
/// For a law that looks at the sign of u_n and the direction of u_t only, the mean may be divided
/// by theta: it is the law on u_end + (e_n u_n_begin, e_t u_t_begin). Hence the adaptor does
/// nothing but name that shift, which assembly adds once per step, and forwards the rest. With e_n
/// != e_t the mean is scaled apart in n and t; it still vanishes, opens and has its direction where
/// the shifted velocity does. Different e_n and e_t can create energy [KaneLevinson1985]: a
/// property of the law.
template <int Rows, LawWithoutRestitution<Rows> Law>
struct WeightedMean {
    static constexpr bool rolling_rows = has_rolling_rows<Law>;
    static constexpr bool pushes_only = talus::pushes_only<Law>;

    Law law;                              ///< the relation obeyed by the mean velocity
    double restitution_normal = 0.0;      ///< e_n [-], in [0, 1]; 0 is soft, 1 bounces back
    double restitution_tangential = 0.0;  ///< e_t [-], in [0, 1]

    Vector<Rows> restitution_shift(const Vector<Rows>& u_begin) const {
        Vector<Rows> shift = restitution_tangential * u_begin;
        shift[0] = restitution_normal * u_begin[0];
        return shift;
    }
    Prepared<Law, Rows> prepare(const Matrix<Rows>& w) const {
        return talus::prepare<Rows>(law, w);
    }
    Vector<Rows> improved(const Prepared<Law, Rows>& prepared, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return talus::improved<Rows>(law, prepared, u, r);
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>& r) const {
        return law.solve(p, r);
    }
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return law.natural_map(u, r, rho);
    }
    double steep_error(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return talus::steep_error<Rows>(law, u, r, rho);
    }
    /// That of `law`: the restitution shift is in the free velocity.
    auto friction_cone() const requires SpaceDimension<Rows> { return cone_of<Rows>(law); }
    /// Throws input_error naming `item` unless both restitutions lie in [0, 1] and `law` is valid.
    void require_valid(std::string_view item) const {
        require_in(item, ".restitution_normal", restitution_normal, 0.0, 1.0);
        require_in(item, ".restitution_tangential", restitution_tangential, 0.0, 1.0);
        if constexpr (requires { law.require_valid(item); }) law.require_valid(item);
    }
};

}  // namespace talus
