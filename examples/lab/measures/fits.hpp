// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/measure/rings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace lab {

/// The part of the scatter of y that `f(x)` explains [-]; below 0 if it is worse than the mean.
template <class F>
double r_squared(std::span<const double> x, std::span<const double> y, F&& f) {
    double mean = 0.0, left = 0.0, all = 0.0;
    for (const double v : y) mean += v / static_cast<double>(y.size());
    for (std::size_t k = 0; k < y.size(); ++k) {
        left += (y[k] - f(x[k])) * (y[k] - f(x[k]));
        all += (y[k] - mean) * (y[k] - mean);
    }
    return 1.0 - left / all;
}

/// A power law y = factor (x - offset)^exponent.
struct PowerFit {
    double factor = 0.0, exponent = 0.0, offset = 0.0;
    double r_squared = 0.0;  ///< of the logarithms [-]
    double operator()(double x) const { return factor * std::pow(x - offset, exponent); }
};

/// The least squares of log y over log(x - offset), at a given offset. Throws input_error unless
/// there are two points of different x, all with x above the offset and y above 0.
inline PowerFit fit_power(std::span<const double> x, std::span<const double> y,
                          double offset = 0.0) {
    talus::require_count("ordinates", y.size(), "abscissae", x.size());
    std::vector<double> log_x, log_y;
    for (std::size_t k = 0; k < x.size(); ++k) {
        log_x.push_back(std::log(talus::require_positive("x of a power law", x[k] - offset)));
        log_y.push_back(std::log(talus::require_positive("y of a power law", y[k])));
    }
    const talus::LineFit line = talus::fit_line(log_x, log_y);
    return {std::exp(line.at_zero), line.slope, offset,
            r_squared(log_x, log_y, [&](double u) { return line.at_zero + line.slope * u; })};
}

/// The best of 101 offsets from `low` to `high`; throws as above.
inline PowerFit fit_offset_power(std::span<const double> x, std::span<const double> y, double low,
                                 double high) {
    PowerFit best;
    for (int k = 0; k <= 100; ++k) {
        const PowerFit fit = fit_power(x, y, low + 0.01 * k * (high - low));
        if (k == 0 || fit.r_squared > best.r_squared) best = fit;
    }
    return best;
}

/// What saturates, y = limit (1 - exp(-x / limit)), which begins with slope 1.
struct SaturationFit {
    double limit = 0.0;      ///< of y
    double error = 0.0;      ///< standard error of the limit
    double r_squared = 0.0;  ///< [-]
    double operator()(double x) const { return -limit * std::expm1(-x / limit); }
};

/// Least squares by Gauss and Newton, on s = log(limit): with u = x / limit the slope of y by s is
/// limit (1 - (1 + u) e^-u). Begins with the largest y and halves a step that makes it worse.
/// Throws input_error unless there are two points or more and a y above 0.
inline SaturationFit fit_saturation(std::span<const double> x, std::span<const double> y) {
    talus::require_count("ordinates", y.size(), "abscissae", x.size());
    talus::require_in("points of a saturation", static_cast<double>(x.size()), 2.0, 1e15);
    SaturationFit fit{.limit = talus::require_positive("largest y of a saturation",
                                                       *std::max_element(y.begin(), y.end()))};
    const auto squares = [&] {
        double sum = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) sum += std::pow(y[k] - fit(x[k]), 2);
        return sum;
    };
    double square = 0.0;
    for (int turn = 0; turn < 200; ++turn) {
        double product = 0.0;
        square = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double u = x[k] / fit.limit;
            const double slope = fit.limit * (1.0 - (1.0 + u) * std::exp(-u));
            product += slope * (y[k] - fit(x[k]));
            square += slope * slope;
        }
        const double before = squares(), limit = fit.limit;
        double way = square > 0.0 ? std::clamp(product / square, -1.0, 1.0) : 0.0;
        for (fit.limit = limit * std::exp(way); squares() > before && std::abs(way) > 1e-14;
             fit.limit = limit * std::exp(way))
            way *= 0.5;
        if (std::abs(way) < 1e-12) break;
    }
    fit.error = fit.limit * std::sqrt(squares() / (static_cast<double>(x.size()) - 1.0) /
                                      std::max(square, 1e-300));
    fit.r_squared = r_squared(x, y, fit);
    return fit;
}

}  // namespace lab
