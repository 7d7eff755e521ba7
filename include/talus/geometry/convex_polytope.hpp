// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/convex_hull.hpp>
#include <talus/geometry/core_mass.hpp>

#include <cmath>
#include <memory>
#include <numbers>

namespace talus {

/// Sides of a convex polygon given counter-clockwise. Throws input_error naming the vertex that is
/// not finite, coincides with the next, or where the outline does not turn left; or when the
/// outline is clockwise, encloses no area or winds more than once. Lengths below 1e-9 of the
/// polygon's extent, turns below 1e-9 rad count as none.
inline std::vector<VertexLoop> convex_polygon_sides(std::span<const Vector<2>> points) {
    const std::size_t n = points.size();
    if (n < 3) detail::reject("vertex count", static_cast<double>(n), "at least 3");
    double extent = 0.0, twice_area = 0.0, turned = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        require_finite("vertex " + std::to_string(i), points[i]);
        extent = std::max(extent, (points[i] - points[0]).norm());
    }
    for (std::size_t i = 0; i < n; ++i) {
        if ((points[(i + 1) % n] - points[i]).norm() <= 1e-9 * extent)
            detail::reject_vertex((i + 1) % n, "coincides with vertex " + std::to_string(i) +
                                                   ", but the vertices must be distinct");
        twice_area += moment<2>(points[i] - points[0], points[(i + 1) % n] - points[0])[0];
    }
    if (std::abs(twice_area) <= 1e-9 * extent * extent)
        throw input_error("the polygon encloses no area, but must have a positive one");
    if (twice_area < 0.0)
        throw input_error("the vertices 0, 1, 2... run clockwise, but must run counter-clockwise");
    std::vector<VertexLoop> sides;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        const Vector<2> in = points[j] - points[i], out = points[(j + 1) % n] - points[j];
        const double turn = std::atan2(moment<2>(in, out)[0], in.dot(out));
        if (!(turn > 1e-9))
            detail::reject_vertex(j, "is no convex corner, but the polygon must turn left there");
        turned += turn;
        sides.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    }
    if (turned > 3.0 * std::numbers::pi)
        throw input_error("the polygon winds more than once, but must be simple");
    return sides;
}

/// Convex polygon in 2D, convex polyhedron in 3D.
template <int Dim>
requires SpaceDimension<Dim>
class ConvexPolytope {
  public:
    /// 2D: the corners counter-clockwise. 3D: the corners in any order; the faces are found as
    /// those of the convex hull. Vertices keep their index. Throws input_error as told at
    /// convex_polygon_sides and convex_hull_faces.
    explicit ConvexPolytope(std::vector<Vector<Dim>> vertices) {
        const std::vector<VertexLoop> faces = faces_of(vertices);
        core_ = std::make_shared<const ConvexCore<Dim>>(std::move(vertices), faces, 0.0);
    }

    std::span<const Vector<Dim>> vertices() const { return core().vertices; }  ///< [m]
    CoreView<Dim> core() const { return core_->view(); }  ///< the polytope itself

    Aabb<Dim> aabb(const Pose<Dim>& pose) const { return core_aabb(core(), pose); }
    Vector<Dim> support(const Vector<Dim>& d) const {
        const CoreView<Dim> c = core();
        return c.vertices[support_index(c, d)];
    }
    MassProperties<Dim> mass_properties() const { return core_mass_properties(core()); }
    ConvexPolytope placed(const Pose<Dim>& pose) const {
        ConvexPolytope result = *this;
        result.core_ = std::make_shared<const ConvexCore<Dim>>(core_->placed(pose));
        return result;
    }

  private:
    static std::vector<VertexLoop> faces_of(std::span<const Vector<Dim>> vertices) {
        if constexpr (Dim == 2)
            return convex_polygon_sides(vertices);
        else
            return convex_hull_faces(vertices);
    }

    std::shared_ptr<const ConvexCore<Dim>> core_;
};

static_assert(SolidShape<ConvexPolytope<2>, 2> && SolidShape<ConvexPolytope<3>, 3>);
static_assert(ConvexShape<ConvexPolytope<2>, 2> && ConvexShape<ConvexPolytope<3>, 3>);

}  // namespace talus
