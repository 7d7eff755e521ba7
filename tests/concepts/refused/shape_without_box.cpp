// SPDX-License-Identifier: BSL-1.0
// expect: aabb(
// Every shape tells its box when placed.
#include <talus/collision/narrow_phase.hpp>

struct Mine {
    talus::Vector<2> support(const talus::Vector<2>&) const;
};

void meet(const Mine& mine, talus::Column<talus::ContactPoint<2>>& out) {
    talus::contact_points<2>(mine, talus::Pose<2>{}, mine, talus::Pose<2>{}, 0.0, out);
}
