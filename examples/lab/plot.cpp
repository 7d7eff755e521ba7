// SPDX-License-Identifier: BSL-1.0
#include "plot.hpp"

#include <talus/io/svg.hpp>
#include <talus/io/write_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>

namespace lab {
namespace {

using talus::Svg;
using Point = talus::Vector<2>;

// Told apart in grey and by the colour-blind ([Okabe and Ito] 2008).
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};

/// An axis from the data to [0, 1].
struct Axis {
    bool logarithmic = false;
    double low = std::numeric_limits<double>::infinity(), high = -low;

    double along(double value) const { return logarithmic ? std::log10(value) : value; }
    bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0.0); }
    void hold(double value) {
        if (!shows(value)) return;
        low = std::min(low, along(value));
        high = std::max(high, along(value));
    }
    void widen() {
        if (!(low <= high)) low = 0.0, high = 1.0;
        const double margin = std::max(0.04 * (high - low), 1e-9 * std::abs(high));
        low -= margin > 0.0 ? margin : 0.5;
        high += margin > 0.0 ? margin : 0.5;
    }
    double share(double value) const { return (along(value) - low) / (high - low); }
    /// Round values within, at most eight or so.
    std::vector<double> ticks() const {
        std::vector<double> found;
        const double span = high - low;
        if (logarithmic && span < 2.5) {
            for (double decade = std::floor(low); decade <= high; ++decade)
                for (const double factor : {1.0, 2.0, 5.0})
                    if (const double t = factor * std::pow(10.0, decade);
                        along(t) >= low && along(t) <= high)
                        found.push_back(t);
            return found;
        }
        double step = std::pow(10.0, std::floor(std::log10(span / 4.0)));
        for (const double factor : {5.0, 2.0})
            if (factor * step <= span / 4.0) {
                step *= factor;
                break;
            }
        if (logarithmic) step = std::max(1.0, std::round(step));
        for (double t = std::ceil(low / step) * step; t <= high; t += step)
            found.push_back(logarithmic ? std::pow(10.0, t) : std::abs(t) < 1e-9 * span ? 0.0 : t);
        return found;
    }
};

std::string short_number(double x) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", x);
    return text.data();
}

}  // namespace

void write_plot(const std::filesystem::path& file, const Plot& plot) {
    Axis x{plot.logarithmic}, y{plot.logarithmic};
    for (const Curve& c : plot.curves)
        for (std::size_t k = 0; k < std::min(c.x.size(), c.y.size()); ++k)
            if (x.shows(c.x[k]) && y.shows(c.y[k])) x.hold(c.x[k]), y.hold(c.y[k]);
    x.widen();
    y.widen();

    const Point size(10.2, 5.0), corner(0.9, 0.75), far(7.8, 4.35);  // in units of 100 pixels
    Svg svg(Point::Zero(), size, 1020.0);
    const auto at = [&](double a, double b) {
        return Point(corner[0] + x.share(a) * (far[0] - corner[0]),
                     corner[1] + y.share(b) * (far[1] - corner[1]));
    };
    svg.text({corner[0], 4.6}, plot.title, {.size = 0.19, .bold = true});
    const talus::SvgStyle grid{.stroke = "#ddd", .stroke_width = 0.01};
    for (const double t : x.ticks()) {
        const double a = corner[0] + x.share(t) * (far[0] - corner[0]);
        svg.line({a, corner[1]}, {a, far[1]}, grid);
        svg.text({a, corner[1] - 0.22}, short_number(t), {.size = 0.14, .anchor = "middle"});
    }
    for (const double t : y.ticks()) {
        const double b = corner[1] + y.share(t) * (far[1] - corner[1]);
        svg.line({corner[0], b}, {far[0], b}, grid);
        svg.text({corner[0] - 0.08, b - 0.05}, short_number(t), {.size = 0.14, .anchor = "end"});
    }
    svg.rectangle(corner, far, {.fill = "none", .stroke = "#555", .stroke_width = 0.015});
    svg.text({0.5 * (corner[0] + far[0]), 0.16}, plot.x_name, {.size = 0.16, .anchor = "middle"});
    svg.text({0.1, far[1] + 0.08}, plot.y_name, {.size = 0.16});
    double line = far[1] - 0.25;
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const Curve& c = plot.curves[i];
        const std::string colour = colours[i % colours.size()];
        std::vector<Point> run;
        const talus::SvgStyle stroke{
            .fill = "none", .stroke = colour, .stroke_width = 0.025, .round = true};
        const auto flush = [&] {
            if (run.size() > 1) svg.polyline(run, stroke);
            run.clear();
        };
        for (std::size_t k = 0; k < std::min(c.x.size(), c.y.size()); ++k) {
            if (!x.shows(c.x[k]) || !y.shows(c.y[k])) {
                flush();
                continue;
            }
            if (c.points)
                svg.circle(at(c.x[k], c.y[k]), 0.045, {.fill = colour});
            else
                run.push_back(at(c.x[k], c.y[k]));
        }
        flush();
        if (c.name.empty()) continue;
        const Point key(far[0] + 0.15, line);
        if (c.points)
            svg.circle(key + Point(0.1, 0.05), 0.045, {.fill = colour});
        else
            svg.line(key + Point(0.0, 0.05), key + Point(0.2, 0.05), stroke);
        svg.text(key + Point(0.3, 0.0), c.name, {.size = 0.15});
        line -= 0.25;
    }
    talus::write_file(file, svg.str());
}

void write_roses(const std::filesystem::path& file, const std::vector<Rose>& roses) {
    const double wide = 4.2, high = 4.6;  // in units of 100 pixels
    Svg svg(Point::Zero(),
            {wide * static_cast<double>(std::max<std::size_t>(roses.size(), 1)), high},
            100.0 * wide * static_cast<double>(std::max<std::size_t>(roses.size(), 1)));
    for (std::size_t r = 0; r < roses.size(); ++r) {
        const Rose& rose = roses[r];
        const Point centre(wide * (static_cast<double>(r) + 0.5), 2.05);
        double largest = 0.0;
        for (std::size_t k = 0; k < rose.histogram.sectors(); ++k)
            largest = std::max(largest, rose.histogram.density(k));
        constexpr int around = 360;
        for (int k = 0; k < around; ++k)
            largest = std::max(largest, rose.fit.density(2.0 * std::numbers::pi * k / around));
        const double scale = 1.75 / largest;
        const auto at = [&](double radius, double angle) {
            return Point(centre + radius * Point(std::cos(angle), std::sin(angle)));
        };
        const double even = scale / (2.0 * std::numbers::pi);
        const double half = std::numbers::pi / static_cast<double>(rose.histogram.sectors());
        for (std::size_t k = 0; k < rose.histogram.sectors(); ++k) {
            std::vector<Point> sector{centre};
            for (int s = 0; s <= 6; ++s)
                sector.push_back(at(scale * rose.histogram.density(k),
                                    rose.histogram.middle(k) + half * (s / 3.0 - 1.0)));
            svg.polygon(sector, {.fill = "#c4c4c4", .stroke = "#666", .stroke_width = 0.01});
        }
        svg.circle(centre, even, {.fill = "none", .stroke = "#0072b2", .stroke_width = 0.012});
        std::vector<Point> curve;
        for (int k = 0; k <= around; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / around;
            curve.push_back(at(scale * rose.fit.density(angle), angle));
        }
        svg.polyline(curve, {.fill = "none", .stroke = "#9e1b22", .stroke_width = 0.03});
        svg.text({centre[0], high - 0.3}, rose.title,
                 {.size = 0.19, .anchor = "middle", .bold = true});
        svg.text({centre[0], 0.08}, "blue: no direction preferred; red: the fit",
                 {.size = 0.14, .anchor = "middle", .fill = "#333"});
    }
    talus::write_file(file, svg.str());
}

}  // namespace lab
