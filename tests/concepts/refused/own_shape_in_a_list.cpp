// SPDX-License-Identifier: BSL-1.0
// expect: support(
// A list of shapes is refused for the one that cannot meet the others.
#include <talus/collision/narrow_phase.hpp>

struct Mine {
    talus::Aabb<3> aabb(const talus::Pose<3>&) const;
};
using Shapes = talus::AnyShapeOf<3, talus::Ball<3>, talus::HalfSpace<3>, Mine>;

void meet(const Shapes& a, const Shapes& b, talus::Column<talus::ContactPoint<3>>& out) {
    talus::contact_points<3>(a, talus::Pose<3>{}, b, talus::Pose<3>{}, 0.0, out);
}
