// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace talus {

/// Directions in space by their angle to an axis: how a deposit of grains, which nothing
/// distinguishes but the vertical, prefers directions of contact ([Moreau] section 3.3). Equal
/// bands of the angle between 0 and pi / 2, since a normal has no sense.
class AxialHistogram {
  public:
    /// Throws input_error unless the axis has a direction and there are 2 to 100000 bands.
    AxialHistogram(const Vector<3>& axis, std::size_t bands) {
        require_finite("axis of the histogram", axis);
        require_positive("length of the histogram's axis", axis.norm());
        require_in("bands of the histogram", static_cast<double>(bands), 2.0, 1e5);
        axis_ = axis.normalized();
        counts_.assign(bands, 0.0);
    }

    /// Counts a direction, and with it its opposite. Throws input_error unless it has a length.
    void add(const Vector<3>& direction, double weight = 1.0) {
        const double length = require_positive("length of the direction", direction.norm());
        const double c = std::min(1.0, std::abs(axis_.dot(direction)) / length);
        const auto n = static_cast<double>(counts_.size());
        const double band = std::acos(c) / (0.5 * std::numbers::pi) * n;
        counts_[std::min(static_cast<std::size_t>(band), counts_.size() - 1)] += weight;
        total_ += weight;
        // Legendre's polynomials of order 2 and 4.
        const double s = c * c;
        second_ += weight * 0.5 * (3.0 * s - 1.0);
        fourth_ += weight * 0.125 * ((35.0 * s - 30.0) * s + 3.0);
    }

    std::size_t bands() const { return counts_.size(); }
    double count(std::size_t band) const { return counts_.at(band); }
    double total() const { return total_; }
    /// Angle to the axis of the middle of a band [rad].
    double middle(std::size_t band) const { return (static_cast<double>(band) + 0.5) * width(); }
    /// Relative frequency over solid angle [1/sr], opposite directions together: 1 / (2 pi)
    /// everywhere if no direction is preferred.
    double density(std::size_t band) const {
        const double from = static_cast<double>(band) * width();
        const double solid = 2.0 * std::numbers::pi * (std::cos(from) - std::cos(from + width()));
        return total_ > 0.0 ? counts_.at(band) / (total_ * solid) : 0.0;
    }

    /// Coefficients of the density (1 + a2 P2(cos theta) + a4 P4(cos theta)) / (2 pi) in Legendre's
    /// polynomials, a_n = (2 n + 1) <P_n> over all directions counted: no band comes in. 0 before
    /// anything was counted.
    double second() const { return total_ > 0.0 ? 5.0 * second_ / total_ : 0.0; }  ///< a2
    double fourth() const { return total_ > 0.0 ? 9.0 * fourth_ / total_ : 0.0; }  ///< a4
    /// The fitted density at an angle to the axis [rad], [1/sr].
    double fitted_density(double angle) const {
        const double s = std::cos(angle) * std::cos(angle);
        const double p2 = 0.5 * (3.0 * s - 1.0);
        const double p4 = 0.125 * ((35.0 * s - 30.0) * s + 3.0);
        return (1.0 + second() * p2 + fourth() * p4) / (2.0 * std::numbers::pi);
    }
    /// Angle to the axis at which the fitted density is largest, in [0, pi / 2] [rad]. In s = cos^2
    /// it is a parabola.
    double peak() const {
        const double a = 4.375 * fourth(), b = 1.5 * second() - 3.75 * fourth();
        double best = a + b > 0.0 ? 1.0 : 0.0;  // the larger end of a s^2 + b s
        if (a < 0.0) best = std::clamp(-0.5 * b / a, 0.0, 1.0);
        return std::acos(std::sqrt(best));
    }

  private:
    double width() const { return 0.5 * std::numbers::pi / static_cast<double>(counts_.size()); }

    Vector<3> axis_;
    std::vector<double> counts_;
    double total_ = 0.0, second_ = 0.0, fourth_ = 0.0;
};

}  // namespace talus
