// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <cmath>
#include <concepts>

namespace talus {

/// A quaternion of someone else's, such as Eigen's.
template <class Q>
concept QuaternionLike = requires(const Q& q) {
    { q.w() } -> std::convertible_to<double>;  // the real part
    { q.x() } -> std::convertible_to<double>;  // those of i, j and k
    { q.y() } -> std::convertible_to<double>;
    { q.z() } -> std::convertible_to<double>;
};

/// The quaternion w + x i + y j + z k: what rotations of space are stored as. The operations are
/// those of Eigen's quaternion, with the additions in the order of its vector instructions, so that
/// both give the same bits (a compiler that fuses multiplications and additions may choose others).
class Quaternion {
  public:
    Quaternion() noexcept : Quaternion(1.0, 0.0, 0.0, 0.0) {}
    Quaternion(double w, double x, double y, double z) noexcept : c_(x, y, z, w) {}
    template <QuaternionLike Q>
    explicit Quaternion(const Q& q) : Quaternion(q.w(), q.x(), q.y(), q.z()) {}

    /// Of the rotation with this matrix [Shoemake1987].
    static Quaternion of_matrix(const Matrix<3>& m) {
        Quaternion q;
        const double trace = m(0, 0) + (m(1, 1) + m(2, 2));
        if (trace > 0.0) {
            const double twice_w = std::sqrt(trace + 1.0), f = 0.5 / twice_w;
            q.c_ = {(m(2, 1) - m(1, 2)) * f, (m(0, 2) - m(2, 0)) * f, (m(1, 0) - m(0, 1)) * f,
                    0.5 * twice_w};
            return q;
        }
        int i = m(1, 1) > m(0, 0) ? 1 : 0;  // the axis with the largest component
        if (m(2, 2) > m(i, i)) i = 2;
        const int j = (i + 1) % 3, k = (j + 1) % 3;
        const double twice = std::sqrt(m(i, i) - m(j, j) - m(k, k) + 1.0), f = 0.5 / twice;
        q.c_[i] = 0.5 * twice;
        q.c_[3] = (m(k, j) - m(j, k)) * f;
        q.c_[j] = (m(j, i) + m(i, j)) * f;
        q.c_[k] = (m(k, i) + m(i, k)) * f;
        return q;
    }

    double w() const { return c_[3]; }
    double x() const { return c_[0]; }
    double y() const { return c_[1]; }
    double z() const { return c_[2]; }
    Vector<3> imaginary() const { return {x(), y(), z()}; }
    /// (x, y, z, w), as Eigen has them.
    const Vector<4>& coeffs() const { return c_; }

    double norm() const { return std::sqrt(squared_norm()); }
    Quaternion normalized() const {
        const double square = squared_norm();
        Quaternion q = *this;
        if (square > 0.0) q.c_ /= std::sqrt(square);
        return q;
    }
    Quaternion conjugate() const { return {w(), -x(), -y(), -z()}; }
    Quaternion operator*(const Quaternion& o) const {
        return {(w() * o.w() - y() * o.y()) - (z() * o.z() + x() * o.x()),
                (w() * o.x() + y() * o.z()) - (z() * o.y() - x() * o.w()),
                (w() * o.y() + y() * o.w()) + (z() * o.x() - x() * o.z()),
                (w() * o.z() - y() * o.x()) + (z() * o.w() + x() * o.y())};
    }
    /// Of the rotation that a unit quaternion stands for.
    Matrix<3> matrix() const {
        const double tx = 2.0 * x(), ty = 2.0 * y(), tz = 2.0 * z();
        const double twx = tx * w(), twy = ty * w(), twz = tz * w();
        const double txx = tx * x(), txy = ty * x(), txz = tz * x();
        const double tyy = ty * y(), tyz = tz * y(), tzz = tz * z();
        Matrix<3> m;
        m.set_column(0, {1.0 - (tyy + tzz), txy + twz, txz - twy});
        m.set_column(1, {txy - twz, 1.0 - (txx + tzz), tyz + twx});
        m.set_column(2, {txz + twy, tyz - twx, 1.0 - (txx + tyy)});
        return m;
    }

    /// As a quaternion of another type, such as Eigen's, that is made of (w, x, y, z).
    template <QuaternionLike Q>
    requires std::constructible_from<Q, double, double, double, double>
    operator Q() const { return Q(w(), x(), y(), z()); }

  private:
    double squared_norm() const { return (x() * x() + z() * z()) + (y() * y() + w() * w()); }

    Vector<4> c_;
};

}  // namespace talus
