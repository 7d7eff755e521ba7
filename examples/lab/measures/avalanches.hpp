// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/series/csv_series.hpp>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "../plot.hpp"
#include "averages.hpp"
#include "turning_points.hpp"

namespace lab {

/// The lean of a drum's surface while it turns at one speed.
struct Turning {
    std::string name;
    double turns;               ///< [1/s]
    std::vector<double> angle;  ///< [degrees]

    /// Of the acceleration at the wall over gravity [m, m/s^2].
    double froude(double radius, double gravity) const {
        const double spin = 2.0 * std::numbers::pi * turns;
        return spin * spin * radius / gravity;
    }
};

/// `angle.csv` and `angle.svg` of one after another, an angle each `interval` [s].
inline void write_angles(const std::filesystem::path& folder, const std::vector<Turning>& all,
                         double interval) {
    talus::CsvSeries table(folder / "angle.csv", {{"turns", "1/s"}, {"angle", "deg"}});
    Plot plot{"Surface of a rotating drum", "time [s]", "angle [degrees]", {}};
    double t = 0.0;
    for (const Turning& turning : all) {
        Curve curve{turning.name, {}, {}};
        for (const double angle : turning.angle) {
            table.add(t += interval, {turning.turns, angle});
            curve.x.push_back(t);
            curve.y.push_back(angle);
        }
        plot.curves.push_back(curve);
    }
    write_plot(folder / "angle.svg", plot);
}

/// Mean with its error, from so many blocks at least.
inline void print_mean_angle(const char* words, const std::vector<double>& degrees,
                             std::size_t blocks) {
    const talus::BlockAverage average = average_of(degrees);
    std::printf("%s %.1f +- %.1f degrees", words, average.mean(), average.error(blocks));
}

/// How many avalanches there were, and the angles at which they began and ended; they fall by a
/// threshold at least [degrees].
inline void print_avalanches(const std::vector<double>& degrees, double threshold) {
    TurningPoints turns(threshold);
    for (const double angle : degrees) turns.add(angle);
    const auto peaks = turns.peaks(), valleys = turns.valleys();
    std::printf("%zu avalanches", peaks.size());
    if (!peaks.empty()) print_mean_angle(", start at", peaks, 2);
    if (!valleys.empty()) print_mean_angle(", repose at", valleys, 2);
    std::printf("\n");
}

}  // namespace lab
