// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/concepts.hpp>
#include <talus/law/friction_cone.hpp>

#include <concepts>
#include <optional>

namespace talus {

/// A law that is Coulomb's on a round cone, after the shift of free velocity that assembly adds:
/// what solvers need that treat all contacts at once. `friction_cone()` may be empty for a law
/// chosen at run time.
template <class L, int Dim>
concept ConeLaw = SpaceDimension<Dim> && ContactLaw<L, Dim> && requires(const L& law) {
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

}  // namespace talus
