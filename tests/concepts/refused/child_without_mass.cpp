// SPDX-License-Identifier: BSL-1.0
// expect: mass_properties(
// Children of a compound are solids.
#include <talus/geometry/compound.hpp>
#include <talus/geometry/half_space.hpp>

using Clump = talus::CompoundOf<3, talus::HalfSpace<3>>;
