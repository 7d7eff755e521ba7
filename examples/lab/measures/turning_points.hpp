// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "../table.hpp"
#include "averages.hpp"

namespace lab {

/// The peaks and valleys of a series, those apart from each other by at least an amplitude: a value
/// is a peak once the series has fallen by so much below it, and a valley once it has risen.
class TurningPoints {
  public:
    explicit TurningPoints(double amplitude) : amplitude_(amplitude) {}

    void add(double value) {
        if (!std::isfinite(value)) return;
        if (extreme_.empty()) {
            high_ = std::max(high_, value);
            low_ = std::min(low_, value);
            if (value <= high_ - amplitude_)
                extreme_ = {high_, value};  // begins with a peak
            else if (value >= low_ + amplitude_)
                extreme_ = {-infinity, low_, value};
            return;
        }
        // The last of them is not final yet: the even ones are peaks.
        const bool falling = extreme_.size() % 2 == 0;
        double& last = extreme_.back();
        if (falling ? value < last : value > last)
            last = value;
        else if (falling ? value >= last + amplitude_ : value <= last - amplitude_)
            extreme_.push_back(value);
    }
    /// Those that are final, in their order, without the one that the series began with.
    std::vector<double> peaks() const { return every_other(0); }
    std::vector<double> valleys() const { return every_other(1); }

    /// Angles of a surface [degrees]: it falls in avalanches from the limit angle to that of
    /// repose.
    void print_avalanches() const {
        std::printf(
            "%zu avalanches of %g degrees or more: angle of repose %.1f, limit angle %.1f degrees "
            "(the\n    paper: some 25 and 29)\n",
            valleys().size(), amplitude_, mean_of(valleys()), mean_of(peaks()));
    }
    std::vector<Finding> findings() const {
        const double repose = mean_of(valleys());
        return {{"avalanches", "-", static_cast<double>(valleys().size())},
                {"angle of repose", "degrees", repose},
                {"limit angle less angle of repose", "degrees", mean_of(peaks()) - repose}};
    }

    void write(talus::NumberRecord& out) const {
        out.real(high_);
        out.real(low_);
        out.integer(static_cast<std::int64_t>(extreme_.size()));
        for (const double x : extreme_) out.real(x);
    }
    void restore(const talus::NumberRecord& record) {
        talus::NumberRecordReader in(record);
        TurningPoints other(amplitude_);
        other.high_ = in.real();
        other.low_ = in.real();
        other.extreme_.resize(static_cast<std::size_t>(in.integer(0)));
        for (double& x : other.extreme_) x = in.real();
        in.require_end();
        *this = other;
    }

  private:
    static double mean_of(const std::vector<double>& angles) {
        return angles.empty() ? std::nan("") : average_of(angles).mean();
    }
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> every_other(std::size_t first) const {
        std::vector<double> found;
        const std::size_t begin = extreme_.empty() || std::isfinite(extreme_[0]) ? 1 : 2;
        for (std::size_t k = first; k + 1 < extreme_.size(); k += 2)
            if (k >= begin) found.push_back(extreme_[k]);
        return found;
    }

    double amplitude_, high_ = -infinity, low_ = infinity;
    std::vector<double> extreme_;  // peak, valley, peak...; the first may be none
};

}  // namespace lab
