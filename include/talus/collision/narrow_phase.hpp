// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>
#include <talus/collision/simple_pairs.hpp>
#include <talus/core/check.hpp>
#include <talus/geometry/any_shape_of.hpp>

#include <cmath>
#include <span>
#include <variant>
#include <vector>

namespace talus {

/// Contact routine for a pair of one's own shape types, preferred to everything talus knows:
/// specialise with a static function `append` of the signature of contact_points. One order of the
/// two types is enough, the other is served by mirroring.
template <int Dim, class A, class B>
struct PairContacts {};

namespace detail {

template <int Dim, class A, class B>
concept HasPairContacts = requires(const A& a, const B& b, const Pose<Dim>& pose,
                                   std::vector<ContactPoint<Dim>>& out) {
    PairContacts<Dim, A, B>::append(a, pose, b, pose, 0.0, out);
};

}  // namespace detail

/// Appends to `out` every contact point of two placed shapes whose gap is at most `margin` [m];
/// signs and places as told in contact_point.hpp. The result is a function of the arguments alone;
/// exchanging the shapes gives the mirrored contacts. Two half-spaces have no contacts. `out` keeps
/// its capacity between calls, and nothing else is allocated.
template <int Dim, class A, class B>
void contact_points(const A& a, const Pose<Dim>& pose_a, const B& b, const Pose<Dim>& pose_b,
                    double margin, std::vector<ContactPoint<Dim>>& out) {
    TALUS_CHECK(std::isfinite(margin), "the margin of a contact query is finite");
    if constexpr (is_any_shape<A>) {
        std::visit([&](const auto& s) { contact_points<Dim>(s, pose_a, b, pose_b, margin, out); },
                   a.held());
    } else if constexpr (is_any_shape<B>) {
        std::visit([&](const auto& s) { contact_points<Dim>(a, pose_a, s, pose_b, margin, out); },
                   b.held());
    } else if constexpr (detail::HasPairContacts<Dim, A, B>) {
        PairContacts<Dim, A, B>::append(a, pose_a, b, pose_b, margin, out);
    } else if constexpr (detail::HasPairContacts<Dim, B, A>) {
        const std::size_t first = out.size();
        PairContacts<Dim, B, A>::append(b, pose_b, a, pose_a, margin, out);
        mirror<Dim>(std::span(out).subspan(first));
    } else {
        append_contacts<Dim>(a, pose_a, b, pose_b, margin, out);
    }
}

}  // namespace talus
