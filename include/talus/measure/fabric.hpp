// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace talus {

/// Counts of directions in the plane over equal sectors of the full turn, the first one beginning
/// at the first axis ([Moreau] section 3.3 has 24).
class DirectionHistogram {
  public:
    /// Throws input_error unless there are 3 to 100000 sectors.
    explicit DirectionHistogram(std::size_t sectors) {
        require_in("sectors of the histogram", static_cast<double>(sectors), 3.0, 1e5);
        counts_.assign(sectors, 0.0);
    }

    /// Counts a direction of any length but zero. A contact normal has no sense: add both.
    void add(const Vector<2>& direction, double weight = 1.0) {
        const double turn = std::atan2(direction[1], direction[0]) / (2.0 * std::numbers::pi);
        const double from_axis = turn < 0.0 ? turn + 1.0 : turn;
        const auto n = counts_.size();
        counts_[static_cast<std::size_t>(from_axis * static_cast<double>(n)) % n] += weight;
        total_ += weight;
    }
    /// The direction and its opposite.
    void add_normal(const Vector<2>& normal, double weight = 1.0) {
        add(normal, weight);
        add(-normal, weight);
    }

    std::size_t sectors() const { return counts_.size(); }
    double count(std::size_t sector) const { return counts_.at(sector); }
    double total() const { return total_; }
    /// Angle of the middle of a sector [rad].
    double middle(std::size_t sector) const {
        return 2.0 * std::numbers::pi * (static_cast<double>(sector) + 0.5) /
               static_cast<double>(sectors());
    }
    /// Relative frequency per radian [1/rad]; 1 / (2 pi) everywhere if no direction is preferred.
    double density(std::size_t sector) const {
        return total_ > 0.0 ? counts_.at(sector) * static_cast<double>(sectors()) /
                                  (2.0 * std::numbers::pi * total_)
                            : 0.0;
    }

  private:
    std::vector<double> counts_;
    double total_ = 0.0;
};

/// One term of a density (1 + sum_n a_n cos n (theta - theta_n)) / (2 pi).
struct FabricHarmonic {
    int order = 2;           ///< n
    double amplitude = 0.0;  ///< a_n [-], not negative
    double direction = 0.0;  ///< theta_n in [0, 2 pi / n) [rad]
};

/// Least-squares fit of a density's harmonic of order n to a histogram. The sums over equal sectors
/// are orthogonal, so that each order stands alone; a sector of width d averages cos n theta, which
/// multiplies its amplitude by sin(n d / 2) / (n d / 2), taken back here. Throws input_error unless
/// 1 <= n < sectors / 2 and something was counted.
inline FabricHarmonic fit_harmonic(const DirectionHistogram& histogram, int order) {
    const auto n = static_cast<double>(histogram.sectors());
    require_in("order of the harmonic", order, 1.0, std::ceil(n / 2.0) - 1.0);
    require_positive("total of the histogram", histogram.total());
    double cosine = 0.0, sine = 0.0;
    for (std::size_t k = 0; k < histogram.sectors(); ++k) {
        const double share = 2.0 * histogram.count(k) / histogram.total();
        cosine += share * std::cos(order * histogram.middle(k));
        sine += share * std::sin(order * histogram.middle(k));
    }
    const double half_width = order * std::numbers::pi / n;
    const double averaged = std::sin(half_width) / half_width;
    double phase = std::atan2(sine, cosine) / order;
    if (phase < 0.0) phase += 2.0 * std::numbers::pi / order;
    return {order, std::hypot(cosine, sine) / averaged, phase};
}

}  // namespace talus
