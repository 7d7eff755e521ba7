// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace talus {

/// Mean of a series in time, with an error that knows that neighbours in time are alike.
///
/// Values are averaged in pairs, the pairs in pairs, and so on: the standard error computed from
/// blocks grows with their length until they are longer than what the series remembers, and is
/// right from there on [FlyvbjergPetersen1989]. O(1) in time and O(log n) in memory per value.
class BlockAverage {
  public:
    /// Throws input_error for a value that is not finite.
    void add(double value) {
        if (!std::isfinite(value)) detail::reject("value of a block average", value, "finite");
        for (std::size_t k = 0;; ++k) {
            if (k == levels_.size()) levels_.push_back({});
            Level& level = levels_[k];
            ++level.count;
            // Welford's update.
            const double off = value - level.mean;
            level.mean += off / static_cast<double>(level.count);
            level.squares += off * (value - level.mean);
            if (level.count % 2 != 0) {
                level.left = value;
                return;
            }
            value = 0.5 * (level.left + value);
        }
    }

    std::size_t count() const { return levels_.empty() ? 0 : levels_[0].count; }
    /// 0 without values.
    double mean() const { return levels_.empty() ? 0.0 : levels_[0].mean; }
    /// Standard deviation of single values; 0 for fewer than two.
    double deviation() const {
        return count() < 2 ? 0.0 : std::sqrt(levels_[0].squares / static_cast<double>(count() - 1));
    }
    /// Standard error of the mean: the largest over the lengths of blocks of which there are at
    /// least `least_blocks`; infinite while there are fewer than that of single values.
    double error(std::size_t least_blocks = 16) const {
        double largest =
            count() < least_blocks || count() < 2 ? std::numeric_limits<double>::infinity() : 0.0;
        for (std::size_t k = 0; k < levels_.size(); ++k)
            if (levels_[k].count >= least_blocks && levels_[k].count > 1)
                largest = std::max(largest, error_from(k));
        return largest;
    }
    /// From blocks of 2^k values: what to look at for a plateau.
    double error_from(std::size_t k) const {
        if (k >= levels_.size() || levels_[k].count < 2)
            return std::numeric_limits<double>::infinity();
        const auto n = static_cast<double>(levels_[k].count);
        return std::sqrt(levels_[k].squares / (n * (n - 1.0)));
    }

  private:
    struct Level {
        std::size_t count = 0;
        double mean = 0.0, squares = 0.0;  ///< squares: of the distances from the mean
        double left = 0.0;                 ///< the value that waits for its neighbour
    };
    std::vector<Level> levels_;
};

}  // namespace talus
