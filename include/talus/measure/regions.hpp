// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/geometry/shape_view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// A part of space that is measured.
template <class R, int Dim>
concept Region = requires(const R& region, const Vector<Dim>& x) {
    { region.contains(x) } -> std::same_as<bool>;
    { region.volume() } -> std::convertible_to<double>;  ///< [m^Dim]
    { region.box() } -> std::same_as<Aabb<Dim>>;         ///< that holds it
};

/// All that is within a radius of a centre: a disc in the plane.
template <int Dim>
requires SpaceDimension<Dim>
class BallRegion {
  public:
    /// Throws input_error unless the radius is positive and the centre finite.
    BallRegion(const Vector<Dim>& centre, double radius)
        : centre_(centre), radius_(require_positive("radius of the region", radius)) {
        require_finite("centre of the region", centre);
    }
    bool contains(const Vector<Dim>& x) const {
        return (x - centre_).squaredNorm() < radius_ * radius_;
    }
    double volume() const { return Ball<Dim>(radius_).mass_properties().volume; }
    Aabb<Dim> box() const { return Aabb<Dim>{centre_, centre_}.expanded(radius_); }

  private:
    Vector<Dim> centre_;
    double radius_;
};

/// A box along the axes.
template <int Dim>
requires SpaceDimension<Dim>
class BoxRegion {
  public:
    /// Throws input_error unless it has a volume.
    BoxRegion(const Vector<Dim>& low, const Vector<Dim>& high) : box_{low, high} {
        require_finite("lower corner of the region", low);
        require_finite("upper corner of the region", high);
        for (int k = 0; k < Dim; ++k)
            if (!(high[k] > low[k]))
                detail::reject("upper corner of the region", high[k],
                               "above the lower, " + detail::text_of(low[k]));
    }
    bool contains(const Vector<Dim>& x) const {
        return (x - box_.low).minCoeff() >= 0.0 && (box_.high - x).minCoeff() > 0.0;
    }
    double volume() const { return (box_.high - box_.low).prod(); }
    Aabb<Dim> box() const { return box_; }

  private:
    Aabb<Dim> box_;
};

TALUS_MODEL(Region<BallRegion<2>, 2>);
TALUS_MODEL(Region<BallRegion<3>, 3>);
TALUS_MODEL(Region<BoxRegion<2>, 2>);
TALUS_MODEL(Region<BoxRegion<3>, 3>);

/// Whether a placed shape covers a point of space. Of a shape that is known by its support mapping
/// alone it is not known: false.
template <int Dim>
bool covers(const ShapeView<Dim>& shape, const Pose<Dim>& pose, const Vector<Dim>& x);

namespace detail {

/// Whether a point of the body's frame is in a core: at most `radius` from the hull of its
/// vertices.
template <int Dim>
bool is_in_core(const CoreView<Dim>& core, const Vector<Dim>& x) {
    bool inside = core.face_count() > 0;
    for (std::size_t f = 0; f < core.face_count(); ++f) {
        const double over = core.normals[f].dot(x) - core.offsets[f];
        if (over > core.radius) return false;
        inside = inside && over <= 0.0;
    }
    if (inside || core.radius == 0.0) return inside;
    // Near the rounded surface: the nearest point of the hull, by Frank and Wolfe with exact line
    // search over its vertices, until what is left cannot decide otherwise.
    Vector<Dim> p = core.vertices[0];
    for (int k = 0; k < 1000; ++k) {
        const Vector<Dim> away = x - p;
        const double distance = away.norm();
        if (distance <= core.radius) return true;
        const Vector<Dim>& v = core.vertices[support_index(core, away)];
        // No point of the hull is nearer than this.
        if ((away.dot(x - v)) / distance > core.radius) return false;
        const Vector<Dim> step = v - p;
        const double length = step.squaredNorm();
        if (!(length > 0.0)) return false;
        p += std::clamp(away.dot(step) / length, 0.0, 1.0) * step;
    }
    return false;
}

}  // namespace detail

template <int Dim>
bool covers(const ShapeView<Dim>& shape, const Pose<Dim>& pose, const Vector<Dim>& x) {
    const Vector<Dim> inside = pose.point_body(x);
    switch (shape.kind()) {
        case ShapeKind::ball: {
            const auto& ball = shape.template as<Ball<Dim>>();
            return (inside - ball.centre()).squaredNorm() <= ball.radius() * ball.radius();
        }
        case ShapeKind::core:
            return detail::is_in_core(shape.core(), inside);
        case ShapeKind::half_space: {
            const auto& wall = shape.template as<HalfSpace<Dim>>();
            return wall.normal().dot(inside) <= wall.offset();
        }
        case ShapeKind::hole: {
            const auto& hole = shape.template as<RoundHole<Dim>>();
            return hole.across(inside).norm() >= hole.radius();
        }
        case ShapeKind::compound:
            for (std::size_t k = 0; k < shape.bounds().size(); ++k)
                if (covers(shape.child(k), pose, x)) return true;
            return false;
        default:
            return false;
    }
}

/// Part of a region that the shapes of some bodies cover, `counts(i)`; what several cover counts
/// once. It is found at the middles of cells of side `spacing` [m], which are either in or out: off
/// by some spacing / size of the bodies, over the square root of their number. Shapes that are
/// known by their support mapping alone count as nothing. Throws input_error if the region has not
/// between 1 and 10^9 cells, or if there is not a shape for each body. O(cells in the boxes of
/// bodies).
template <int Dim, Region<Dim> R, class ShapeType, class Counts>
double solid_fraction(const R& region, const Bodies<Dim>& bodies, std::span<const ShapeType> shapes,
                      double spacing, Counts&& counts) {
    require_count("shapes", shapes.size(), "bodies", bodies.count());
    require_positive("spacing", spacing);
    const Aabb<Dim> box = region.box();
    std::array<std::size_t, static_cast<std::size_t>(Dim)> cells{};
    double all = 1.0;
    for (int k = 0; k < Dim; ++k) {
        const double along = std::ceil((box.high[k] - box.low[k]) / spacing);
        all *= along;
        require_in("cells of the region", all, 1.0, 1e9);
        cells[static_cast<std::size_t>(k)] = static_cast<std::size_t>(along);
    }
    // The middle of a cell along an axis, and the first whose middle is not below x.
    const auto middle = [&](int k, std::size_t i) {
        return box.low[k] + (static_cast<double>(i) + 0.5) * spacing;
    };
    const auto first = [&](int k, double x) {
        const double i = std::ceil((x - box.low[k]) / spacing - 0.5);
        return static_cast<std::size_t>(
            std::clamp(i, 0.0, static_cast<double>(cells[static_cast<std::size_t>(k)])));
    };
    std::vector<bool> covered(static_cast<std::size_t>(all), false);
    const auto visit = [&](const Aabb<Dim>& part, auto&& what) {
        std::array<std::size_t, static_cast<std::size_t>(Dim)> low{}, high{}, at{};
        for (int k = 0; k < Dim; ++k) {
            const auto d = static_cast<std::size_t>(k);
            low[d] = first(k, part.low[k]);
            high[d] = first(k, part.high[k]);
            if (low[d] == high[d]) return;
        }
        for (at = low;;) {
            Vector<Dim> x;
            std::size_t index = 0;
            for (int k = Dim - 1; k >= 0; --k) {
                const auto d = static_cast<std::size_t>(k);
                x[k] = middle(k, at[d]);
                index = index * cells[d] + at[d];
            }
            what(index, x);
            std::size_t d = 0;
            for (; d < static_cast<std::size_t>(Dim); ++d) {
                if (++at[d] < high[d]) break;
                at[d] = low[d];
            }
            if (d == static_cast<std::size_t>(Dim)) return;
        }
    };
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (!counts(i)) continue;
        const Pose<Dim> pose = bodies.pose(i);
        const ShapeView<Dim> shape = view_of<Dim>(shapes[i]);
        visit(shape.aabb(pose), [&](std::size_t index, const Vector<Dim>& x) {
            if (!covered[index] && covers(shape, pose, x)) covered[index] = true;
        });
    }
    double inside = 0.0, solid = 0.0;
    visit(box.expanded(spacing), [&](std::size_t index, const Vector<Dim>& x) {
        if (!region.contains(x)) return;
        inside += 1.0;
        if (covered[index]) solid += 1.0;
    });
    return inside > 0.0 ? solid / inside : 0.0;
}
/// Of all bodies that are no obstacles.
template <int Dim, Region<Dim> R, class ShapeType>
double solid_fraction(const R& region, const Bodies<Dim>& bodies, std::span<const ShapeType> shapes,
                      double spacing) {
    return solid_fraction<Dim>(region, bodies, shapes, spacing,
                               [&](std::size_t i) { return !bodies.is_obstacle(i); });
}

/// Mean stress of the bodies whose centres are in a region, compression negative [N/m^(Dim-1)]: the
/// sum of their internal moments (`internal_moments`), over a volume. Their own is not the region's
/// where some that are in reach out of it and others reach in: `volume` is what belongs to them,
/// such as their solid volume over the solid fraction; by default that of the region, which is off
/// by some grain / region. [Moreau1997]
template <int Dim, Region<Dim> R>
Matrix<Dim> mean_stress(const R& region, const Bodies<Dim>& bodies,
                        std::span<const Matrix<Dim>> moments, double volume) {
    require_count("internal moments", moments.size(), "bodies", bodies.count());
    require_positive("volume of the bodies", volume);
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    for (std::size_t i = 0; i < bodies.count(); ++i)
        if (!bodies.is_obstacle(i) && region.contains(bodies.position[i])) sum += moments[i];
    return sum / volume;
}
template <int Dim, Region<Dim> R>
Matrix<Dim> mean_stress(const R& region, const Bodies<Dim>& bodies,
                        std::span<const Matrix<Dim>> moments) {
    return mean_stress<Dim>(region, bodies, moments, region.volume());
}

}  // namespace talus
