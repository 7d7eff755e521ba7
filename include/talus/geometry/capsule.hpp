// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/core_mass.hpp>

#include <memory>
#include <numbers>

namespace talus {

/// All points at most `radius` from a segment: a stadium in 2D, a spherocylinder in 3D.
template <int Dim>
requires SpaceDimension<Dim>
class Capsule {
  public:
    /// Segment from -half_length to +half_length along axis 0. Throws input_error unless both
    /// lengths [m] are positive.
    Capsule(double half_length, double radius)
        : Capsule(ends(require_positive("half-length of the capsule", half_length)),
                  require_positive("radius of the capsule", radius)) {}

    double half_length() const { return half_length_; }     ///< of the segment [m]
    double radius() const { return core_->view().radius; }  ///< [m]
    CoreView<Dim> core() const { return core_->view(); }    ///< the segment

    Aabb<Dim> aabb(const Pose<Dim>& pose) const { return core_aabb(core(), pose); }
    Vector<Dim> support(const Vector<Dim>& d) const { return core_support(core(), d); }

    /// Closed form: the middle part plus two half balls whose flat sides are half_length (h) away;
    /// the mean of |x| over a ball of radius R is 3/8 R, over a disk 4/(3 pi) R.
    MassProperties<Dim> mass_properties() const {
        const double h = half_length_, r = radius(), pi = std::numbers::pi;
        const double middle = 2.0 * h * (Dim == 2 ? 2.0 * r : pi * r * r);
        const double ends = pi * r * r * (Dim == 2 ? 1.0 : 4.0 / 3.0 * r);
        const double across = middle * r * r / (Dim == 2 ? 3.0 : 4.0) + ends * r * r / (Dim + 2.0);
        const double mean = (Dim == 2 ? 4.0 / (3.0 * pi) : 3.0 / 8.0) * r;
        const double along =
            middle * h * h / 3.0 + ends * (r * r / (Dim + 2.0) + h * h + 2.0 * h * mean);
        const auto v = core().vertices;
        const Vector<Dim> axis = (v[1] - v[0]).normalized();
        const Matrix<Dim> second =
            across * Matrix<Dim>::Identity() + (along - across) * axis * axis.transpose();
        return {middle + ends, 0.5 * (v[0] + v[1]), inertia_of_second_moments<Dim>(second)};
    }
    Capsule placed(const Pose<Dim>& pose) const {
        Capsule result = *this;
        result.core_ = std::make_shared<const ConvexCore<Dim>>(core_->placed(pose));
        return result;
    }

    void write(NumberRecord& out) const {
        out.real(half_length_);
        core_->write(out);
    }
    static Capsule read(NumberRecordReader& in) {
        const double half_length = in.real();
        ConvexCore<Dim> core = ConvexCore<Dim>::read(in);
        require_count("vertices of a capsule", core.view().vertices.size(), "ends", 2);
        Capsule result(half_length, core.view().radius);
        result.core_ = std::make_shared<const ConvexCore<Dim>>(std::move(core));
        return result;
    }

  private:
    static std::vector<Vector<Dim>> ends(double half_length) {
        return {-half_length * Vector<Dim>::Unit(0), half_length * Vector<Dim>::Unit(0)};
    }
    Capsule(std::vector<Vector<Dim>> ends, double radius) : half_length_(ends[1][0]) {
        std::vector<std::vector<std::uint32_t>> sides;
        if constexpr (Dim == 2) sides = {{0, 1}, {1, 0}};
        core_ = std::make_shared<const ConvexCore<Dim>>(std::move(ends), sides, radius);
    }

    std::shared_ptr<const ConvexCore<Dim>> core_;
    double half_length_;
};

TALUS_MODEL(SolidShape<Capsule<2>, 2>);
TALUS_MODEL(SolidShape<Capsule<3>, 3>);
TALUS_MODEL(ConvexShape<Capsule<2>, 2>);
TALUS_MODEL(ConvexShape<Capsule<3>, 3>);

}  // namespace talus
