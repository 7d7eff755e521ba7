// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/mass_properties.hpp>

#include <cmath>

namespace talus {

/// The points with |x_0 / a_0|^n + ... <= 1: ellipses and ellipsoids (n = 2), above that
/// towards boxes (Lame's curves), below towards diamonds. Smooth, so that a pair has one point of
/// contact: what would rest on a face stands on one point, and rocks. It is not in AnyShape, which
/// every program compiles:
///
///     struct Eggs : SimulationTypes<3> {
///         using Shape = AnyShapeOf<3, HalfSpace<3>, Ball<3>, Superellipsoid<3>>;
///     };
///     Simulation<3, Eggs> sim({Coulomb<3>{.mu = 0.4}});
template <int Dim>
requires SpaceDimension<Dim>
class Superellipsoid {
  public:
    /// Throws input_error unless the semi-axes [m] are positive and the exponent lies in [1.25, 8]:
    /// beyond, corners and faces are too sharp and too flat for one smooth point of contact.
    explicit Superellipsoid(const Vector<Dim>& semi_axes, double exponent = 2.0)
        : semi_axes_(semi_axes), exponent_(require_in("exponent", exponent, 1.25, 8.0)) {
        for (int k = 0; k < Dim; ++k)
            require_positive(detail::numbered("semi-axis", static_cast<std::size_t>(k)),
                             semi_axes[k]);
    }

    const Vector<Dim>& semi_axes() const { return semi_axes_; }  ///< [m]
    double exponent() const { return exponent_; }
    const Pose<Dim>& pose() const { return pose_; }  ///< of its axes
    double half_thickness() const { return semi_axes_.minCoeff(); }

    /// Where the gradient of the n-th powers is along d: with m = n / (n - 1) and c_k = a_k |d_k|,
    /// x_k = a_k c_k^(m-1) / (sum c^m)^(1/n).
    Vector<Dim> support(const Vector<Dim>& d) const {
        return pose_.point_world(own_support(pose_.rotation.transpose_times(d)));
    }
    Aabb<Dim> aabb(const Pose<Dim>& at) const {
        const Pose<Dim> pose = at * pose_;
        Vector<Dim> half;
        for (int k = 0; k < Dim; ++k) {
            const Vector<Dim> axis = pose.rotation.transpose_times(Vector<Dim>::Unit(k));
            half[k] = axis.dot(own_support(axis));
        }
        return {pose.position - half, pose.position + half};
    }
    /// Closed forms, by Dirichlet's integral: the mean of x_k^2 is a_k^2 times
    /// G(3/n) G(1 + d/n) / (G(1/n) G(1 + (d + 2)/n)), with G the gamma function and d = Dim.
    MassProperties<Dim> mass_properties() const {
        const double n = exponent_;
        double volume = 1.0 / std::tgamma(1.0 + Dim / n);
        for (int k = 0; k < Dim; ++k) volume *= 2.0 * semi_axes_[k] * std::tgamma(1.0 + 1.0 / n);
        const double mean = std::tgamma(3.0 / n) * std::tgamma(1.0 + Dim / n) /
                            (std::tgamma(1.0 / n) * std::tgamma(1.0 + (Dim + 2) / n));
        Matrix<Dim> second = Matrix<Dim>::Zero();
        for (int k = 0; k < Dim; ++k) second(k, k) = volume * mean * semi_axes_[k] * semi_axes_[k];
        const Matrix<Dim> axes = pose_.rotation.matrix();
        return {volume, pose_.position,
                inertia_of_second_moments<Dim>(axes * second * axes.transpose())};
    }
    Superellipsoid placed(const Pose<Dim>& at) const {
        Superellipsoid result = *this;
        result.pose_ = at * pose_;
        return result;
    }

    void write(NumberRecord& out) const {
        out.array(semi_axes_);
        out.real(exponent_);
        out.array(pose_.position);
        pose_.rotation.write(out);
    }
    static Superellipsoid read(NumberRecordReader& in) {
        const auto semi_axes = in.array<Vector<Dim>>();
        Superellipsoid result(semi_axes, in.real());
        result.pose_.position = in.array<Vector<Dim>>();
        result.pose_.rotation = Rotation<Dim>::read(in);
        return result;
    }

  private:
    Vector<Dim> own_support(const Vector<Dim>& d) const {
        Vector<Dim> scaled = semi_axes_.cwiseProduct(d);
        scaled /= scaled.cwiseAbs().maxCoeff();  // so that powers stay numbers
        if (exponent_ == 2.0) return semi_axes_.cwiseProduct(scaled) / scaled.norm();
        const double m = exponent_ / (exponent_ - 1.0);
        double sum = 0.0;
        Vector<Dim> x;
        for (int k = 0; k < Dim; ++k) {
            const double c = std::abs(scaled[k]);
            x[k] = std::copysign(semi_axes_[k] * std::pow(c, m - 1.0), scaled[k]);
            sum += std::pow(c, m);
        }
        return x / std::pow(sum, 1.0 / exponent_);
    }

    Vector<Dim> semi_axes_;
    double exponent_;
    Pose<Dim> pose_;
};

TALUS_MODEL(SolidShape<Superellipsoid<2>, 2>);
TALUS_MODEL(SolidShape<Superellipsoid<3>, 3>);
TALUS_MODEL(ConvexShape<Superellipsoid<2>, 2>);
TALUS_MODEL(ConvexShape<Superellipsoid<3>, 3>);

}  // namespace talus
