// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/block_average.hpp>

#include <vector>

namespace lab {

/// Mean of a list of values, with an error that knows that neighbours are alike.
inline talus::BlockAverage average_of(const std::vector<double>& values) {
    talus::BlockAverage average;
    for (const double v : values) average.add(v);
    return average;
}

}  // namespace lab
