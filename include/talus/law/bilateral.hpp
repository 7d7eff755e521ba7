// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/core/symmetric_eigen.hpp>
#include <talus/law/concepts.hpp>

#include <limits>

namespace talus {

/// A pin: u = 0, any r. The one relation of this folder that can pull; it is no contact.
/// Where W is singular the impulse of least norm is taken; when b has a part outside the range of W
/// no impulse can cancel it, and the natural map shows it.
template <int Rows>
requires ContactRows<Rows>
struct Bilateral {
    /// The block and its spectral decomposition. The pseudo-inverse is applied factor by factor:
    /// multiplied out it would lose the digits that an ill-conditioned W leaves.
    struct PinBlock {
        Matrix<Rows> W;        ///< [1/kg]
        Matrix<Rows> axes;     ///< eigenvectors, in columns
        Vector<Rows> inverse;  ///< of the eigenvalues [kg]; 0 for those that are 0 to rounding

        Vector<Rows> pseudo_solve(const Vector<Rows>& x) const {
            return axes * inverse.cwiseProduct(axes.transpose() * x);
        }
    };

    PinBlock prepare(const Matrix<Rows>& w) const {
        const SymmetricEigen<Rows> eigen(w);
        // Eigenvalues are known to a few ulps of the largest: below that, zero is as likely.
        const double rounding =
            8.0 * std::numeric_limits<double>::epsilon() * eigen.values.cwiseAbs().maxCoeff();
        PinBlock block{w, eigen.vectors, Vector<Rows>::Zero()};
        for (int i = 0; i < Rows; ++i)
            if (eigen.values[i] > rounding) block.inverse[i] = 1.0 / eigen.values[i];
        return block;
    }
    Vector<Rows> improved(const PinBlock& block, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return block.pseudo_solve(block.W * r - u);
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>&) const {
        return -prepare(p.W).pseudo_solve(p.b);
    }
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return r - rho * u;
    }
};
TALUS_MODEL(PreparableLaw<Bilateral<2>, 2>);
TALUS_MODEL(PreparableLaw<Bilateral<3>, 3>);

}  // namespace talus
