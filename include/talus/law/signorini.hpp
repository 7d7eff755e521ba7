// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/law/concepts.hpp>
#include <talus/law/friction_cone.hpp>

#include <algorithm>

namespace talus {

/// Unilateral contact without friction, in prospective form [Moreau, (6)(7)]:
///   u_n >= 0,  r_n >= 0,  u_n r_n = 0,  r_t = 0.
/// One solution, r_n = max(0, -b_n / W_nn); none when W_nn = 0 and b_n < 0, where `solve` gives 0.
template <int Rows>
requires ContactRows<Rows>
struct Signorini {
    /// What of W the law needs: its first row, as the present tangential impulse goes to zero too.
    struct NormalRow {
        double inverse;    ///< 1 / W_nn [kg]; 0 where W_nn = 0
        Vector<Rows> row;  ///< (W_nn, W_nt) / W_nn [-]; 0 where W_nn = 0
    };

    NormalRow prepare(const Matrix<Rows>& w) const {
        const double inverse = w(0, 0) > 0.0 ? 1.0 / w(0, 0) : 0.0;
        NormalRow row{inverse, {}};
        for (int j = 0; j < Rows; ++j) row.row[j] = inverse * w(0, j);
        return row;
    }
    Vector<Rows> improved(const NormalRow& w, const Vector<Rows>& u, const Vector<Rows>& r) const {
        Vector<Rows> result = Vector<Rows>::Zero();
        if (w.inverse > 0.0) result[0] = std::max(0.0, w.row.dot(r) - w.inverse * u[0]);
        return result;
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>&) const {
        return improved(prepare(p.W), p.b, Vector<Rows>::Zero());
    }
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        Vector<Rows> result = Vector<Rows>::Zero();
        result[0] = std::max(0.0, r[0] - rho * u[0]);
        return result;
    }
    auto friction_cone() const requires SpaceDimension<Rows> { return FrictionCone<Rows>{0.0}; }
};
TALUS_MODEL(PreparableLaw<Signorini<2>, 2>);
TALUS_MODEL(PreparableLaw<Signorini<3>, 3>);

}  // namespace talus
