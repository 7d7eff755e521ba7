// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>

#include <cstdint>
#include <span>
#include <utility>

namespace talus {

/// What part of a shape touches.
enum class FeatureKind : std::uint32_t { vertex, edge, face };

/// A part of one shape: which child of a compound, and which vertex, edge or face of it. In the
/// plane the sides of a polygon are its faces. All zero for shapes without parts.
struct Feature {
    FeatureKind kind = FeatureKind::vertex;
    std::uint32_t index = 0;  ///< below 2^18
    std::uint32_t child = 0;  ///< below 2^12
};

inline constexpr std::uint64_t child_bits = 0xfff;

/// The code of two touching features: for each shape 12 bits of child, 2 of kind, 18 of index, the
/// shape A in the upper half. Codes are thus different for different pairs of features.
constexpr FeatureId feature_code(const Feature& a, const Feature& b) {
    constexpr auto half = [](const Feature& f) {
        return std::uint64_t{f.child} << 20 | static_cast<std::uint64_t>(f.kind) << 18 | f.index;
    };
    return {half(a) << 32 | half(b)};
}

/// The same code with the two shapes exchanged.
constexpr FeatureId mirrored(FeatureId id) { return {id.code << 32 | id.code >> 32}; }

/// The code of a child of A's, or of B's, from the code it gets as if it were alone, whose bits for
/// the number of a child are lost.
constexpr FeatureId with_child_of_a(FeatureId id, std::uint32_t child) {
    return {(id.code & ~(child_bits << 52)) | std::uint64_t{child} << 52};
}
constexpr FeatureId with_child_of_b(FeatureId id, std::uint32_t child) {
    return {(id.code & ~(child_bits << 20)) | std::uint64_t{child} << 20};
}
/// The numbers of the children of A and of B.
constexpr std::uint32_t child_of_a(FeatureId id) {
    return static_cast<std::uint32_t>(id.code >> 52 & child_bits);
}
constexpr std::uint32_t child_of_b(FeatureId id) {
    return static_cast<std::uint32_t>(id.code >> 20 & child_bits);
}

/// Turns contacts of B with A into contacts of A with B.
template <int Dim>
void mirror(std::span<ContactPoint<Dim>> contacts) {
    for (ContactPoint<Dim>& c : contacts) {
        c.normal = -c.normal;
        c.slide = -c.slide;
        c.feature = mirrored(c.feature);
    }
}

}  // namespace talus
