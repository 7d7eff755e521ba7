// SPDX-License-Identifier: BSL-1.0
// expect: support(
// Contact detection forms pairs of all that a scene may hold.
#include <talus/assembly/contact_detection.hpp>
#include <talus/collision/brute_force.hpp>

struct Mine {
    talus::Aabb<3> aabb(const talus::Pose<3>&) const;
};
using Shapes = talus::AnyShapeOf<3, talus::Ball<3>, Mine>;

talus::ContactDetection<3, Shapes, talus::BruteForce<3>> detection;
