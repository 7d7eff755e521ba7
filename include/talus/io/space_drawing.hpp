// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/io/drawing_scales.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace talus {

/// A grain of space to draw: a ball, or a convex polyhedron by its faces.
struct DrawnSolid {
    Vector<3> centre = Vector<3>::Zero();  ///< [m]
    double radius = 0.0;                   ///< of the ball, or of the farthest corner [m]
    double load = 0.0;                     ///< that fills it with grey [N]
    /// Faces, corners in the world counter-clockwise from outside [m]; none for a ball.
    std::vector<std::vector<Vector<3>>> faces = {};
};

/// A pile of space to draw, cut open: on the left the grains whose centre lies behind the middle of
/// the box, on the right the forces through all of it.
struct SpaceDrawing {
    Vector<2> box_sides = Vector<2>::Zero();  ///< horizontal sides of the box [m]
    std::vector<DrawnSolid> grains = {};
    std::vector<DrawnContact<3>> contacts = {};
    std::string title = {};
    std::vector<std::string> captions = {};  ///< lines under the picture
};

namespace detail {

/// Parallel projection along a horizontal axis seen from a little above; depth grows away from the
/// viewer.
struct Camera {
    Vector<3> right, up, away;

    static Camera from_front() {
        const double turn = 0.32, tilt = 0.30;  // [rad]: both sides and the top show
        const Vector<3> away(std::sin(turn) * std::cos(tilt), std::cos(turn) * std::cos(tilt),
                             -std::sin(tilt));
        const Vector<3> right(std::cos(turn), -std::sin(turn), 0.0);
        return {right, right.cross(away), away};
    }
    Vector<2> project(const Vector<3>& p) const { return {right.dot(p), up.dot(p)}; }
    double depth(const Vector<3>& p) const { return away.dot(p); }
};

/// Extent of a projection.
struct Frame2D {
    Vector<2> low = Vector<2>::Constant(1e300), high = Vector<2>::Constant(-1e300);
    void include(const Vector<2>& p, double r = 0.0) {
        low = low.cwiseMin(p - Vector<2>::Constant(r));
        high = high.cwiseMax(p + Vector<2>::Constant(r));
    }
};

inline void draw_solid(Svg& svg, const Camera& camera, const Vector<2>& shift, const DrawnSolid& g,
                       double grey, double outline) {
    const Vector<2> centre = camera.project(g.centre) + shift;
    if (g.faces.empty()) {
        svg.circle(centre, g.radius, {.fill = svg_grey(grey)});
        svg.circle(centre, g.radius, {.fill = "url(#ball)"});
        return;
    }
    const Vector<3> light = (camera.up - 0.5 * camera.right - 0.8 * camera.away).normalized();
    for (const auto& face : g.faces) {
        const Vector<3> normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
        if (normal.dot(camera.away) >= 0.0) continue;
        const double lit = 0.72 + 0.28 * normal.dot(light);
        std::vector<Vector<2>> outline_points;
        outline_points.reserve(face.size());
        for (const auto& p : face) outline_points.push_back(camera.project(p) + shift);
        svg.polygon(outline_points, {.fill = svg_grey(grey * lit),
                                     .stroke = "#333",
                                     .stroke_width = outline,
                                     .round = true});
    }
}

/// The back half of the grains, the farthest first.
inline void draw_solids(Svg& svg, const Camera& camera, const Vector<2>& shift,
                        const SpaceDrawing& pile, const GreyScale& scale, double outline) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pile.grains.size(); ++i)
        if (pile.grains[i].centre[1] >= 0.5 * pile.box_sides[1]) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return camera.depth(pile.grains[a].centre) > camera.depth(pile.grains[b].centre);
    });
    for (const std::size_t i : order)
        draw_solid(svg, camera, shift, pile.grains[i], scale.lightness(pile.grains[i].load),
                   outline);
}

/// Edges of the box up to `top`.
inline void draw_box(Svg& svg, const Camera& camera, const Vector<2>& shift, const Vector<2>& sides,
                     double top, double width) {
    const auto edge = [&](const Vector<3>& a, const Vector<3>& b) {
        svg.line(camera.project(a) + shift, camera.project(b) + shift,
                 {.stroke = "#777", .stroke_width = width, .round = true});
    };
    const std::vector<Vector<2>> corners{
        {0.0, 0.0}, {sides[0], 0.0}, {sides[0], sides[1]}, {0.0, sides[1]}};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vector<2>&a = corners[k], &b = corners[(k + 1) % 4];
        edge({a[0], a[1], 0.0}, {b[0], b[1], 0.0});
        edge({a[0], a[1], 0.0}, {a[0], a[1], top});
    }
}

inline void draw_space_chains(Svg& svg, const Camera& camera, const Vector<2>& shift,
                              const SpaceDrawing& pile, const WidthScale& widths) {
    svg.open_group({.fill = "none", .stroke = chain_colour, .opacity = 0.8, .round = true});
    for (const std::size_t i : by_force<3>(pile.contacts)) {
        const auto& c = pile.contacts[i];
        if (c.force <= 1e-2 * widths.strongest) continue;  // thinner than ink
        const std::vector<Vector<2>> path{camera.project(c.from) + shift,
                                          camera.project(c.point) + shift,
                                          camera.project(c.to) + shift};
        svg.polyline(path, {.stroke_width = widths.width(c.force)});
    }
    svg.close_group();
}

inline void require_drawable(const SpaceDrawing& pile) {
    require_positive("smaller side of the drawn box [m]", pile.box_sides.minCoeff());
    require_in("drawn grains", static_cast<double>(pile.grains.size()), 1.0, 1e7);
    for (std::size_t i = 0; i < pile.grains.size(); ++i) {
        const std::string name = "drawn grain " + std::to_string(i);
        require_positive(name + ": radius [m]", pile.grains[i].radius);
        require_in(name + ": load [N]", pile.grains[i].load, -1e300, 1e300);
        require_finite(name + ": centre", pile.grains[i].centre);
    }
    require_drawable<3>(pile.contacts);
}

}  // namespace detail

/// The picture of a pile of space: cut open and grey by load on the left, its force network on the
/// right. Throws input_error naming what is not finite.
inline std::string space_svg(const SpaceDrawing& pile, const DrawingParams& params = {}) {
    detail::require_drawable(pile);
    const auto camera = detail::Camera::from_front();
    double top = 0.0, diameter = 0.0;
    std::vector<double> loads;
    for (const auto& g : pile.grains) {
        top = std::max(top, g.centre[2] + g.radius);
        loads.push_back(g.load);
        diameter += 2.0 * g.radius / static_cast<double>(pile.grains.size());
    }
    detail::Frame2D frame;
    for (const double x : {0.0, pile.box_sides[0]})
        for (const double y : {0.0, pile.box_sides[1]})
            for (const double z : {0.0, top}) frame.include(camera.project({x, y, z}));
    const Vector<2> extent = frame.high - frame.low;
    const double em = 0.017 * (2.0 * extent[0] + 0.25 * extent[0]);
    const Vector<2> panel(extent[0] + 3.0 * em, 0.0);
    const double caption_room = (2.6 + 1.5 * static_cast<double>(pile.captions.size())) * em;
    const double roof = std::max(extent[1], 22.0 * em) + em;
    Svg svg({-1.5 * em, -caption_room}, {2.0 * extent[0] + 3.0 * em + 13.0 * em, roof + 3.5 * em},
            params.width_pixels);
    svg.define_ball_shade("ball");

    const detail::GreyScale grey{detail::quantile(loads, params.full_share), params.darkest,
                                 params.lightest};
    const detail::WidthScale widths{detail::strongest_force<3>(pile.contacts),
                                    params.strongest_width * diameter};
    const Vector<2> left = -frame.low, right = panel - frame.low;
    detail::draw_box(svg, camera, left, pile.box_sides, top, 0.08 * em);
    detail::draw_solids(svg, camera, left, pile, grey, 0.015 * diameter);
    detail::draw_box(svg, camera, right, pile.box_sides, top, 0.08 * em);
    detail::draw_space_chains(svg, camera, right, pile, widths);

    const double column = 2.0 * extent[0] + 5.0 * em;
    detail::draw_width_key(svg, {column, 10.0 * em}, em, widths, params);
    detail::draw_grey_key(svg, {column, 12.5 * em}, 7.0 * em, em, grey, params);
    detail::draw_words(svg, {0.0, roof + 1.0 * em}, {0.0, -2.0 * em}, em, pile.title,
                       pile.captions);
    return svg.str();
}

}  // namespace talus
