// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/concepts.hpp>

#include <limits>
#include <memory>
#include <utility>

namespace talus {

/// The unbounded solid around a round hole: all points farther than `radius` from a point in the
/// plane, from an axis in space. A drum, a tube, a silo: a shape for obstacles, to be closed by
/// half-spaces. Convex bodies touch it at vertices alone, so that it has no seams, however it
/// turns. A step goes along the tangent: what is held against the wall at a speed v along it enters
/// it by (h v)^2 / (2 R) in each step, h v^2 / (2 R) in a second, and loses the same share of its
/// speed; a smaller h, or a correction of positions (GapCorrection), where that counts.
template <int Dim>
requires SpaceDimension<Dim>
class RoundHole {
  public:
    /// About the origin of its frame. Throws input_error unless `radius` [m] is positive.
    explicit RoundHole(double radius) requires(Dim == 2)
        : RoundHole(Data{{}, {}, require_positive("radius of the hole", radius)}) {}
    /// About an axis of any length through the origin of its frame.
    RoundHole(double radius, const Vector<Dim>& axis) requires(Dim == 3)
        : RoundHole(Data{{},
                         require_finite("axis of the hole", axis) /
                             require_positive("length of the hole's axis", axis.norm()),
                         require_positive("radius of the hole", radius)}) {}

    double radius() const { return data_->radius; }              ///< [m]
    const Vector<Dim>& centre() const { return data_->centre; }  ///< in the frame of the shape [m]
    const Vector<Dim>& axis() const { return data_->axis; }      ///< unit; zero in the plane
    /// From the centre or the axis to a point of the frame, across [m].
    Vector<Dim> across(const Vector<Dim>& point) const {
        const Vector<Dim> way = point - centre();
        return way - axis().dot(way) * axis();
    }

    Aabb<Dim> aabb(const Pose<Dim>&) const {
        const double infinity = std::numeric_limits<double>::infinity();
        return {Vector<Dim>::Constant(-infinity), Vector<Dim>::Constant(infinity)};
    }
    RoundHole placed(const Pose<Dim>& pose) const {
        return RoundHole(Data{pose.point_world(centre()), pose.rotation * axis(), radius()});
    }

    void write(NumberRecord& out) const {
        out.array(centre());
        out.array(axis());
        out.real(radius());
    }
    static RoundHole read(NumberRecordReader& in) {
        Data data;
        data.centre = require_finite("centre of the hole", in.array<Vector<Dim>>());
        data.axis = require_finite("axis of the hole", in.array<Vector<Dim>>());
        data.radius = require_positive("radius of the hole", in.real());
        if constexpr (Dim == 3)
            require_unit("axis of the hole", data.axis.norm());
        else
            require_in("axis of the hole", data.axis.norm(), 0.0, 0.0);
        return RoundHole(std::move(data));
    }

  private:
    struct Data {
        Vector<Dim> centre, axis;
        double radius = 0.0;
    };
    explicit RoundHole(Data&& data) : data_(std::make_shared<const Data>(std::move(data))) {}

    std::shared_ptr<const Data> data_;
};

TALUS_MODEL(Shape<RoundHole<2>, 2>);
TALUS_MODEL(Shape<RoundHole<3>, 3>);
TALUS_MODEL(!SolidShape<RoundHole<2>, 2>);
TALUS_MODEL(!SolidShape<RoundHole<3>, 3>);

}  // namespace talus
