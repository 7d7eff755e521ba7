// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/fabric.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lab {

/// One row of points of a plot.
struct Curve {
    std::string name;
    std::vector<double> x, y;  ///< what is not finite is left out
    bool points = false;       ///< marks in place of a line
};

/// A function between two abscissae.
template <class F>
Curve curve_of(const std::string& name, F&& f, double low, double high) {
    Curve curve{name, {}, {}};
    for (int k = 0; k <= 100; ++k) {
        curve.x.push_back(low + 0.01 * k * (high - low));
        curve.y.push_back(f(curve.x.back()));
    }
    return curve;
}

/// Two axes with ticks, lines and marks.
struct Plot {
    std::string title, x_name, y_name;  ///< names with units in brackets
    std::vector<Curve> curves;
    bool logarithmic = false;  ///< both axes; only positive numbers are shown then
};
/// Writes it as SVG. A plot without a finite point has axes alone.
void write_plot(const std::filesystem::path& file, const Plot& plot);

/// Moreau's roses (his Figure 2): each sector filled up to a radius proportional to its density,
/// with fitted curves around them.
struct Rose {
    std::string title;
    talus::DirectionHistogram histogram;
    talus::FabricFit fit;
};
/// Writes them side by side as SVG.
void write_roses(const std::filesystem::path& file, const std::vector<Rose>& roses);

}  // namespace lab
