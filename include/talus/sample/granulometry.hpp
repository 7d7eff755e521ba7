// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/random.hpp>

#include <cmath>
#include <concepts>

namespace talus {

/// A distribution of grain radii.
template <class L>
concept RadiusLaw = std::copyable<L> && requires(const L& law, Random& random) {
    { law(random) } -> std::convertible_to<double>;     // one radius [m]
    { law.mean() } -> std::convertible_to<double>;      // expectation [m]
    { law.low_end() } -> std::convertible_to<double>;   // no radius is smaller [m]
    { law.high_end() } -> std::convertible_to<double>;  // no radius is larger [m]
};

/// Radii uniform in [low, high].
class UniformRadii {
  public:
    /// Both in [m]; throws input_error unless 0 < low <= high.
    UniformRadii(double low, double high)
        : low_(require_positive("smallest radius [m]", low)),
          high_(require_in("largest radius [m]", high, low, 1e6)) {}

    double operator()(Random& random) const { return random.uniform(low_, high_); }
    double mean() const { return 0.5 * (low_ + high_); }
    double low_end() const { return low_; }
    double high_end() const { return high_; }

  private:
    double low_, high_;
};
static_assert(RadiusLaw<UniformRadii>);

/// Radii in [low, high] with probability density proportional to r^-exponent. In space exponent 4
/// gives equal volumes in equal intervals of log r, exponent 0 is the uniform law.
class PowerLawRadii {
  public:
    /// Throws input_error unless 0 < low <= high [m] and the exponent lies in [0, 20].
    PowerLawRadii(double low, double high, double exponent)
        : low_(require_positive("smallest radius [m]", low)),
          high_(require_in("largest radius [m]", high, low, 1e6)),
          exponent_(require_in("exponent of the power law", exponent, 0.0, 20.0)) {}

    /// Inverse of the cumulative distribution at a uniform number.
    double operator()(Random& random) const {
        const double x = random.uniform();
        const double e = 1.0 - exponent_;
        const double ratio = high_ / low_;
        const double r = near_zero(e)
                             ? low_ * std::pow(ratio, x)
                             : low_ * std::pow(1.0 + x * (std::pow(ratio, e) - 1.0), 1.0 / e);
        return std::fmin(std::fmax(r, low_), high_);
    }
    double mean() const {
        if (high_ == low_) return low_;
        return power_integral(1.0 - exponent_) / power_integral(-exponent_);
    }
    double low_end() const { return low_; }
    double high_end() const { return high_; }

  private:
    /// Below this an exponent is a logarithm to rounding.
    static bool near_zero(double e) { return std::abs(e) < 1e-9; }
    /// Integral of r^p over [low, high].
    double power_integral(double p) const {
        if (near_zero(p + 1.0)) return std::log(high_ / low_);
        return (std::pow(high_, p + 1.0) - std::pow(low_, p + 1.0)) / (p + 1.0);
    }
    double low_, high_, exponent_;
};
static_assert(RadiusLaw<PowerLawRadii>);

}  // namespace talus
