// SPDX-License-Identifier: BSL-1.0
#include <talus/core/version.hpp>
#include <talus/spatial/pose.hpp>

#include <numbers>

/// Succeeds when a quarter turn carries the first axis to the second.
int main() {
    const talus::Pose<2> pose{{1.0, 2.0}, talus::Rotation<2>(std::numbers::pi / 2)};
    const talus::Vector<2> image = pose.point_world({1.0, 0.0});
    return (image - talus::Vector<2>(1.0, 3.0)).norm() < 1e-15 && talus::version.major >= 0 ? 0 : 1;
}
