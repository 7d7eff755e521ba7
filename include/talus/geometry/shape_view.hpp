// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/aabb.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/geometry/convex_core.hpp>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>

namespace talus {

template <int Dim>
requires SpaceDimension<Dim>
class Ball;
template <int Dim>
requires SpaceDimension<Dim>
class HalfSpace;
template <int Dim>
requires SpaceDimension<Dim>
class RoundHole;

/// Whether S is a compound (compound.hpp).
template <class S>
inline constexpr bool is_compound = false;

/// A ball that holds a shape: enough to see that two shapes are far apart.
template <int Dim>
requires SpaceDimension<Dim>
struct BoundingBall {
    Vector<Dim> centre = Vector<Dim>::Zero();  ///< in the frame of the shape [m]
    double radius = 0.0;                       ///< [m]
};

/// What the narrow phase can ask of a shape.
enum class ShapeKind : std::uint8_t {
    ball,        ///< is a Ball, of which closed forms are known
    core,        ///< has core(): vertices, edges and faces
    half_space,  ///< is a HalfSpace
    hole,        ///< is a RoundHole
    convex,      ///< has support() and nothing better
    compound,    ///< has children, each to be asked by itself
    stranger     ///< none of these: can meet by a routine of its own alone
};

template <class S, int Dim>
inline constexpr ShapeKind kind_of = std::same_as<S, Ball<Dim>>        ? ShapeKind::ball
                                     : std::same_as<S, HalfSpace<Dim>> ? ShapeKind::half_space
                                     : std::same_as<S, RoundHole<Dim>> ? ShapeKind::hole
                                     : is_compound<S>                  ? ShapeKind::compound
                                     : CoreShape<S, Dim>               ? ShapeKind::core
                                     : ConvexShape<S, Dim>             ? ShapeKind::convex
                                                                       : ShapeKind::stranger;

template <int Dim>
struct ShapeView;

/// How to ask a shape of which only the address is known. There is one such table for each type of
/// shape (`shape_access`), whose address therefore tells the type. Entries that do not fit the kind
/// are null.
template <int Dim>
requires SpaceDimension<Dim>
struct ShapeAccess {
    ShapeKind kind;
    Aabb<Dim> (*aabb)(const void* shape, const Pose<Dim>& pose);
    CoreView<Dim> (*core)(const void* shape);
    Vector<Dim> (*support)(const void* shape, const Vector<Dim>& d);
    std::span<const BoundingBall<Dim>> (*bounds)(const void* compound);
    ShapeView<Dim> (*child)(const void* compound, std::size_t i);
};

/// A shape seen through its table, its type forgotten: what lets the narrow phase be compiled once
/// instead of once for each pair of types. Lives no longer than the shape.
template <int Dim>
struct ShapeView {
    const void* shape;
    const ShapeAccess<Dim>* access;

    ShapeKind kind() const { return access->kind; }
    /// Whether it is a wall: without an end, and met by vertices alone.
    bool is_wall() const { return kind() == ShapeKind::half_space || kind() == ShapeKind::hole; }
    bool has_core() const { return kind() == ShapeKind::ball || kind() == ShapeKind::core; }
    /// The shape itself, of which the caller knows the type from the kind.
    template <class S>
    const S& as() const {
        return *static_cast<const S*>(shape);
    }
    Aabb<Dim> aabb(const Pose<Dim>& pose) const { return access->aabb(shape, pose); }
    CoreView<Dim> core() const { return access->core(shape); }
    Vector<Dim> support(const Vector<Dim>& d) const { return access->support(shape, d); }
    std::span<const BoundingBall<Dim>> bounds() const { return access->bounds(shape); }
    ShapeView child(std::size_t i) const { return access->child(shape, i); }
};

template <int Dim, Shape<Dim> S>
ShapeView<Dim> view_of(const S& shape);

namespace detail {

template <int Dim, class S>
constexpr ShapeAccess<Dim> make_shape_access() {
    constexpr ShapeKind kind = kind_of<S, Dim>;
    ShapeAccess<Dim> access{kind, nullptr, nullptr, nullptr, nullptr, nullptr};
    access.aabb = [](const void* s, const Pose<Dim>& pose) -> Aabb<Dim> {
        return static_cast<const S*>(s)->aabb(pose);
    };
    if constexpr (CoreShape<S, Dim>)
        access.core = [](const void* s) { return static_cast<const S*>(s)->core(); };
    if constexpr (ConvexShape<S, Dim>)
        access.support = [](const void* s, const Vector<Dim>& d) -> Vector<Dim> {
            return static_cast<const S*>(s)->support(d);
        };
    else if constexpr (CoreShape<S, Dim>)
        access.support = [](const void* s, const Vector<Dim>& d) -> Vector<Dim> {
            return core_support<Dim>(static_cast<const S*>(s)->core(), d);
        };
    if constexpr (kind == ShapeKind::compound) {
        access.bounds = [](const void* s) { return static_cast<const S*>(s)->bounds(); };
        access.child = [](const void* s, std::size_t i) {
            return view_of<Dim>(static_cast<const S*>(s)->children()[i]);
        };
    }
    return access;
}

}  // namespace detail

/// The table of shapes of type S.
template <int Dim, class S>
inline constexpr ShapeAccess<Dim> shape_access = detail::make_shape_access<Dim, S>();

/// The shape without its type; of an AnyShapeOf the shape that it holds.
template <int Dim, Shape<Dim> S>
ShapeView<Dim> view_of(const S& shape) {
    if constexpr (requires { shape.view(); })
        return shape.view();
    else
        return {&shape, &shape_access<Dim, S>};
}

/// Distance of the farthest point of a shape from the origin of its frame, or a little more;
/// infinite where it has no bounds [m].
template <int Dim>
double farthest_point(const ShapeView<Dim>& view) {
    double farthest = 0.0;
    if (view.has_core()) {
        const CoreView<Dim> core = view.core();
        return core.centre.norm() + core.bound;
    }
    if (view.kind() == ShapeKind::compound) {
        for (const BoundingBall<Dim>& ball : view.bounds())
            farthest = std::max(farthest, ball.centre.norm() + ball.radius);
        return farthest;
    }
    const Aabb<Dim> box = view.aabb(Pose<Dim>{});
    return box.bounded() ? box.low.cwiseAbs().cwiseMax(box.high).norm()
                         : std::numeric_limits<double>::infinity();
}

}  // namespace talus
