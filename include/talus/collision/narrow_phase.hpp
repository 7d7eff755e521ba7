// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/ball_contacts.hpp>
#include <talus/collision/contact_point.hpp>
#include <talus/collision/core_contacts.hpp>
#include <talus/collision/half_space_contacts.hpp>
#include <talus/collision/support_contacts.hpp>
#include <talus/core/check.hpp>
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/compound.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <span>
#include <variant>
#include <vector>

namespace talus {

/// Contact routine for a pair of one's own shape types, preferred to everything talus knows:
/// specialise with a static function `append` of the signature of contact_points. One order of the
/// two types is enough, the other is served by mirroring.
template <int Dim, class A, class B>
struct PairContacts {};

template <int Dim, class A, class B>
void contact_points(const A& a, const Pose<Dim>& pose_a, const B& b, const Pose<Dim>& pose_b,
                    double margin, std::vector<ContactPoint<Dim>>& out);

namespace detail {

template <int Dim, class A, class B>
concept HasPairContacts = requires(const A& a, const B& b, const Pose<Dim>& pose,
                                   std::vector<ContactPoint<Dim>>& out) {
    PairContacts<Dim, A, B>::append(a, pose, b, pose, 0.0, out);
};

/// The contacts of B with A, mirrored.
template <int Dim, class A, class B>
void append_mirrored(const A& a, const Pose<Dim>& pose_a, const B& b, const Pose<Dim>& pose_b,
                     double margin, std::vector<ContactPoint<Dim>>& out) {
    const std::size_t first = out.size();
    contact_points<Dim>(b, pose_b, a, pose_a, margin, out);
    mirror<Dim>(std::span(out).subspan(first));
}

/// Calls `visit(i, child)` for every child of `compound` that may come within `margin` of `box`.
template <int Dim, class Visit>
void for_children_near(const Compound<Dim>& compound, const Pose<Dim>& pose, const Aabb<Dim>& box,
                       double margin, const Visit& visit) {
    const Aabb<Dim> reach = box.expanded(std::max(margin, 0.0));
    for (std::size_t i = 0; i < compound.children().size(); ++i) {
        const Vector<Dim> centre = pose.point_world(compound.centre(i));
        if (reach.overlaps(Aabb<Dim>{centre, centre}.expanded(compound.bound(i))))
            visit(static_cast<std::uint32_t>(i), compound.children()[i]);
    }
}

/// The contacts of every child of A with B, with the child's number in the codes.
template <int Dim, class B>
void append_children_of_a(const Compound<Dim>& a, const Pose<Dim>& pose_a, const B& b,
                          const Pose<Dim>& pose_b, double margin,
                          std::vector<ContactPoint<Dim>>& out) {
    for_children_near(a, pose_a, b.aabb(pose_b), margin, [&](std::uint32_t i, const auto& child) {
        const std::size_t first = out.size();
        contact_points<Dim>(child, pose_a, b, pose_b, margin, out);
        for (ContactPoint<Dim>& c : std::span(out).subspan(first))
            c.feature = with_child_of_a(c.feature, i);
    });
}

/// The contacts of A with every child of B.
template <int Dim, class A>
void append_children_of_b(const A& a, const Pose<Dim>& pose_a, const Compound<Dim>& b,
                          const Pose<Dim>& pose_b, double margin,
                          std::vector<ContactPoint<Dim>>& out) {
    for_children_near(b, pose_b, a.aabb(pose_a), margin, [&](std::uint32_t i, const auto& child) {
        const std::size_t first = out.size();
        contact_points<Dim>(a, pose_a, child, pose_b, margin, out);
        for (ContactPoint<Dim>& c : std::span(out).subspan(first))
            c.feature = with_child_of_b(c.feature, i);
    });
}

}  // namespace detail

/// Appends to `out` every contact point of two placed shapes whose gap is at most `margin` [m];
/// signs and places as told in contact_point.hpp. The result is a function of the arguments alone;
/// exchanging the shapes gives the mirrored contacts. Two half-spaces have no contacts. `out` keeps
/// its capacity between calls, and nothing else is allocated.
template <int Dim, class A, class B>
void contact_points(const A& a, const Pose<Dim>& pose_a, const B& b, const Pose<Dim>& pose_b,
                    double margin, std::vector<ContactPoint<Dim>>& out) {
    TALUS_CHECK(std::isfinite(margin), "the margin of a contact query is finite");
    TALUS_CHECK(pose_a.position.allFinite() && pose_b.position.allFinite(),
                "the poses of a contact query are finite");
    using Wall = HalfSpace<Dim>;
    if constexpr (is_any_shape<A>) {
        std::visit([&](const auto& s) { contact_points<Dim>(s, pose_a, b, pose_b, margin, out); },
                   a.held());
    } else if constexpr (is_any_shape<B>) {
        std::visit([&](const auto& s) { contact_points<Dim>(a, pose_a, s, pose_b, margin, out); },
                   b.held());
    } else if constexpr (detail::HasPairContacts<Dim, A, B>) {
        PairContacts<Dim, A, B>::append(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (detail::HasPairContacts<Dim, B, A> ||
                         (std::same_as<A, Wall> && !std::same_as<B, Wall>)) {
        detail::append_mirrored<Dim>(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (std::same_as<A, Compound<Dim>>) {
        detail::append_children_of_a<Dim>(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (std::same_as<B, Compound<Dim>>) {
        detail::append_children_of_b<Dim>(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (std::same_as<A, Ball<Dim>> && std::same_as<B, Ball<Dim>>) {
        append_ball_contact<Dim>(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (CoreShape<A, Dim> && CoreShape<B, Dim>) {
        append_core_contacts<Dim>(a.core(), pose_a, b.core(), pose_b, margin, out);
    } else if constexpr (CoreShape<A, Dim> && std::same_as<B, Wall>) {
        append_half_space_contacts<Dim>(a.core(), pose_a, b, pose_b, margin, out);
    } else if constexpr (!std::same_as<A, Wall>) {
        append_support_contact<Dim>(a, pose_a, b, pose_b, margin, out);
    }
}

}  // namespace talus
