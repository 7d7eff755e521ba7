// SPDX-License-Identifier: BSL-1.0
// expect: support(
// A shape that tells no more than its box cannot meet a ball.
#include <talus/collision/narrow_phase.hpp>

struct Mine {
    talus::Aabb<3> aabb(const talus::Pose<3>&) const;
};

void meet(const Mine& mine, talus::Column<talus::ContactPoint<3>>& out) {
    talus::contact_points<3>(mine, talus::Pose<3>{}, talus::Ball<3>(1.0), talus::Pose<3>{}, 0.0,
                             out);
}
