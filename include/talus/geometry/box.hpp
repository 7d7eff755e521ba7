// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/core_mass.hpp>

#include <memory>

namespace talus {

/// Rectangle in 2D, rectangular block in 3D.
template <int Dim>
requires SpaceDimension<Dim>
class Box {
  public:
    /// From -half_extents to +half_extents [m]. Throws input_error unless all are positive.
    explicit Box(const Vector<Dim>& half_extents) : half_extents_(half_extents) {
        for (int k = 0; k < Dim; ++k)
            require_positive(
                detail::numbered("half extent", static_cast<std::size_t>(k), " of the box"),
                half_extents[k]);
        core_ = std::make_shared<const ConvexCore<Dim>>(corners(half_extents), sides(), 0.0);
    }

    const Vector<Dim>& half_extents() const { return half_extents_; }  ///< [m]
    CoreView<Dim> core() const { return core_->view(); }               ///< the box itself

    Aabb<Dim> aabb(const Pose<Dim>& pose) const { return core_aabb(core(), pose); }
    Vector<Dim> support(const Vector<Dim>& d) const {
        const CoreView<Dim> c = core();
        return c.vertices[support_index(c, d)];
    }
    /// V = prod 2 h_k, second moments V h_k^2 / 3.
    MassProperties<Dim> mass_properties() const {
        const auto v = core().vertices;
        const double volume = (2.0 * half_extents_).prod();
        Matrix<Dim> second = Matrix<Dim>::Zero();
        for (int k = 0; k < Dim; ++k) {
            const Vector<Dim> half_side = 0.5 * (v[std::size_t{1} << k] - v[0]);
            second += volume / 3.0 * half_side * half_side.transpose();
        }
        return {volume, 0.5 * (v.front() + v.back()), inertia_of_second_moments<Dim>(second)};
    }
    Box placed(const Pose<Dim>& pose) const {
        Box result = *this;
        result.core_ = std::make_shared<const ConvexCore<Dim>>(core_->placed(pose));
        return result;
    }

    void write(NumberRecord& out) const {
        out.array(half_extents_);
        core_->write(out);
    }
    static Box read(NumberRecordReader& in) {
        Box result(in.array<Vector<Dim>>());
        ConvexCore<Dim> core = ConvexCore<Dim>::read(in);
        require_count("vertices of a box", core.view().vertices.size(), "corners",
                      std::size_t{1} << Dim);
        result.core_ = std::make_shared<const ConvexCore<Dim>>(std::move(core));
        return result;
    }

  private:
    /// Corner i lies on the positive side of axis k if bit k of i is set.
    static std::vector<Vector<Dim>> corners(const Vector<Dim>& h) {
        std::vector<Vector<Dim>> result;
        for (int i = 0; i < (1 << Dim); ++i) {
            Vector<Dim> v = h;
            for (int k = 0; k < Dim; ++k)
                if (!(i >> k & 1)) v[k] = -h[k];
            result.push_back(v);
        }
        return result;
    }
    static std::vector<std::vector<std::uint32_t>> sides() {
        if constexpr (Dim == 2)
            return {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
        else
            return {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    }

    Vector<Dim> half_extents_;
    std::shared_ptr<const ConvexCore<Dim>> core_;
};

TALUS_MODEL(SolidShape<Box<2>, 2>);
TALUS_MODEL(SolidShape<Box<3>, 3>);
TALUS_MODEL(ConvexShape<Box<2>, 2>);
TALUS_MODEL(ConvexShape<Box<3>, 3>);

}  // namespace talus
