// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <compare>
#include <cstdint>

namespace talus {

/// Index of a body in the arrays of `Bodies`, in the order in which they were added: its own until
/// a body before it is removed (then it is one less). What must last longer is a BodyId.
using BodyIndex = std::int32_t;

/// Name of a body for as long as there is one, whatever else is added or removed; never given twice
/// in one system. Ascending in the order in which bodies were added, as indices are.
struct BodyId {
    std::int64_t serial = -1;  ///< -1: of no body
    friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// Index of a material in a `MaterialTable`.
using MaterialIndex = std::int32_t;

/// Which features of the two shapes touch: the part of a contact's identity that the pair of bodies
/// does not give. Equal in consecutive steps as long as the same features touch, so that impulses
/// can be carried over. A code is opaque: shapes only promise that different contact points of one
/// pair of bodies have different codes.
struct FeatureId {
    std::uint64_t code = 0;
    friend constexpr auto operator<=>(const FeatureId&, const FeatureId&) = default;
};

/// Full identity of a contact over time: two bodies (a < b) and the touching features.
struct ContactKey {
    BodyIndex a = 0;
    BodyIndex b = 0;
    FeatureId feature;
    friend constexpr auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

}  // namespace talus
