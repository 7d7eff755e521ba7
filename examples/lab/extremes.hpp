// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <span>
#include <vector>

namespace lab {

/// The turning points of a series: each maximum and minimum between which it went by more than a
/// threshold, in the order of time, without the ways before the first and after the last. What
/// rattles by less is not seen.
struct Extremes {
    std::vector<double> maxima, minima;

    Extremes(std::span<const double> values, double threshold) {
        if (values.empty()) return;
        double low = values[0], high = values[0];
        int way = 0;  // 1: up, -1: down, 0: not known
        for (const double v : values) {
            if (way >= 0 && v > high) high = v;
            if (way <= 0 && v < low) low = v;
            if (way >= 0 && v < high - threshold) {
                if (way > 0) maxima.push_back(high);
                way = -1;
                low = v;
            } else if (way <= 0 && v > low + threshold) {
                if (way < 0) minima.push_back(low);
                way = 1;
                high = v;
            }
        }
    }
};

}  // namespace lab
