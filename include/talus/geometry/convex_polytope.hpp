// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/model.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/core_mass.hpp>
#include <talus/geometry/hull/convex_hull.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <tuple>

namespace talus {

/// Sides of a convex polygon given counter-clockwise; a vertex that lies on a side is a corner of
/// none, with the tolerance of convex_hull in space. Throws input_error naming the vertex that is
/// not finite, coincides with the next, or where the outline turns right; or when the outline is
/// clockwise, encloses no area or winds more than once.
template <int Dim>
requires(Dim == 2) ConvexHull
    convex_hull(std::span<const Vector<Dim>> points, const HullOptions& options = {});

#if TALUS_BODIES
namespace detail {

/// The corners of a loop of points, those left out that lie on a side to a tolerance.
template <int Dim>
requires(Dim == 2) class SideMerger {
  public:
    SideMerger(std::span<const Vector<Dim>> points, double tolerance)
        : points_(points), tolerance_(tolerance), corners_(points.size()) {
        std::iota(corners_.begin(), corners_.end(), 0u);
        while (corners_.size() > 3 && drop_flattest()) {
        }
    }

    const VertexLoop& corners() const { return corners_; }

    /// Distance of a point to the right of the line between two others, which is outwards.
    double height(std::uint32_t from, std::uint32_t to, std::uint32_t point) const {
        const Vector<Dim> side = points_[to] - points_[from];
        return -moment<Dim>(side, points_[point] - points_[from])[0] / side.norm();
    }

  private:
    /// Drops the corner nearest to the line between its neighbours, if all points between these are
    /// within the tolerance of it.
    bool drop_flattest() {
        const std::size_t n = corners_.size();
        std::size_t flattest = n;
        double least = tolerance_;
        for (std::size_t k = 0; k < n; ++k) {
            const std::uint32_t from = corners_[(k + n - 1) % n], to = corners_[(k + 1) % n];
            const double h = std::abs(height(from, to, corners_[k]));
            const bool between =
                (points_[corners_[k]] - points_[from]).dot(points_[to] - points_[corners_[k]]) >
                0.0;
            if (!(h <= least) || !between) continue;
            bool all_near = true;
            for (std::uint32_t p = from; p != to; p = next(p))
                all_near = all_near && std::abs(height(from, to, p)) <= tolerance_;
            if (all_near) flattest = k, least = h;
        }
        if (flattest == n) return false;
        corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(flattest));
        return true;
    }
    std::uint32_t next(std::uint32_t p) const { return p + 1 < points_.size() ? p + 1 : 0; }

    std::span<const Vector<Dim>> points_;
    double tolerance_;
    VertexLoop corners_;
};

}  // namespace detail

template <int Dim>
requires(Dim == 2) ConvexHull
    convex_hull(std::span<const Vector<Dim>> points, const HullOptions& options) {
    const std::size_t n = points.size();
    if (n < 3) detail::reject("vertex count", static_cast<double>(n), "at least 3");
    const auto name = [&](std::size_t i) { return detail::vertex_name(options, i); };
    const double extent = detail::extent_of(points, options);
    double twice_area = 0.0, turned = 0.0, unevenness = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        if ((points[j] - points[i]).norm() <= detail::coincident * extent)
            throw input_error(name(j) + " coincides with " + name(i) +
                              ", but the vertices must be distinct");
        twice_area += moment<Dim>(points[i] - points[0], points[j] - points[0])[0];
    }
    if (std::abs(twice_area) <= detail::coincident * extent * extent)
        throw input_error("the polygon encloses no area, but must have a positive one");
    if (twice_area < 0.0)
        throw input_error("the vertices run clockwise, but must run counter-clockwise");
    ConvexHull result;
    // A polygon no wider than the rounding of its corners tells it was not rounded so much.
    auto tolerance = detail::hull_tolerance<Dim>(points, extent, options);
    result.tolerance = std::min(tolerance.value, twice_area / extent / 32.0);
    const detail::SideMerger<Dim> merger(points, result.tolerance);
    const VertexLoop& corners = merger.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::uint32_t i = corners[k], j = corners[(k + 1) % corners.size()],
                            l = corners[(k + 2) % corners.size()];
        const Vector<Dim> in = points[j] - points[i], out = points[l] - points[j];
        const double turn = std::atan2(moment<Dim>(in, out)[0], in.dot(out));
        if (!(turn > 0.0))
            throw input_error(name(j) +
                              " is no convex corner, but the polygon must turn left there");
        turned += turn;
        result.faces.push_back({i, j});
        for (std::size_t p = (i + 1) % n; p != j; p = (p + 1) % n)
            unevenness =
                std::max(unevenness, std::abs(merger.height(i, j, static_cast<std::uint32_t>(p))));
    }
    if (turned > 3.0 * std::numbers::pi)
        throw input_error("the polygon winds more than once, but must be simple");
    // Two corners always lie on their side: only what was left out tells of rounding.
    tolerance.few_digits = true;
    result.slack = tolerance.slack(unevenness, result.tolerance, extent);
    return result;
}
#endif

template <int Dim>
requires SpaceDimension<Dim>
struct HullOfPoints;

/// Convex polygon in 2D, convex polyhedron in 3D.
template <int Dim>
requires SpaceDimension<Dim>
class ConvexPolytope {
  public:
    /// 2D: the corners counter-clockwise. 3D: the corners in any order; the faces are found as
    /// those of the convex hull. Vertices keep their index. Throws input_error as told at
    /// convex_hull.
    explicit ConvexPolytope(std::vector<Vector<Dim>> vertices, const HullOptions& options = {})
        : ConvexPolytope(convex_hull<Dim>(vertices, options), std::move(vertices)) {}

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

    void write(NumberRecord& out) const { core_->write(out); }
    static ConvexPolytope read(NumberRecordReader& in) {
        ConvexCore<Dim> core = ConvexCore<Dim>::read(in);
        require_in("face count of a polytope", static_cast<double>(core.view().face_count()),
                   Dim + 1.0, static_cast<double>(max_feature_count));
        return ConvexPolytope(std::move(core));
    }

  private:
    explicit ConvexPolytope(ConvexCore<Dim>&& core)
        : core_(std::make_shared<const ConvexCore<Dim>>(std::move(core))) {}
    friend struct HullOfPoints<Dim>;
    ConvexPolytope(const ConvexHull& hull, std::vector<Vector<Dim>>&& vertices)
        : core_(std::make_shared<const ConvexCore<Dim>>(std::move(vertices), hull.faces, 0.0,
                                                        hull.slack)) {}

    std::shared_ptr<const ConvexCore<Dim>> core_;
};

TALUS_MODEL(SolidShape<ConvexPolytope<2>, 2>);
TALUS_MODEL(SolidShape<ConvexPolytope<3>, 3>);
TALUS_MODEL(ConvexShape<ConvexPolytope<2>, 2>);
TALUS_MODEL(ConvexShape<ConvexPolytope<3>, 3>);

/// Convex hull of any points, such as those of a mesh: some may lie inside or coincide.
template <int Dim>
requires SpaceDimension<Dim>
struct HullOfPoints {
    /// Throws input_error as told at convex_hull, but for coincident points and those inside.
    explicit HullOfPoints(std::span<const Vector<Dim>> points, const HullOptions& options = {})
        : HullOfPoints(points, kept_hull(points, options)) {}

    /// Points that are corners: `kept[i]` is vertex i of the polytope. In the order given; in the
    /// plane counter-clockwise.
    std::vector<std::uint32_t> kept;
    ConvexPolytope<Dim> polytope;

  private:
    /// A hull with its corners numbered anew.
    struct KeptHull {
        std::vector<std::uint32_t> kept;
        ConvexHull hull;
    };
    HullOfPoints(std::span<const Vector<Dim>> points, const KeptHull& k)
        : kept(k.kept), polytope(k.hull, chosen(points, k.kept)) {}

    static std::vector<Vector<Dim>> chosen(std::span<const Vector<Dim>> points,
                                           std::span<const std::uint32_t> kept) {
        std::vector<Vector<Dim>> result;
        for (const std::uint32_t i : kept) result.push_back(points[i]);
        return result;
    }
    static KeptHull kept_hull(std::span<const Vector<Dim>> points, const HullOptions& options) {
        KeptHull k;
        if constexpr (Dim == 3) {
            k.hull = convex_hull_of_cloud<Dim>(points, options);
            std::vector<std::uint32_t> number(points.size(), 0);
            for (const VertexLoop& loop : k.hull.faces)
                for (const std::uint32_t v : loop) number[v] = 1;
            for (std::uint32_t i = 0; i < points.size(); ++i)
                if (number[i] == 1)
                    number[i] = static_cast<std::uint32_t>(k.kept.size()), k.kept.push_back(i);
            for (VertexLoop& loop : k.hull.faces)
                for (std::uint32_t& v : loop) v = number[v];
        } else {
            const VertexLoop outline = extreme_points(points, options);
            k.hull = convex_hull<Dim>(chosen(points, outline), options);
            for (std::size_t s = 0; s < k.hull.faces.size(); ++s) {
                k.kept.push_back(outline[k.hull.faces[s][0]]);
                k.hull.faces[s] = {static_cast<std::uint32_t>(s),
                                   static_cast<std::uint32_t>((s + 1) % k.hull.faces.size())};
            }
        }
        return k;
    }
    /// Counter-clockwise [Andrew1979].
    static VertexLoop extreme_points(std::span<const Vector<2>> points,
                                     const HullOptions& options) requires(Dim == 2) {
        const double flat = detail::coincident * detail::extent_of(points, options);
        VertexLoop order(points.size()), loop;
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, {},
                          [&](auto i) { return std::tuple(points[i][0], points[i][1], i); });
        for (int pass = 0; pass < 2; ++pass, std::ranges::reverse(order)) {
            const std::size_t base = loop.size();
            for (const std::uint32_t i : order) {
                while (loop.size() >= base + 2 && turns_right(points, loop, i)) loop.pop_back();
                if (loop.size() == base || (points[i] - points[loop.back()]).norm() > flat)
                    loop.push_back(i);
            }
            if (!loop.empty()) loop.pop_back();
        }
        return loop;
    }
    static bool turns_right(std::span<const Vector<2>> points, const VertexLoop& loop,
                            std::uint32_t i) requires(Dim == 2) {
        const Vector<2>&a = points[loop[loop.size() - 2]], &b = points[loop.back()];
        return moment<2>(b - a, points[i] - b)[0] <= 0.0;
    }
};

}  // namespace talus

TALUS_IN_LIBRARY(talus::ConvexHull talus::convex_hull<2>(std::span<const talus::Vector<2>>,
                                                         const talus::HullOptions&))
