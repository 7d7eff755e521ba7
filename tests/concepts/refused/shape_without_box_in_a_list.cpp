// SPDX-License-Identifier: BSL-1.0
// expect: aabb(
#include <talus/geometry/any_shape_of.hpp>

struct Mine {
    talus::Vector<2> support(const talus::Vector<2>&) const;
};
using Shapes = talus::AnyShapeOf<2, Mine>;
