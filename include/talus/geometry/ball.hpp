// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>

#include <numbers>

namespace talus {

/// Disk in 2D, ball in 3D.
template <int Dim>
requires SpaceDimension<Dim>
class Ball {
  public:
    /// Throws input_error unless `radius` [m] is positive and `centre` [m] finite.
    explicit Ball(double radius, const Vector<Dim>& centre = Vector<Dim>::Zero())
        : centre_(require_finite("centre of the ball", centre)),
          radius_(require_positive("radius of the ball", radius)) {}

    double radius() const { return radius_; }              ///< [m]
    const Vector<Dim>& centre() const { return centre_; }  ///< in the frame of the shape [m]

    /// Where the centre is when placed [m]; at once for the balls of bodies, centred on their
    /// frame.
    Vector<Dim> centre_world(const Pose<Dim>& pose) const {
        return centre_.isZero(0.0) ? pose.position : pose.point_world(centre_);
    }
    /// The centre as a core of one vertex.
    CoreView<Dim> core() const {
        return {{&centre_, 1}, {}, {}, {}, {}, {}, {}, radius_, centre_, radius_};
    }

    Aabb<Dim> aabb(const Pose<Dim>& pose) const {
        const Vector<Dim> c = centre_world(pose);
        return Aabb<Dim>{c, c}.expanded(radius_);
    }
    Vector<Dim> support(const Vector<Dim>& d) const { return centre_ + radius_ * d.normalized(); }

    /// Disk: pi R^2, moment m R^2 / 2. Ball: 4/3 pi R^3, moments 2/5 m R^2.
    MassProperties<Dim> mass_properties() const {
        const double r2 = radius_ * radius_;
        const double volume = std::numbers::pi * r2 * (Dim == 2 ? 1.0 : 4.0 / 3.0 * radius_);
        const double moment = volume * r2 * (Dim == 2 ? 0.5 : 0.4);
        return {volume, centre_, moment * AngularMatrix<Dim>::Identity()};
    }
    Ball placed(const Pose<Dim>& pose) const { return Ball(radius_, pose.point_world(centre_)); }

    void write(NumberRecord& out) const {
        out.real(radius_);
        out.array(centre_);
    }
    static Ball read(NumberRecordReader& in) {
        const double radius = in.real();
        return Ball(radius, in.array<Vector<Dim>>());
    }

  private:
    Vector<Dim> centre_;
    double radius_;
};

TALUS_MODEL(SolidShape<Ball<2>, 2>);
TALUS_MODEL(SolidShape<Ball<3>, 3>);
TALUS_MODEL(ConvexShape<Ball<2>, 2>);
TALUS_MODEL(ConvexShape<Ball<3>, 3>);

}  // namespace talus
