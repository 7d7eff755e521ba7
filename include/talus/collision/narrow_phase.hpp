// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/ball_contacts.hpp>
#include <talus/collision/contact_point.hpp>
#include <talus/collision/core_contacts.hpp>
#include <talus/collision/own_pairs.hpp>
#include <talus/collision/support_contacts.hpp>
#include <talus/collision/wall_contacts.hpp>
#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/instantiate.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>

namespace talus {

/// append_core_contacts.
template <int Dim>
using CoreRoutine = void (*)(const CoreView<Dim>& a, const Pose<Dim>& pose_a,
                             const CoreView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                             Column<ContactPoint<Dim>>& out);
/// append_support_contact.
template <int Dim>
using SupportRoutine = void (*)(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                const ShapeView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                Column<ContactPoint<Dim>>& out);

/// What the narrow phase has for the shapes that can come, beyond balls and walls. The routines of
/// faces and edges, and that of support mappings, are the larger part of it, and most programs need
/// one of them or none: called through pointers that are null where no shape needs them, they are
/// compiled for those who do alone.
template <int Dim>
requires SpaceDimension<Dim>
struct NarrowRoutines {
    CoreRoutine<Dim> core = nullptr;        ///< for shapes with core() that are no balls
    SupportRoutine<Dim> support = nullptr;  ///< for shapes with support() and nothing better
    std::span<const OwnPair<Dim>> own;      ///< of one's own: these go first

    /// With those of `other` for core and support.
    void add(const NarrowRoutines& other) {
        if (other.core) core = other.core;
        if (other.support) support = other.support;
    }
};

namespace detail {

template <int Dim, class A, class B>
constexpr NarrowRoutines<Dim> make_narrow_routines() {
    NarrowRoutines<Dim> routines;
    if constexpr (may_hold<Dim, A, B>(ShapeKind::core)) routines.core = &append_core_contacts<Dim>;
    if constexpr (may_hold<Dim, A, B>(ShapeKind::convex))
        routines.support = &append_support_contact<Dim>;
    routines.own = own_pairs<Dim, A, B>;
    return routines;
}

}  // namespace detail

/// Those for all that an A, a B and the shapes in them may meet in each other.
template <int Dim, class A, class B = A>
inline constexpr NarrowRoutines<Dim> narrow_routines = detail::make_narrow_routines<Dim, A, B>();

/// The narrow phase for one pair of body shapes. It knows shapes by their views alone, so that it
/// is compiled once for each dimension, whatever the number of shape types.
template <int Dim>
requires SpaceDimension<Dim>
class NarrowPhase {
  public:
    /// Contacts with a gap up to `margin` [m] go to `out`; `routines` are those for all shapes that
    /// come.
    NarrowPhase(double margin, const NarrowRoutines<Dim>& routines, Column<ContactPoint<Dim>>& out)
        : margin_(margin), routines_(routines), out_(out) {}

    void append(const ShapeView<Dim>& a, const Pose<Dim>& pose_a, const ShapeView<Dim>& b,
                const Pose<Dim>& pose_b) const;

  private:
    /// Contacts that already were in `out` are none of ours to renumber or to mirror.
    std::span<ContactPoint<Dim>> added_since(std::size_t first) const {
        return std::span(out_).subspan(first);
    }
    /// Runs the routine of one's own for A with B, if there is one.
    bool append_own(const ShapeView<Dim>& a, const Pose<Dim>& pose_a, const ShapeView<Dim>& b,
                    const Pose<Dim>& pose_b) const;
    void append_mirrored(const ShapeView<Dim>& a, const Pose<Dim>& pose_a, const ShapeView<Dim>& b,
                         const Pose<Dim>& pose_b) const;
    void append_children_of_a(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                              const ShapeView<Dim>& b, const Pose<Dim>& pose_b) const;
    void append_children_of_b(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                              const ShapeView<Dim>& b, const Pose<Dim>& pose_b) const;
    /// Calls `visit(i, child)` for every child that may come within the margin of `box`.
    template <class Visit>
    void for_children_near(const ShapeView<Dim>& compound, const Pose<Dim>& pose,
                           const Aabb<Dim>& box, const Visit& visit) const;

    double margin_;
    const NarrowRoutines<Dim>& routines_;
    Column<ContactPoint<Dim>>& out_;
};

template <int Dim>
requires SpaceDimension<Dim>
void NarrowPhase<Dim>::append(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                              const ShapeView<Dim>& b, const Pose<Dim>& pose_b) const {
    const ShapeKind kind_a = a.kind(), kind_b = b.kind();
    if (!routines_.own.empty() && append_own(a, pose_a, b, pose_b)) return;
    if (kind_a == ShapeKind::ball && kind_b == ShapeKind::ball) {
        append_ball_contact<Dim>(a.template as<Ball<Dim>>(), pose_a, b.template as<Ball<Dim>>(),
                                 pose_b, margin_, out_);
    } else if (a.is_wall()) {
        if (!b.is_wall()) append_mirrored(a, pose_a, b, pose_b);
    } else if (kind_a == ShapeKind::compound) {
        append_children_of_a(a, pose_a, b, pose_b);
    } else if (kind_b == ShapeKind::compound) {
        append_children_of_b(a, pose_a, b, pose_b);
    } else if (kind_a == ShapeKind::ball && kind_b == ShapeKind::half_space) {
        append_half_space_contact<Dim>(a.template as<Ball<Dim>>(), pose_a,
                                       b.template as<HalfSpace<Dim>>(), pose_b, margin_, out_);
    } else if (kind_a == ShapeKind::core && kind_b == ShapeKind::half_space) {
        append_half_space_contacts<Dim>(a.core(), pose_a, b.template as<HalfSpace<Dim>>(), pose_b,
                                        margin_, out_);
    } else if (a.has_core() && kind_b == ShapeKind::hole) {
        append_hole_contacts<Dim>(a.core(), pose_a, b.template as<RoundHole<Dim>>(), pose_b,
                                  margin_, out_);
    } else if (a.has_core() && b.has_core()) {
        TALUS_CHECK(routines_.core != nullptr, "shapes with faces or edges come with a routine");
        routines_.core(a.core(), pose_a, b.core(), pose_b, margin_, out_);
    } else {
        TALUS_CHECK(routines_.support != nullptr,
                    "shapes of support mapping alone come with a routine");
        routines_.support(a, pose_a, b, pose_b, margin_, out_);
    }
}

template <int Dim>
requires SpaceDimension<Dim>
bool NarrowPhase<Dim>::append_own(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                  const ShapeView<Dim>& b, const Pose<Dim>& pose_b) const {
    for (const OwnPair<Dim>& pair : routines_.own)
        if (pair.a == a.access && pair.b == b.access) {
            pair.append(a.shape, pose_a, b.shape, pose_b, margin_, out_);
            return true;
        }
    for (const OwnPair<Dim>& pair : routines_.own)
        if (pair.a == b.access && pair.b == a.access) {
            append_mirrored(a, pose_a, b, pose_b);
            return true;
        }
    return false;
}

template <int Dim>
requires SpaceDimension<Dim>
void NarrowPhase<Dim>::append_mirrored(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                       const ShapeView<Dim>& b, const Pose<Dim>& pose_b) const {
    const std::size_t first = out_.size();
    append(b, pose_b, a, pose_a);
    mirror<Dim>(added_since(first));
}

template <int Dim>
requires SpaceDimension<Dim>
template <class Visit>
void NarrowPhase<Dim>::for_children_near(const ShapeView<Dim>& compound, const Pose<Dim>& pose,
                                         const Aabb<Dim>& box, const Visit& visit) const {
    const Aabb<Dim> reach = box.expanded(std::max(margin_, 0.0));
    const std::span<const BoundingBall<Dim>> bounds = compound.bounds();
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const Vector<Dim> centre = pose.point_world(bounds[i].centre);
        if (reach.overlaps(Aabb<Dim>{centre, centre}.expanded(bounds[i].radius)))
            visit(static_cast<std::uint32_t>(i), compound.child(i));
    }
}

template <int Dim>
requires SpaceDimension<Dim>
void NarrowPhase<Dim>::append_children_of_a(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                            const ShapeView<Dim>& b,
                                            const Pose<Dim>& pose_b) const {
    for_children_near(a, pose_a, b.aabb(pose_b), [&](std::uint32_t i, const ShapeView<Dim>& child) {
        const std::size_t first = out_.size();
        append(child, pose_a, b, pose_b);
        for (ContactPoint<Dim>& c : added_since(first)) c.feature = with_child_of_a(c.feature, i);
    });
}

template <int Dim>
requires SpaceDimension<Dim>
void NarrowPhase<Dim>::append_children_of_b(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                            const ShapeView<Dim>& b,
                                            const Pose<Dim>& pose_b) const {
    for_children_near(b, pose_b, a.aabb(pose_a), [&](std::uint32_t i, const ShapeView<Dim>& child) {
        const std::size_t first = out_.size();
        append(a, pose_a, child, pose_b);
        for (ContactPoint<Dim>& c : added_since(first)) c.feature = with_child_of_b(c.feature, i);
    });
}

namespace detail {

/// The ball that `shape` is or holds, else null.
template <int Dim, class S>
const Ball<Dim>* as_ball(const S& shape) {
    if constexpr (std::same_as<S, Ball<Dim>>)
        return &shape;
    else
        return nullptr;
}
template <int Dim, class... Shapes>
const Ball<Dim>* as_ball(const AnyShapeOf<Dim, Shapes...>& shape) {
    if constexpr ((std::same_as<Shapes, Ball<Dim>> || ...))
        return shape.template get_if<Ball<Dim>>();
    else
        return nullptr;
}

}  // namespace detail

/// Appends to `out` every contact point of two placed shapes whose gap is at most `margin` [m];
/// signs and places as told in contact_point.hpp. The result is a function of the arguments alone;
/// exchanging the shapes gives the mirrored contacts (of shapes known by their support alone, where
/// two ways out are as short, maybe those of the other way). Two walls (half-spaces, round holes)
/// have no contacts.
/// `out` keeps its capacity between calls, and nothing else is allocated. `routines` of fewer types
/// will do where `a` and `b` are known to hold no others.
template <int Dim, class A, class B>
requires CanMeet<A, B, Dim>
void contact_points(const A& a, const Pose<Dim>& pose_a, const B& b, const Pose<Dim>& pose_b,
                    double margin, Column<ContactPoint<Dim>>& out,
                    const NarrowRoutines<Dim>& routines = narrow_routines<Dim, A, B>) {
    TALUS_CHECK(std::isfinite(margin), "the margin of a contact query is finite");
    TALUS_CHECK(pose_a.position.allFinite() && pose_b.position.allFinite(),
                "the poses of a contact query are finite");
    if constexpr (!HasPairContacts<Dim, Ball<Dim>, Ball<Dim>>) {
        // The commonest pair in the field goes first, before any view is made.
        const Ball<Dim>*ball_a = detail::as_ball<Dim>(a), *ball_b = detail::as_ball<Dim>(b);
        if (ball_a && ball_b)
            return append_ball_contact<Dim>(*ball_a, pose_a, *ball_b, pose_b, margin, out);
    }
    NarrowPhase<Dim>(margin, routines, out)
        .append(view_of<Dim>(a), pose_a, view_of<Dim>(b), pose_b);
}

}  // namespace talus

TALUS_IN_PLANE(class talus::NarrowPhase<2>)
TALUS_IN_SPACE(class talus::NarrowPhase<3>)
