// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>

#include <cstdint>
#include <span>

namespace talus {

/// The shapes of all bodies, in the bodies' frames, as contacts are looked for between them.
template <int Dim, class ShapeType>
requires SpaceDimension<Dim>
struct ShapeList {
    std::span<const ShapeType> shapes;
    std::span<const double> bounding_radius;  ///< about the body's centre; infinite without end [m]
    std::uint64_t version = 0;                ///< another one whenever some shape is another
    NarrowRoutines<Dim> routines = narrow_routines<Dim, ShapeType>;
};

}  // namespace talus
