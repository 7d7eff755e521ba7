// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/io/drawing_scales.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace talus {

/// A grain of the plane to draw.
struct DrawnGrain {
    Vector<2> centre = Vector<2>::Zero();  ///< [m]
    double radius = 0.0;                   ///< of the disc, or of the farthest corner [m]
    double load = 0.0;                     ///< that fills it with grey [N]
    std::vector<Vector<2>> outline = {};   ///< corners in the world [m]; none for a disc
};

/// A line laid over the picture: a surface, a cut, a region that was measured.
struct DrawnLine {
    std::vector<Vector<2>> points;  ///< [m]
    std::string colour = "#0057b8";
    double width = 0.15;  ///< over the mean grain diameter [-]
};

/// A pile of the plane to draw, as plain numbers.
struct PileDrawing {
    double box_width = 0.0;  ///< walls at x = 0 and here, floor at y = 0 [m]
    std::vector<DrawnGrain> grains = {};
    std::vector<DrawnContact<2>> contacts = {};
    std::string title = {};
    std::vector<std::string> captions = {};  ///< lines under the picture
    std::vector<DrawnGrain> obstacles = {};  ///< dark, whatever their load
    /// Shows what lies between two corners [m], without the box. What reaches out of them is cut.
    std::optional<std::pair<Vector<2>, Vector<2>>> window = {};
    std::vector<DrawnLine> lines = {};  ///< on top of all
};

namespace detail {

inline double mean_diameter(const std::vector<DrawnGrain>& grains) {
    double sum = 0.0;
    for (const auto& g : grains) sum += 2.0 * g.radius;
    return sum / static_cast<double>(grains.size());
}

inline void require_drawable(const PileDrawing& pile) {
    if (pile.window) {
        const auto& [low, high] = *pile.window;
        require_finite("low corner of the window", low);
        require_positive("extent of the window [m]", (high - low).minCoeff());
    } else {
        require_positive("width of the drawn box [m]", pile.box_width);
    }
    require_in("drawn grains", static_cast<double>(pile.grains.size()), 1.0, 1e7);
    for (std::size_t i = 0; i < pile.grains.size(); ++i) {
        const DrawnGrain& g = pile.grains[i];
        const std::string name = "drawn grain " + std::to_string(i);
        require_positive(name + ": radius [m]", g.radius);
        require_in(name + ": load [N]", g.load, -1e300, 1e300);
        require_finite(name + ": centre", g.centre);
        for (const auto& p : g.outline) require_finite(name + ": outline", p);
    }
    for (const DrawnLine& line : pile.lines) {
        require_positive("width of a drawn line", line.width);
        for (const auto& p : line.points) require_finite("drawn line", p);
    }
    require_drawable<2>(pile.contacts);
}

inline void draw_grains(Svg& svg, const PileDrawing& pile, const GreyScale& grey, double outline) {
    svg.open_group({.stroke = "#4a4a4a", .stroke_width = outline, .round = true});
    for (const auto& g : pile.grains) {
        const SvgStyle style{.fill = svg_grey(grey.lightness(g.load))};
        if (g.outline.empty())
            svg.circle(g.centre, g.radius, style);
        else
            svg.polygon(g.outline, style);
    }
    svg.close_group();
}

inline void draw_obstacles(Svg& svg, const PileDrawing& pile) {
    svg.open_group({.fill = "#2b2b2b"});
    for (const auto& o : pile.obstacles) {
        if (o.outline.empty())
            svg.circle(o.centre, o.radius);
        else
            svg.polygon(o.outline);
    }
    svg.close_group();
}

inline void draw_chains(Svg& svg, const PileDrawing& pile, const WidthScale& widths) {
    svg.open_group({.fill = "none", .stroke = chain_colour, .opacity = 0.92, .round = true});
    for (const std::size_t i : by_force<2>(pile.contacts)) {
        const auto& c = pile.contacts[i];
        // Below a thousandth of the strongest a segment is thinner than ink.
        if (c.force <= 1e-3 * widths.strongest) continue;
        const std::vector<Vector<2>> path{c.from, c.point, c.to};
        svg.polyline(path, {.stroke_width = widths.width(c.force)});
    }
    svg.close_group();
}

}  // namespace detail

/// The picture of a pile in Moreau's manner: grains grey by load, forces as red segments from
/// centre through contact to centre, as wide as they are strong; scales beside, words above and
/// below. Throws input_error naming what is not finite.
inline std::string pile_svg(const PileDrawing& pile, const DrawingParams& params = {}) {
    detail::require_drawable(pile);
    // What is shown lies between these, the box's floor and walls included.
    Vector<2> low = Vector<2>::Zero(), high(pile.box_width, 0.0);
    std::vector<double> loads;
    for (const auto& g : pile.grains) {
        high[1] = std::max(high[1], g.centre[1] + g.radius);
        loads.push_back(g.load);
    }
    if (pile.window) std::tie(low, high) = *pile.window;
    const double diameter = detail::mean_diameter(pile.grains);
    // Words are sized by the page, which is about as wide as the box and the scales together.
    const double em = 0.021 * (high - low).maxCoeff();
    const double wall = pile.window ? 0.0 : 0.45 * em, right = high[0] + 14.0 * em;
    const double title_room = 4.5 * em;
    const double caption_room = (2.2 + 1.5 * static_cast<double>(pile.captions.size())) * em;
    const double legend_height = 22.0 * em;
    const double roof = std::max(high[1] + em, low[1] + legend_height);
    Svg svg({low[0] - 2.0 * em, low[1] - caption_room - wall}, {right, roof + title_room},
            params.width_pixels);

    const detail::GreyScale grey{detail::quantile(loads, params.full_share), params.darkest,
                                 params.lightest};
    const detail::WidthScale widths{detail::strongest_force<2>(pile.contacts),
                                    params.strongest_width * diameter};
    if (pile.window) svg.open_clipped(low, high);
    detail::draw_obstacles(svg, pile);
    detail::draw_grains(svg, pile, grey, 0.035 * diameter);
    detail::draw_chains(svg, pile, widths);
    for (const DrawnLine& line : pile.lines)
        svg.polyline(line.points, {.fill = "none",
                                   .stroke = line.colour,
                                   .stroke_width = line.width * diameter,
                                   .round = true});
    if (pile.window) {
        svg.close_group();
    } else {
        const double w = 0.5 * wall, wall_top = high[1] + em;
        const std::vector<Vector<2>> box{
            {-w, wall_top}, {-w, -w}, {pile.box_width + w, -w}, {pile.box_width + w, wall_top}};
        svg.polyline(box, {.fill = "none", .stroke = "#1a1a1a", .stroke_width = wall});
    }

    const double column = high[0] + 3.0 * em, w = 0.5 * wall;
    detail::draw_width_key(svg, {column, low[1] + 10.0 * em}, em, widths, params);
    detail::draw_grey_key(svg, {column, low[1] + 12.5 * em}, 7.0 * em, em, grey, params);
    detail::draw_words(svg, {low[0] - w, roof + 1.8 * em}, {low[0] - w, low[1] - wall - 1.8 * em},
                       em, pile.title, pile.captions);
    return svg.str();
}

}  // namespace talus
