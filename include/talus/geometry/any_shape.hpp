// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>

namespace talus {

/// Any shape of talus. For a list with shapes of one's own use AnyShapeOf.
template <int Dim>
using AnyShape = AnyShapeOf<Dim, Ball<Dim>, HalfSpace<Dim>>;

static_assert(SolidShape<AnyShape<2>, 2> && SolidShape<AnyShape<3>, 3>);

}  // namespace talus
