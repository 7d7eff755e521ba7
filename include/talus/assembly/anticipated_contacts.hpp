// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/passage.hpp>
#include <talus/core/instantiate.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// Contacts of shapes that are apart, by what their motion will make of them (see Passage).
template <int Dim>
requires SpaceDimension<Dim>
class AnticipatedContacts {
  public:
    /// Whether the foreseen motion would close some contact, or closes one further: else they are
    /// good as they are. Closed are those of gap <= tolerance, and approaches of less than a
    /// thousandth of `reach` are noise of bodies at rest [m].
    static bool concern(std::span<const ContactPoint<Dim>> points, double tolerance, double reach,
                        const Pose<Dim>& pose_a, const Twist<Dim>& motion_a,
                        const Pose<Dim>& pose_b, const Twist<Dim>& motion_b);

    /// Puts the contacts that the motion leads to in the place of those of `points`, which are what
    /// the narrow phase found for the same pair up to the gap `reach` [m]. Those of half-spaces,
    /// which have one normal alone, of two shapes without faces and of shapes without a support
    /// mapping stay. What takes the place of open contacts, of gap > tolerance, is open.
    void replace(const MovingShape<Dim>& a, const MovingShape<Dim>& b,
                 std::span<const OwnPair<Dim>> own, SupportRoutine<Dim> by_support,
                 double tolerance, double reach, std::vector<ContactPoint<Dim>>& points);

    /// Makes room for the contacts of one pair.
    void reserve(std::size_t count) {
        near_.reserve(count);
        result_.reserve(count);
    }

  private:
    static bool handled_whole(const ShapeView<Dim>& a, const ShapeView<Dim>& b,
                              std::span<const OwnPair<Dim>> own);
    static MovingShape<Dim> part(const MovingShape<Dim>& m, std::uint64_t child) {
        if (m.shape.kind() != ShapeKind::compound) return m;
        return {m.shape.child(static_cast<std::size_t>(child)), m.pose, m.motion};
    }

    std::vector<ContactPoint<Dim>> near_, result_;
};

/// The contacts of two bodies, with those that are open as their motion asks.
template <int Dim, class A, class B>
requires CanMeet<A, B, Dim>
void anticipate(const A& a, const Pose<Dim>& pose_a, const Twist<Dim>& motion_a, const B& b,
                const Pose<Dim>& pose_b, const Twist<Dim>& motion_b, double tolerance, double reach,
                AnticipatedContacts<Dim>& anticipated, std::vector<ContactPoint<Dim>>& points) {
    if (AnticipatedContacts<Dim>::concern(points, tolerance, reach, pose_a, motion_a, pose_b,
                                          motion_b))
        anticipated.replace({view_of<Dim>(a), pose_a, motion_a},
                            {view_of<Dim>(b), pose_b, motion_b}, detail::own_pairs<Dim, A, B>,
                            detail::support_routine<Dim, A, B>(), tolerance, reach, points);
}

template <int Dim>
requires SpaceDimension<Dim>
bool AnticipatedContacts<Dim>::concern(std::span<const ContactPoint<Dim>> points, double tolerance,
                                       double reach, const Pose<Dim>& pose_a,
                                       const Twist<Dim>& motion_a, const Pose<Dim>& pose_b,
                                       const Twist<Dim>& motion_b) {
    return std::ranges::any_of(points, [&](const ContactPoint<Dim>& c) {
        const Vector<Dim> change =
            motion_a.at(c.point - pose_a.position) - motion_b.at(c.point - pose_b.position);
        const double way = Foresight::steps * c.normal.dot(change);
        return c.gap > tolerance ? c.gap + way < 0.0 : way < -1e-3 * reach;
    });
}

/// Whether a routine of one's own serves two shapes of which one is a compound: its contacts then
/// need not be those of children.
template <int Dim>
requires SpaceDimension<Dim>
bool AnticipatedContacts<Dim>::handled_whole(const ShapeView<Dim>& a, const ShapeView<Dim>& b,
                                             std::span<const OwnPair<Dim>> own) {
    return (a.kind() == ShapeKind::compound || b.kind() == ShapeKind::compound) &&
           std::ranges::any_of(own, [&](const OwnPair<Dim>& pair) {
               return (pair.a == a.access && pair.b == b.access) ||
                      (pair.a == b.access && pair.b == a.access);
           });
}

template <int Dim>
requires SpaceDimension<Dim>
void AnticipatedContacts<Dim>::replace(const MovingShape<Dim>& a, const MovingShape<Dim>& b,
                                       std::span<const OwnPair<Dim>> own,
                                       SupportRoutine<Dim> by_support, double tolerance,
                                       double reach, std::vector<ContactPoint<Dim>>& points) {
    if (handled_whole(a.shape, b.shape, own)) return;
    const bool compound =
        a.shape.kind() == ShapeKind::compound || b.shape.kind() == ShapeKind::compound;
    const auto children = [&](const ContactPoint<Dim>& c) {
        return compound ? std::pair(c.feature.code >> 52, c.feature.code >> 20 & 0xfff)
                        : std::pair<std::uint64_t, std::uint64_t>{};
    };
    result_.clear();
    for (auto first = points.begin(); first != points.end();) {
        const auto last = std::find_if(first, points.end(), [&](const ContactPoint<Dim>& c) {
            return children(c) != children(*first);
        });
        const std::span<const ContactPoint<Dim>> present(first, last);
        const auto [child_a, child_b] = children(*first);
        const std::size_t kept = result_.size();
        const MovingShape<Dim> part_a = part(a, child_a), part_b = part(b, child_b);
        if (!part_a.foreseeable() || !part_b.foreseeable() || !part_a.shape.access->support ||
            !part_b.shape.access->support || !(part_a.has_faces() || part_b.has_faces()) ||
            !concern(present, tolerance, reach, a.pose, a.motion, b.pose, b.motion))
            result_.insert(result_.end(), first, last);
        else
            Passage<Dim>(part_a, part_b, own, by_support, tolerance, reach, near_)
                .append(present, result_);
        for (ContactPoint<Dim>& c : std::span(result_).subspan(kept)) {
            c.feature = with_child_of_a(c.feature, static_cast<std::uint32_t>(child_a));
            c.feature = with_child_of_b(c.feature, static_cast<std::uint32_t>(child_b));
        }
        first = last;
    }
    points.swap(result_);
}

}  // namespace talus

TALUS_IN_PLANE(class talus::AnticipatedContacts<2>)
TALUS_IN_SPACE(class talus::AnticipatedContacts<3>)
