// SPDX-License-Identifier: BSL-1.0
// expect: find_pairs(
// A broad phase is asked with the question who is an obstacle.
#include <talus/assembly/contact_detection.hpp>

struct Blind {
    void find_pairs(std::span<const talus::Aabb<3>>, talus::Column<talus::CandidatePair>&);
};

talus::ContactDetection<3, talus::Ball<3>, Blind> detection;
