// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// How a set of forces is spread: normal forces of contacts, or loads of grains.
struct ForceStatistics {
    std::size_t count = 0;  ///< of forces above zero: all that follows is of these
    double mean = 0.0;      ///< <f>, in the unit of the forces
    double largest = 0.0;
    /// Part of them below the mean: some 0.6 in packings of rigid grains [Radjai1996].
    double share_below_mean = 0.0;
    /// b of P(f) ~ exp(-b f / <f>) above the mean, by maximum likelihood: the inverse of the mean
    /// excess over it; 0 where none is above. Some 1.4 for discs [Radjai1996].
    double decay = 0.0;
    double decay_error = 0.0;  ///< its standard error, b / sqrt(forces above the mean)
    /// 0 where all are equal, towards 1 where one has all.
    double gini = 0.0;
};

namespace detail {

inline std::vector<double> positive_forces(std::span<const double> forces) {
    std::vector<double> found;
    for (std::size_t k = 0; k < forces.size(); ++k) {
        if (!std::isfinite(forces[k])) reject(numbered("force", k), forces[k], "finite");
        if (forces[k] > 0.0) found.push_back(forces[k]);
    }
    return found;
}

}  // namespace detail

/// Forces that are zero or negative are those of contacts that do not push, and are left out.
/// Throws input_error for one that is not finite. O(n log n).
inline ForceStatistics force_statistics(std::span<const double> forces) {
    std::vector<double> f = detail::positive_forces(forces);
    ForceStatistics result;
    if (f.empty()) return result;
    std::sort(f.begin(), f.end());
    const auto n = static_cast<double>(f.size());
    double sum = 0.0, ranked = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k) {
        sum += f[k];
        ranked += static_cast<double>(k + 1) * f[k];
    }
    result.count = f.size();
    result.mean = sum / n;
    result.largest = f.back();
    result.gini = std::max(0.0, 2.0 * ranked / (n * sum) - (n + 1.0) / n);
    const auto above = std::upper_bound(f.begin(), f.end(), result.mean);
    result.share_below_mean =
        static_cast<double>(std::lower_bound(f.begin(), f.end(), result.mean) - f.begin()) / n;
    double excess = 0.0;
    for (auto it = above; it != f.end(); ++it) excess += *it / result.mean - 1.0;
    const auto count_above = static_cast<double>(f.end() - above);
    if (excess > 0.0) {
        result.decay = count_above / excess;
        result.decay_error = result.decay / std::sqrt(count_above);
    }
    return result;
}

/// Probability density of f / <f> in `bins` equal bins from 0 to `widest` [-]; what lies beyond is
/// counted in the total alone. Throws input_error unless there is a bin and `widest` is positive.
inline std::vector<double> force_density(std::span<const double> forces, std::size_t bins,
                                         double widest) {
    require_in("bins", static_cast<double>(bins), 1.0, 1e7);
    require_positive("widest", widest);
    const std::vector<double> f = detail::positive_forces(forces);
    std::vector<double> density(bins, 0.0);
    if (f.empty()) return density;
    double mean = 0.0;
    for (const double x : f) mean += x / static_cast<double>(f.size());
    const double width = widest / static_cast<double>(bins);
    for (const double x : f) {
        const double bin = std::floor(x / mean / width);
        if (bin < static_cast<double>(bins))
            density[static_cast<std::size_t>(bin)] += 1.0 / (static_cast<double>(f.size()) * width);
    }
    return density;
}

}  // namespace talus
