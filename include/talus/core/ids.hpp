// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
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

/// Which image of a body in a periodic cell: by how many lattice vectors it is shifted (those that
/// the dimension does not have are 0). All zero: the body itself.
struct ImageShift {
    std::array<std::int32_t, 3> n = {};
    bool is_zero() const { return *this == ImageShift{}; }
    friend constexpr auto operator<=>(const ImageShift&, const ImageShift&) = default;
};

/// Full identity of a contact over time: two bodies (a < b) and the touching features. In a
/// periodic cell a touches an image of b. In the order a, b, image, feature.
struct ContactKey {
    BodyIndex a = 0;
    BodyIndex b = 0;
    FeatureId feature;
    ImageShift image = {};  ///< of b
    friend constexpr bool operator==(const ContactKey&, const ContactKey&) = default;
    friend constexpr std::strong_ordering operator<=>(const ContactKey& x, const ContactKey& y) {
        if (x.a != y.a) return x.a <=> y.a;
        if (x.b != y.b) return x.b <=> y.b;
        if (x.image != y.image) return x.image <=> y.image;
        return x.feature <=> y.feature;
    }
};

}  // namespace talus
