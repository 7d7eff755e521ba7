// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/concepts.hpp>

namespace talus {

/// The unbounded solid { x : normal . x <= offset }: a floor or a plane wall. A shape for
/// obstacles: it has no volume that a body could be made of.
template <int Dim>
requires SpaceDimension<Dim>
class HalfSpace {
  public:
    /// `normal` points out of the solid, in the frame of the shape, and is normalised here;
    /// `offset` [m] is the distance of the surface from the origin along it. Throws input_error
    /// unless both are finite and `normal` is not zero.
    explicit HalfSpace(const Vector<Dim>& normal, double offset = 0.0) {
        require_finite("normal of the half-space", normal);
        const double length = require_positive("length of the half-space's normal", normal.norm());
        normal_ = normal / length;
        offset_ = require_in("offset of the half-space", offset, -1e300, 1e300);
    }

    const Vector<Dim>& normal() const { return normal_; }  ///< unit, out of the solid
    double offset() const { return offset_; }              ///< [m]

    /// Infinite on every side but the one that a normal exactly along an axis bounds.
    Aabb<Dim> aabb(const Pose<Dim>& pose) const {
        const HalfSpace s = placed(pose);
        const double infinity = std::numeric_limits<double>::infinity();
        Aabb<Dim> box{Vector<Dim>::Constant(-infinity), Vector<Dim>::Constant(infinity)};
        for (int k = 0; k < Dim; ++k) {
            if (s.normal_[k] == 1.0) box.high[k] = s.offset_;
            if (s.normal_[k] == -1.0) box.low[k] = -s.offset_;
        }
        return box;
    }
    HalfSpace placed(const Pose<Dim>& pose) const {
        HalfSpace s = *this;
        s.normal_ = pose.rotation * normal_;
        s.offset_ = offset_ + s.normal_.dot(pose.position);
        return s;
    }

    void write(NumberRecord& out) const {
        out.array(normal_);
        out.real(offset_);
    }
    static HalfSpace read(NumberRecordReader& in) {
        const auto normal = in.array<Vector<Dim>>();
        HalfSpace s(normal, in.real());
        require_unit("normal of the half-space", normal.norm());
        s.normal_ = normal;  // to the last bit, which normalising may change
        return s;
    }

  private:
    Vector<Dim> normal_;
    double offset_;
};

TALUS_MODEL(Shape<HalfSpace<2>, 2>);
TALUS_MODEL(Shape<HalfSpace<3>, 3>);
TALUS_MODEL(!SolidShape<HalfSpace<2>, 2>);
TALUS_MODEL(!SolidShape<HalfSpace<3>, 3>);

}  // namespace talus
