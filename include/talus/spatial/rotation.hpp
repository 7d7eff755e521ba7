// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/core/types.hpp>
#include <talus/spatial/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace talus {

/// A rotation of space: a unit complex number in the plane, a unit quaternion in space.
/// Supplied: identity, exp, log, product, inverse, action on vectors, matrix, normalized. (Written
/// as templates, so that programs of the plane have none of space compiled.)
template <int Dim>
requires SpaceDimension<Dim>
class Rotation;

/// Rotation of the plane, stored as (cos, sin).
template <int Dim>
requires SpaceDimension<Dim> &&(Dim == 2) class Rotation<Dim> {
  public:
    Rotation() noexcept = default;
    explicit Rotation(double angle) : c_(std::cos(angle)), s_(std::sin(angle)) {}  ///< [rad]

    static Rotation identity() { return {}; }
    /// Rotation reached in unit time at constant `spin` [rad].
    static Rotation exp(const AngularVector<2>& spin) { return Rotation(spin[0]); }
    /// Rotation with the given matrix (assumed orthonormal, determinant 1).
    static Rotation from_matrix(const Matrix<2>& m) { return Rotation(m(0, 0), m(1, 0)); }

    double angle() const { return std::atan2(s_, c_); }  ///< in (-pi, pi] [rad]
    AngularVector<2> log() const { return AngularVector<2>(angle()); }
    Rotation inverse() const { return Rotation(c_, -s_); }
    Matrix<2> matrix() const { return (Matrix<2>() << c_, -s_, s_, c_).finished(); }

    Vector<2> operator*(const Vector<2>& v) const {
        return {c_ * v[0] - s_ * v[1], s_ * v[0] + c_ * v[1]};
    }
    /// Inverse rotation of a vector, without forming the inverse.
    Vector<2> transpose_times(const Vector<2>& v) const {
        return {c_ * v[0] + s_ * v[1], c_ * v[1] - s_ * v[0]};
    }
    /// Spin in world axes from spin in body axes: the same number in the plane.
    AngularVector<2> spin_world(const AngularVector<2>& body) const { return body; }
    AngularVector<2> spin_body(const AngularVector<2>& world) const { return world; }

    Rotation operator*(const Rotation& o) const {
        return Rotation(c_ * o.c_ - s_ * o.s_, s_ * o.c_ + c_ * o.s_);
    }
    /// Distance to another rotation: a bound of |R v - R' v| over unit vectors v [-].
    double distance(const Rotation& o) const { return std::hypot(c_ - o.c_, s_ - o.s_); }
    Rotation normalized() const {
        const double n = std::sqrt(c_ * c_ + s_ * s_);
        return Rotation(c_ / n, s_ / n);
    }

    void write(NumberRecord& out) const {
        out.real(c_);
        out.real(s_);
    }
    static Rotation read(NumberRecordReader& in) {
        const double c = in.real(), s = in.real();
        require_unit("rotation", std::hypot(c, s));
        return Rotation(c, s);
    }

  private:
    Rotation(double c, double s) : c_(c), s_(s) {}
    double c_ = 1.0;
    double s_ = 0.0;
};

/// Rotation of space, stored as a unit quaternion.
template <int Dim>
requires SpaceDimension<Dim> &&(Dim == 3) class Rotation<Dim> {
  public:
    Rotation() noexcept = default;
    explicit Rotation(const Quaternion& q) : q_(q.normalized()) {}
    /// From a quaternion of someone else's, such as Eigen's.
    template <QuaternionLike Q>
    explicit Rotation(const Q& q) : Rotation(Quaternion(q)) {}

    static Rotation identity() { return {}; }
    /// Rotation reached in unit time at constant `spin`: turns by |spin| [rad] about it.
    static Rotation exp(const AngularVector<3>& spin) {
        const double angle = spin.norm();
        // sin(x/2)/x, by its series where the quotient loses digits: the next term is below 1e-17.
        const double s = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
        Rotation r;
        r.q_ = {std::cos(0.5 * angle), s * spin[0], s * spin[1], s * spin[2]};
        return r;
    }
    /// Rotation with the given matrix (assumed orthonormal, determinant 1).
    static Rotation from_matrix(const Matrix<3>& m) { return Rotation(Quaternion::of_matrix(m)); }

    /// The shortest spin whose `exp` is this rotation [rad].
    AngularVector<3> log() const {
        const double sign = q_.w() < 0.0 ? -1.0 : 1.0;
        const double s = axis().norm();
        const double half = std::atan2(s, sign * q_.w());
        return (s > 0.0 ? 2.0 * half / s : 2.0) * sign * axis();
    }
    const Quaternion& quaternion() const { return q_; }
    Rotation inverse() const {
        Rotation r;
        r.q_ = q_.conjugate();
        return r;
    }
    Matrix<3> matrix() const { return q_.matrix(); }

    Vector<3> operator*(const Vector<3>& v) const { return turned(axis(), v); }
    /// Inverse rotation of a vector, without forming the inverse.
    Vector<3> transpose_times(const Vector<3>& v) const { return turned(-axis(), v); }
    /// Spin in world axes from spin in body axes, and back.
    AngularVector<3> spin_world(const AngularVector<3>& body) const { return *this * body; }
    AngularVector<3> spin_body(const AngularVector<3>& world) const {
        return transpose_times(world);
    }

    Rotation operator*(const Rotation& o) const {
        Rotation r;
        r.q_ = q_ * o.q_;
        return r;
    }
    /// Distance to another rotation: a bound of |R v - R' v| over unit vectors v [-].
    double distance(const Rotation& o) const {
        const double w = o.q_.w();
        return 2.0 *
               std::sqrt(std::min((axis() - o.axis()).squaredNorm() + (q_.w() - w) * (q_.w() - w),
                                  (axis() + o.axis()).squaredNorm() + (q_.w() + w) * (q_.w() + w)));
    }
    Rotation normalized() const { return Rotation(q_); }

    void write(NumberRecord& out) const { out.array(q_.coeffs()); }
    static Rotation read(NumberRecordReader& in) {
        Rotation r;
        const double x = in.real(), y = in.real(), z = in.real(), w = in.real();
        r.q_ = {w, x, y, z};
        require_unit("rotation", r.q_.norm());
        return r;
    }

  private:
    /// The vector part of the quaternion: along the axis, of length sin(angle / 2).
    Vector<3> axis() const { return q_.imaginary(); }
    Vector<3> turned(const Vector<3>& axis, const Vector<3>& v) const {
        const Vector<3> twice = 2.0 * axis.cross(v);
        return v + q_.w() * twice + axis.cross(twice);
    }

    Quaternion q_;
};

}  // namespace talus
