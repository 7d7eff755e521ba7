// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/symmetric_eigen.hpp>
#include <talus/law/bracketed_root.hpp>
#include <talus/law/rolling_cone.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

/// The one-contact problem of sliding and rolling friction, u = W r + b, solved to rounding for any
/// symmetric positive semidefinite W. What depends on W alone is done on construction.
///
/// Selection rule, in this order (it decides where there are several solutions, as in the Painleve
/// range of Coulomb's law):
///   open   r = 0, if b_n >= 0;
///   stick  u = 0, if the impulse of least norm that does that lies in the cone;
///   slip   u_n = 0, sliding or rolling or both, with the r_n that the search below meets first.
///
/// Slip. For a given r_n = s the tangential and the rolling part q = (r_t, r_m) are those of least
///   q W_qq q / 2 + (b_q + W_qn s) q   in the disks |r_t| <= mu s, |r_m| <= mu_r s:
/// maximum dissipation, a convex problem that always has an answer. With it u_n is a continuous
/// function of s, negative at 0, and one equation is left, u_n(s) = 0. It has a root for every
/// positive definite W and any friction: for large s, u_n / s goes to W_nn + W_nq z >= (1, z) W (1,
/// z), z = q / s (compare the minimiser z with 0). For balls W_nq = 0 and s = -b_n / W_nn at once.
///
/// The disks. With a multiplier a for the second one, r_m = -(W_mm + a)^-1 (f_m + W_mt r_t) is
/// eliminated; what is left is one disk, a trust region problem [MoreSorensen1983]. |r_m| falls
/// with a, and 1 / |r_m| is nearly linear in it. Where W_qq is singular and many q are minimal,
/// |r_m| may jump over the radius: then the answer lies between the q of both sides.
///
/// Rolling rows may have units of their own: they are first measured in the length, a power of two,
/// that makes W_mm as large as W_tt, so that what counts as rounding does not depend on units.
///
/// No solution exists if W_nn = 0 and b_n < 0, and perhaps if W is singular and mu |W_tn| + mu_r
/// |W_mn| > W_nn: then r is 0, or the impulse without friction, and the natural map shows it.
template <int Rows>
requires RollingRows<Rows>
class RollingBlock {
  public:
    explicit RollingBlock(const Matrix<Rows>& w);

    /// The impulse from the velocity b without it.
    Vector<Rows> solution(double mu, double mu_r, const Vector<Rows>& b) const {
        return rescaled(scaled_solution(mu, mu_r / length_, rescaled(b)));
    }
    /// The new impulse from the velocity u = W r + b that the present impulse r leads to.
    Vector<Rows> improved(double mu, double mu_r, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return rescaled(scaled_solution(mu, mu_r / length_, rescaled(u) - w_ * unscaled(r)));
    }

  private:
    static constexpr int T = tangent_count<Rows>;
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();
    using Part = Vector<T>;  ///< tangential, or rolling
    using PartMatrix = Matrix<T>;

    /// Spins times the length, moments over it: u and r as the members below have them, and back.
    Vector<Rows> rescaled(Vector<Rows> x) const {
        x.template tail<T>() *= length_;
        return x;
    }
    Vector<Rows> unscaled(Vector<Rows> x) const {
        x.template tail<T>() /= length_;
        return x;
    }
    Vector<Rows> scaled_solution(double mu, double mu_r, const Vector<Rows>& b) const;
    bool stick(const Vector<Rows>& b, Vector<Rows>& r) const;
    Vector<Rows> dragged(double s, double mu, double mu_r, const Vector<Rows>& b) const;
    bool held_by(double a, const Part& f_t, const Part& f_m, double disk_t, Part& r_t,
                 Part& r_m) const;
    static double entry(const Part& x, const Part& d, double radius);
    static Part in_disk(const PartMatrix& w, Part f, double flat, double rounding, double radius);

    double length_ = 1.0;      ///< unit of the rolling rows
    Matrix<Rows> w_;           ///< symmetric [1/kg]
    Matrix<Rows> axes_;        ///< eigenvectors of W, in columns
    Vector<Rows> inverse_;     ///< of its eigenvalues [kg]; 0 for those that are 0 to rounding
    PartMatrix rolling_axes_;  ///< eigenvectors of W_mm
    Part rolling_;             ///< eigenvalues of W_mm, ascending, rounding set to 0
    PartMatrix coupling_;      ///< W_tm in the eigenvectors of W_mm
};

template <int Rows>
requires RollingRows<Rows> RollingBlock<Rows>::RollingBlock(const Matrix<Rows>& w) : w_(w) {
    const double ratio =
        w.diagonal().template segment<T>(1).sum() / w.diagonal().template tail<T>().sum();
    if (ratio > 0.0 && std::isfinite(ratio))
        length_ = std::exp2(std::round(0.5 * std::log2(ratio)));
    w_.template rightCols<T>() *= length_;
    w_.template bottomRows<T>() *= length_;
    const double rounding = 8.0 * epsilon * w_.trace();
    const SymmetricEigen<Rows> all(w_);
    axes_ = all.vectors;
    for (int i = 0; i < Rows; ++i)
        inverse_[i] = all.values[i] > rounding ? 1.0 / all.values[i] : 0.0;
    const SymmetricEigen<T> rolling(w_.template bottomRightCorner<T, T>());
    rolling_axes_ = rolling.vectors;
    rolling_ = rolling.values;
    const double flat = 8.0 * epsilon * rolling_.sum();
    for (double& stiffness : rolling_)
        if (!(stiffness > flat)) stiffness = 0.0;
    coupling_ = w_.template block<T, T>(1, 1 + T) * rolling_axes_;
}

template <int Rows>
requires RollingRows<Rows> Vector<Rows> RollingBlock<Rows>::scaled_solution(double mu, double mu_r,
                                                                            const Vector<Rows>& b)
const {
    if (b[0] >= 0.0 || w_(0, 0) <= epsilon * w_.trace()) return Vector<Rows>::Zero();
    Vector<Rows> r;
    if (stick(b, r) && RollingCone<Rows>{mu, mu_r}.contains(r)) return r;

    const auto normal_velocity = [&](double s) {
        r = dragged(s, mu, mu_r, b);
        return w_.row(0).dot(r) + b[0];
    };
    const double frictionless = -b[0] / w_(0, 0);
    Sample low{0.0, b[0]}, high{frictionless, normal_velocity(frictionless)};
    if (std::abs(high.f) <= 2.0 * epsilon * -b[0]) return r;
    constexpr int enough = 60;  // doublings: beyond 1e18 nothing is left of W_nn
    for (int k = 0; k < enough && high.f < 0.0; ++k) {
        low = high;
        high.x *= 2.0;
        high.f = normal_velocity(high.x);
    }
    if (high.f < 0.0) return frictionless * Vector<Rows>::Unit(0);
    return dragged(bracketed_root(normal_velocity, low, high).best().x, mu, mu_r, b);
}

/// The r of least norm that makes u = 0, or false if there is none.
template <int Rows>
requires RollingRows<Rows>
bool RollingBlock<Rows>::stick(const Vector<Rows>& b, Vector<Rows>& r) const {
    const Vector<Rows> parts = axes_.transpose() * b;
    for (int i = 0; i < Rows; ++i)
        if (inverse_[i] == 0.0 && std::abs(parts[i]) > 16.0 * epsilon * b.norm()) return false;
    r = -(axes_ * inverse_.cwiseProduct(parts));
    return true;
}

/// The impulse with r_n = s and the friction that belongs to it.
template <int Rows>
requires RollingRows<Rows> Vector<Rows> RollingBlock<Rows>::dragged(double s, double mu,
                                                                    double mu_r,
                                                                    const Vector<Rows>& b)
const {
    const Vector<Rows> f = b + s * w_.col(0);
    const Part f_t = f.template segment<T>(1);
    const Part f_m = rolling_axes_.transpose() * f.template tail<T>();
    const double disk_t = mu * s, disk_m = mu_r * s;
    Part r_t, r_m;
    const auto excess = [&](double a) {  // of the disk over |r_m|, near linear in a
        if (!held_by(a, f_t, f_m, disk_t, r_t, r_m)) return -1.0;
        const double length = r_m.norm();
        return length > 0.0 ? disk_m / length - 1.0 : 1.0;
    };
    Sample low{0.0, -1.0};
    if (disk_m == 0.0)
        held_by(INFINITY, f_t, f_m, disk_t, r_t, r_m);
    else if ((low.f = excess(0.0)) < 0.0) {
        // Here |r_m| <= |f_m + W_mt r_t| / a is in the disk.
        const double bound = (f_m.norm() + coupling_.norm() * disk_t) / disk_m;
        const Sample high{bound, excess(bound)};
        if (high.f > 0.0) {
            const Bracket root = bracketed_root(excess, low, high);
            const bool met = std::abs(root.best().f) <= 4.0 * epsilon;
            excess((met ? root.best() : root.negative()).x);
            if (!met) {  // where several q are minimal the disk's edge lies between two of them
                const Part out_t = r_t, out_m = r_m;
                excess(root.positive().x);
                const double part = entry(out_m, r_m - out_m, disk_m);
                r_t = out_t + part * (r_t - out_t);
                r_m = out_m + part * (r_m - out_m);
            }
        }
        const double length = r_m.norm();
        if (length > 0.0) r_m *= disk_m / length;
    }
    Vector<Rows> r;
    r[0] = s;
    r.template segment<T>(1) = r_t;
    r.template tail<T>() = rolling_axes_ * r_m;
    return r;
}

/// r_t in its disk, and the r_m that the multiplier a of its own leaves; false if that is infinite.
template <int Rows>
requires RollingRows<Rows>
bool RollingBlock<Rows>::held_by(double a, const Part& f_t, const Part& f_m, double disk_t,
                                 Part& r_t, Part& r_m) const {
    Part mobility = Part::Zero();
    for (int i = 0; i < T; ++i)
        if (rolling_[i] + a > 0.0) mobility[i] = 1.0 / (rolling_[i] + a);
    PartMatrix back = coupling_;
    for (int i = 0; i < T; ++i) back.col(i) *= mobility[i];
    const Part drag = back * f_m;
    const PartMatrix w_tt = w_.template block<T, T>(1, 1);
    r_t = in_disk(w_tt - back * coupling_.transpose(), f_t - drag, 8.0 * epsilon * w_tt.trace(),
                  16.0 * epsilon * (f_t.norm() + drag.norm()), disk_t);
    const Part u_m = f_m + coupling_.transpose() * r_t;
    const double rounding = 16.0 * epsilon * (f_m.norm() + coupling_.norm() * r_t.norm());
    r_m = -mobility.cwiseProduct(u_m);
    for (int i = 0; i < T; ++i)
        if (mobility[i] == 0.0 && std::isfinite(a) && std::abs(u_m[i]) > rounding) return false;
    return true;
}

/// The least t in [0, 1] with |x + t d| = radius, from outside inwards; 1 if there is none.
template <int Rows>
requires RollingRows<Rows>
double RollingBlock<Rows>::entry(const Part& x, const Part& d, double radius) {
    const double inwards = -x.dot(d), length = x.norm();
    const double outside = (length - radius) * (length + radius);
    if (!(outside > 0.0)) return 1.0;
    const double root = std::sqrt(std::max(0.0, inwards * inwards - d.squaredNorm() * outside));
    return outside < inwards + root ? outside / (inwards + root) : 1.0;
}

/// The q with |q| <= radius of least q w q / 2 + f q. Stiffness below `flat` counts as 0, and
/// there what in f is below `rounding`.
template <int Rows>
requires RollingRows<Rows>
typename RollingBlock<Rows>::Part RollingBlock<Rows>::in_disk(const PartMatrix& w, Part f,
                                                              double flat, double rounding,
                                                              double radius) {
    if (!(radius > 0.0)) return Part::Zero();
    const SymmetricEigen<T> eigen(w);
    const PartMatrix& axes = eigen.vectors;
    Part stiffness = eigen.values;
    for (double& s : stiffness)
        if (!(s > flat)) s = 0.0;
    f = axes.transpose() * f;
    for (int i = 0; i < T; ++i)
        if (stiffness[i] == 0.0 && std::abs(f[i]) <= rounding) f[i] = 0.0;
    // No component may leave the disk by itself: a lower bound, from where Newton's method on
    // 1 / |q| climbs to the multiplier and stays below it.
    double a = 0.0;
    for (int i = 0; i < T; ++i) a = std::max(a, std::abs(f[i]) / radius - stiffness[i]);
    Part q;
    constexpr int enough = 100;
    for (int k = 0; k < enough; ++k) {
        double curvature = 0.0;
        for (int i = 0; i < T; ++i) {
            q[i] = f[i] == 0.0 ? 0.0 : -f[i] / (stiffness[i] + a);
            if (q[i] != 0.0) curvature += q[i] * q[i] / (stiffness[i] + a);
        }
        const double length = q.norm();
        if (length <= radius) break;
        const double step = (length / radius - 1.0) * length * length / curvature;
        if (!(step > epsilon * a)) break;
        a += step;
    }
    const double length = q.norm();
    if (a > 0.0 && length > 0.0) q *= radius / length;
    return axes * q;
}

}  // namespace talus
