// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/dimension.hpp>
#include <talus/core/input.hpp>
#include <talus/core/model.hpp>
#include <talus/sample/random.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

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
TALUS_MODEL(RadiusLaw<UniformRadii>);

/// Radii in [low, high] with probability density proportional to r^-exponent. In space exponent 4
/// gives equal volumes in equal intervals of log r, exponent 3 in equal intervals of r (in the
/// plane 3 and 2): uniform by mass. Exponent 0 is the uniform law, by number.
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
TALUS_MODEL(RadiusLaw<PowerLawRadii>);

/// Radii whose logarithm is normal, those outside [low, high] drawn again.
class LogNormalRadii {
  public:
    /// `median` and ends in [m], `sigma` the deviation of log r. Throws input_error unless
    /// 0 < low <= high, the median is positive, sigma in (0, 5], and at least a thousandth of the
    /// law lies between the ends.
    LogNormalRadii(double median, double sigma, double low, double high)
        : median_(require_positive("median radius [m]", median)),
          sigma_(require_in("deviation of the logarithm of radii", sigma, 1e-6, 5.0)),
          low_(require_positive("smallest radius [m]", low)),
          high_(require_in("largest radius [m]", high, low, 1e6)) {
        require_in("share of the log-normal law between its ends", share(), 1e-3, 1.0);
    }

    /// The method of Box and Muller, its second number left.
    double operator()(Random& random) const {
        for (;;) {
            const double x = 1.0 - random.uniform(), y = random.uniform();
            const double z = std::sqrt(-2.0 * std::log(x)) * std::cos(2.0 * std::numbers::pi * y);
            const double r = median_ * std::exp(sigma_ * z);
            if (r >= low_ && r <= high_) return r;
        }
    }
    double mean() const {
        return median_ * std::exp(0.5 * sigma_ * sigma_) *
               (below(steps(high_) - sigma_) - below(steps(low_) - sigma_)) / share();
    }
    double low_end() const { return low_; }
    double high_end() const { return high_; }

  private:
    double steps(double r) const { return std::log(r / median_) / sigma_; }
    /// Share of the normal law.
    static double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
    double share() const { return below(steps(high_)) - below(steps(low_)); }

    double median_, sigma_, low_, high_;
};
TALUS_MODEL(RadiusLaw<LogNormalRadii>);

/// Radii with the masses that a sieve curve gives: of all mass, the share of grains up to each
/// radius. Between two points of the curve mass is uniform in the radius; two points at one radius
/// are grains of that size. Mass goes as r^Dim.
template <int Dim>
requires SpaceDimension<Dim>
class SieveCurve {
  public:
    struct Point {
        double radius;  ///< [m]
        double share;   ///< of the mass, of grains up to that radius [-]
    };

    /// Throws input_error naming the point unless there are two or more, radii positive and neither
    /// they nor shares descend, shares go from 0 to 1.
    explicit SieveCurve(const std::vector<Point>& points) {
        if (points.size() < 2)
            detail::reject("number of points of the sieve curve",
                           static_cast<double>(points.size()), "at least 2");
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::string at = detail::numbered(" of point", k, " of the sieve curve");
            const double r = k == 0 ? 0.0 : points[k - 1].radius;
            const double s = k == 0 ? 0.0 : points[k - 1].share;
            require_positive("radius" + at, points[k].radius);
            require_in("radius" + at, points[k].radius, r, 1e6);
            require_in("share" + at, points[k].share, s, k == 0 ? 0.0 : 1.0);
        }
        require_in("last share of the sieve curve", points.back().share, 1.0, 1.0);
        double sum = 0.0;
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const double mass = points[k + 1].share - points[k].share;
            if (mass == 0.0) continue;
            pieces_.emplace_back(points[k].radius, points[k + 1].radius, Dim);
            weight_.push_back(sum += mass / mean_power(points[k].radius, points[k + 1].radius));
        }
    }

    double operator()(Random& random) const {
        const double x = random.uniform() * weight_.back();
        const auto k = std::upper_bound(weight_.begin(), weight_.end() - 1, x) - weight_.begin();
        return pieces_[static_cast<std::size_t>(k)](random);
    }
    double mean() const {
        double sum = 0.0;
        for (std::size_t k = 0; k < pieces_.size(); ++k)
            sum += (weight_[k] - (k == 0 ? 0.0 : weight_[k - 1])) * pieces_[k].mean();
        return sum / weight_.back();
    }
    double low_end() const { return pieces_.front().low_end(); }
    double high_end() const { return pieces_.back().high_end(); }

  private:
    /// Mass of a grain of the piece, on the average by number, for density 1 and volume r^Dim: the
    /// density of numbers is that of masses over r^Dim.
    static double mean_power(double low, double high) {
        if (high == low) return std::pow(low, Dim);
        const double e = Dim - 1.0;
        return e * (high - low) / (std::pow(low, -e) - std::pow(high, -e));
    }

    std::vector<PowerLawRadii> pieces_;
    std::vector<double> weight_;  // of numbers, summed up
};
TALUS_MODEL(RadiusLaw<SieveCurve<2>>);
TALUS_MODEL(RadiusLaw<SieveCurve<3>>);

}  // namespace talus
