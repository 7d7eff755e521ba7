// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/symmetric_eigen.hpp>
#include <talus/core/types.hpp>

#include <cmath>
#include <limits>

namespace talus {

/// The one-contact problem of Coulomb's law, u = W r + b, solved to rounding for any symmetric
/// positive semidefinite W. What depends on W alone is done on construction.
///
/// Selection rule, in this order (it decides between the solutions of the Painleve range
/// mu |W_tn| > W_nn, where there may be several [Klarbring1990]):
///   open   r = 0, if b_n >= 0;
///   stick  u = 0, if an impulse in the cone does that;
///   slip   u_n = 0, u_t = -alpha r_t with alpha > 0, |r_t| = mu r_n.
///
/// Slip. Eliminating u_n = 0 leaves  S = W_tt - W_tn W_nt / W_nn,  c = b_t - W_tn b_n / W_nn,
///   r_t(alpha) = -(S + alpha)^-1 c,   r_n(alpha) = -(b_n + W_nt r_t) / W_nn,
/// and one equation  h(alpha) = mu r_n / |r_t| - 1 = 0.  As 1 / |r_t| is nearly linear in alpha
/// (the secular equation of trust regions [MoreSorensen1983]), so is h: it is linear where S is a
/// multiple of the identity, always so in the plane. h is negative at alpha = 0 when sticking
/// fails and positive beyond a bound known in advance, so that Newton's method is kept in a
/// bracket.
///
/// No solution exists if W_nn = 0 and b_n < 0, and perhaps if W is singular and mu |W_tn| > W_nn:
/// then r is 0, or the impulse without friction, and the natural map shows it.
template <int Dim>
requires SpaceDimension<Dim>
class CoulombBlock {
  public:
    explicit CoulombBlock(const Matrix<Dim>& w);

    /// The new impulse from the velocity u = W r + b that the present impulse r leads to.
    Vector<Dim> improved(double mu, const Vector<Dim>& u, const Vector<Dim>& r) const {
        return diagonal() ? diagonal_solution(mu, u, r) : general_solution(mu, u - times(r));
    }
    /// The same without the short way for W = diag(W_nn, s, s): its oracle.
    Vector<Dim> general_solution(double mu, const Vector<Dim>& b) const;

    /// Whether W = diag(W_nn, s, s) to rounding, as for balls.
    bool diagonal() const { return tangent_inverse_ > 0.0; }

  private:
    using Tangent = SmallMatrix<Dim - 1, 1>;
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    Vector<Dim> diagonal_solution(double mu, const Vector<Dim>& u, const Vector<Dim>& r) const;
    bool stick(Tangent& c, double rounding, Tangent& r_t) const;
    double slip_root(double mu, double b_n, const Tangent& c) const;
    double normal_impulse(double b_n, const Tangent& r_t) const {
        return -(b_n + coupling_.dot(r_t)) * normal_inverse_;
    }
    /// W r, from the parts of W that are kept.
    Vector<Dim> times(const Vector<Dim>& r) const {
        const Tangent r_t = axes_.transpose() * tangential(r);
        const double coupled = coupling_.dot(r_t);
        const Tangent u_t =
            stiffness_.cwiseProduct(r_t) + coupling_ * (r[0] + coupled * normal_inverse_);
        return in_contact_axes(normal_ * r[0] + coupled, u_t);
    }
    Vector<Dim> in_contact_axes(double r_n, const Tangent& r_t) const {
        return in_local_frame(r_n, axes_ * r_t);
    }

    double normal_ = 0.0;                 ///< W_nn [1/kg]
    double normal_inverse_ = 0.0;         ///< 1 / W_nn [kg]; 0 where W_nn is 0 to rounding
    double tangent_inverse_ = 0.0;        ///< 1 / s [kg] if diagonal(), else 0
    Tangent stiffness_;                   ///< eigenvalues of S, ascending, rounding set to 0 [1/kg]
    Tangent coupling_;                    ///< W_tn in the eigenvectors of S [1/kg]
    SmallMatrix<Dim - 1, Dim - 1> axes_;  ///< eigenvectors of S, in columns
};

template <int Dim>
requires SpaceDimension<Dim> CoulombBlock<Dim>::CoulombBlock(const Matrix<Dim>& w)
    : normal_(w(0, 0)) {
    const double rounding = 8.0 * epsilon * w.trace();
    if (w(0, 0) > epsilon * w.trace()) normal_inverse_ = 1.0 / w(0, 0);
    Tangent w_tn;
    SmallMatrix<Dim - 1, Dim - 1> s;
    for (int i = 0; i < Dim - 1; ++i) w_tn[i] = w(i + 1, 0);
    for (int i = 0; i < Dim - 1; ++i)
        for (int j = 0; j < Dim - 1; ++j)
            s(i, j) = w(i + 1, j + 1) - w_tn[i] * (w_tn[j] * normal_inverse_);
    const SymmetricEigen<Dim - 1> eigen(s);
    axes_ = eigen.vectors;
    coupling_ = axes_.transpose() * w_tn;
    stiffness_ = eigen.values;
    // The elimination leaves errors of this size, of either sign.
    for (int i = 0; i < Dim - 1; ++i)
        if (!(stiffness_[i] > rounding)) stiffness_[i] = 0.0;
    const bool isotropic = stiffness_[Dim - 2] - stiffness_[0] <= rounding;
    if (isotropic) stiffness_.setConstant(stiffness_.sum() / (Dim - 1));
    if (isotropic && stiffness_[0] > 0.0 && normal_inverse_ > 0.0 && w_tn.norm() <= rounding)
        tangent_inverse_ = 1.0 / stiffness_[0];
}

template <int Dim>
requires SpaceDimension<Dim>
inline Vector<Dim> CoulombBlock<Dim>::diagonal_solution(double mu, const Vector<Dim>& u,
                                                        const Vector<Dim>& r) const {
    // By components: two tangents in one packed register cost more in shuffles than they save.
    Vector<Dim> result;
    double square = 0.0;
    for (int d = 1; d < Dim; ++d) {
        result[d] = r[d] - u[d] * tangent_inverse_;
        square += result[d] * result[d];
    }
    const double r_n = r[0] - u[0] * normal_inverse_;
    const bool open = r_n <= 0.0;
    const double limit = mu * r_n;
    double factor = square > limit * limit ? limit / std::sqrt(square) : 1.0;
    if (open) factor = 0.0;
    result[0] = open ? 0.0 : r_n;
    for (int d = 1; d < Dim; ++d) result[d] *= factor;
    return result;
}

template <int Dim>
requires SpaceDimension<Dim> Vector<Dim> CoulombBlock<Dim>::general_solution(double mu,
                                                                             const Vector<Dim>& b)
const {
    const double b_n = b[0];
    if (b_n >= 0.0 || normal_inverse_ == 0.0) return Vector<Dim>::Zero();
    const Tangent b_t = axes_.transpose() * tangential(b);
    const Tangent drag = coupling_ * (b_n * normal_inverse_);
    Tangent c = b_t - drag;
    Tangent r_t;
    if (stick(c, 16.0 * epsilon * (b_t.norm() + drag.norm()), r_t)) {
        const double r_n = normal_impulse(b_n, r_t);
        if (r_t.norm() <= mu * r_n) return in_contact_axes(r_n, r_t);
    }
    r_t.setZero();
    const double root = slip_root(mu, b_n, c);
    if (root > 0.0)
        for (int i = 0; i < Dim - 1; ++i) r_t[i] = -(c[i] / (stiffness_[i] - stiffness_[0] + root));
    const double r_n = normal_impulse(b_n, r_t);
    // The last ulps of the root, put right: the impulse must lie in the cone, not next to it.
    const double length = r_t.norm();
    if (length > 0.0) r_t *= mu * r_n / length;
    return in_contact_axes(r_n, r_t);
}

/// The r_t that makes u_t = 0, or false if there is none. Sets to zero what is rounding in c.
template <int Dim>
requires SpaceDimension<Dim>
bool CoulombBlock<Dim>::stick(Tangent& c, double rounding, Tangent& r_t) const {
    bool possible = true;
    for (int i = 0; i < Dim - 1; ++i) {
        if (stiffness_[i] > 0.0) {
            r_t[i] = -c[i] / stiffness_[i];
        } else {
            if (std::abs(c[i]) <= rounding) c[i] = 0.0;
            possible = possible && c[i] == 0.0;
            r_t[i] = 0.0;
        }
    }
    return possible;
}

/// The root of h, as a = alpha + smallest eigenvalue of S, the variable in which r_t keeps its
/// relative accuracy when S is singular. 0 if mu is 0 or there is none.
template <int Dim>
requires SpaceDimension<Dim>
double CoulombBlock<Dim>::slip_root(double mu, double b_n, const Tangent& c) const {
    const double scale = c.norm() / -b_n;
    const double direct = normal_ / mu - coupling_.dot(c) / c.norm();  // h is linear: its root
    if (!(mu > 0.0) || !std::isfinite(direct * scale)) return 0.0;
    const Tangent offset = stiffness_ - Tangent::Constant(stiffness_[0]);
    if (Tangent::SizeAtCompileTime == 1 || offset[Dim - 2] == 0.0) return direct * scale;

    double low = stiffness_[0];
    double high = (normal_ / mu + coupling_.norm()) * scale;
    // Limit of h at a = 0 where S is singular in a direction that c has a part in.
    if (low == 0.0 && c[0] != 0.0 && mu * coupling_[0] * c[0] >= std::abs(c[0]) * normal_)
        return 0.0;
    double a = direct * scale - 0.5 * offset[Dim - 2];
    constexpr int enough = 100;  // bisection of the exponent range would need 64
    for (int k = 0; k < enough; ++k) {
        if (!(a > low && a < high)) a = low > 0.0 ? std::sqrt(low * high) : 1e-3 * high;
        const Tangent shifted = offset + Tangent::Constant(a);
        const Tangent r_t = -c.cwiseQuotient(shifted);
        const Tangent slope_t = -r_t.cwiseQuotient(shifted);
        const double square = r_t.squaredNorm();
        const double r_n = normal_impulse(b_n, r_t);
        const double length = std::sqrt(square);
        const double h = mu * r_n / length - 1.0;
        const double slope =
            mu / length *
            (-coupling_.dot(slope_t) * normal_inverse_ - r_n * r_t.dot(slope_t) / square);
        (h < 0.0 ? low : high) = a;
        const double next = a - h / slope;
        if (std::abs(next - a) <= 2.0 * epsilon * a || high - low <= 2.0 * epsilon * high) break;
        a = next;
    }
    return a;
}

}  // namespace talus
