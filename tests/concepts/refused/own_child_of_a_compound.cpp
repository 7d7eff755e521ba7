// SPDX-License-Identifier: BSL-1.0
// expect: support(
// A compound meets others by its children.
#include <talus/collision/narrow_phase.hpp>

struct Mine {
    talus::Aabb<2> aabb(const talus::Pose<2>&) const;
    talus::MassProperties<2> mass_properties() const;
    Mine placed(const talus::Pose<2>&) const;
};
using Clump = talus::CompoundOf<2, talus::AnyShapeOf<2, talus::Ball<2>, Mine>>;

void meet(const Clump& clump, talus::Column<talus::ContactPoint<2>>& out) {
    talus::contact_points<2>(clump, talus::Pose<2>{}, talus::Ball<2>(1.0), talus::Pose<2>{}, 0.0,
                             out);
}
