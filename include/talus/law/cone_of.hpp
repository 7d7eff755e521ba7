// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/concepts.hpp>
#include <talus/law/friction_cone.hpp>

#include <concepts>
#include <optional>
#include <span>
#include <vector>

namespace talus {

/// A law that is Coulomb's on a round cone, after the shift of free velocity that assembly adds:
/// what solvers need that treat all contacts at once. `friction_cone()` may be empty for a law
/// chosen at run time.
template <class L, int Dim>
concept ConeLaw = LawWithoutRolling<L, Dim> && requires(const L& law) {
    { law.friction_cone() } -> std::convertible_to<std::optional<FrictionCone<Dim>>>;
};

/// The cone of any law; nothing for one that has none.
template <int Dim, ContactLaw<Dim> Law>
requires SpaceDimension<Dim> std::optional<FrictionCone<Dim>> cone_of(const Law& law) {
    if constexpr (ConeLaw<Law, Dim>)
        return law.friction_cone();
    else
        return std::nullopt;
}

/// The cones of laws, in their order; nothing if one of them has none.
template <int Dim, ContactLaw<Dim> Law>
requires SpaceDimension<Dim> std::optional<std::vector<FrictionCone<Dim>>> cones_of(
    std::span<const Law> laws) {
    std::vector<FrictionCone<Dim>> cones;
    cones.reserve(laws.size());
    for (const Law& law : laws) {
        const std::optional<FrictionCone<Dim>> cone = cone_of<Dim>(law);
        if (!cone) return std::nullopt;
        cones.push_back(*cone);
    }
    return cones;
}

}  // namespace talus
