// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/compound.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>

namespace talus {

/// Any shape of talus. For a list with shapes of one's own use AnyShapeOf.
template <int Dim>
using AnyShape = AnyShapeOf<Dim, Ball<Dim>, HalfSpace<Dim>, Capsule<Dim>, Box<Dim>,
                            ConvexPolytope<Dim>, Compound<Dim>, RoundHole<Dim>>;

TALUS_MODEL(SolidShape<AnyShape<2>, 2>);
TALUS_MODEL(SolidShape<AnyShape<3>, 3>);
// Shapes are copied freely: large data is shared.
TALUS_MODEL(sizeof(AnyShape<2>) <= 48);
TALUS_MODEL(sizeof(AnyShape<3>) <= 48);

}  // namespace talus
