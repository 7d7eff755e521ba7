// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/io/svg.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace talus {

/// A contact to draw: from the centre of one grain through the point to the centre of the other.
/// Against a wall `to` is the point itself.
template <int Dim>
struct DrawnContact {
    Vector<Dim> from;    ///< [m]
    Vector<Dim> point;   ///< [m]
    Vector<Dim> to;      ///< [m]
    double force = 0.0;  ///< magnitude, not negative [N]
};

/// Sizes and units of the pictures of piles.
struct DrawingParams {
    double width_pixels = 1600.0;
    double strongest_width = 0.5;  ///< of a force segment, over the mean grain diameter [-]
    double darkest = 0.28;         ///< lightness of the heaviest loaded grain, in [0, 1]
    double lightest = 0.97;        ///< lightness of an unloaded one: told from the paper, barely
    double unit = 1.0;             ///< what forces and loads are shown in [N]
    std::string unit_name = "N";   ///< such as "N" or "mean weights"
    double full_share = 0.98;      ///< share of the grains that the greys tell apart
};

namespace detail {

/// The largest of 1, 2, 5 times a power of ten that is not above `x` > 0.
inline double round_down_nicely(double x) {
    const double power = std::pow(10.0, std::floor(std::log10(x)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= x) return digit * power;
    return power;
}

/// The value that the given share of `values` does not exceed; 1 when none is positive.
inline double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    if (values.empty() || values.back() <= 0.0) return 1.0;
    const auto last = static_cast<double>(values.size() - 1);
    const double x = values[static_cast<std::size_t>(std::ceil(share * last))];
    return x > 0.0 ? x : values.back();
}

/// Greys by load, in Moreau's manner: light unloaded, dark loaded; linear up to `full`.
struct GreyScale {
    double full;  ///< the load that is drawn darkest [N]
    double darkest, lightest;
    double lightness(double load) const {
        return lightest + (darkest - lightest) * std::clamp(load / full, 0.0, 1.0);
    }
};

/// Widths by force: linear, the strongest at its full width.
struct WidthScale {
    double strongest;   ///< [N]
    double full_width;  ///< [m]
    double width(double force) const { return full_width * force / strongest; }
};

inline constexpr const char* chain_colour = "#9e1b22";

/// Colour bar of the greys: its lower left corner at `at`, text of size `em` [m].
inline void draw_grey_key(Svg& svg, const Vector<2>& at, double height, double em,
                          const GreyScale& scale, const DrawingParams& params) {
    const Vector<2> bar(1.1 * em, height);
    svg.define_upward_gradient("load", svg_grey(scale.lightest), svg_grey(scale.darkest));
    svg.rectangle(at, at + bar,
                  {.fill = "url(#load)", .stroke = "#555", .stroke_width = 0.05 * em});
    svg.text(at + Vector<2>(0.0, height + 1.7 * em), "Load on a grain", {.size = em, .bold = true});
    svg.text(at + Vector<2>(0.0, height + 0.6 * em), "[" + params.unit_name + "]",
             {.size = 0.9 * em});
    const double full = scale.full / params.unit;
    const double step = round_down_nicely(full / 2.5);
    for (int i = 0; i * step <= full * (1.0 + 1e-9); ++i) {
        const Vector<2> tick = at + Vector<2>(bar[0], height * (i * step / full));
        svg.line(tick, tick + Vector<2>(0.35 * em, 0.0),
                 {.stroke = "#555", .stroke_width = 0.06 * em});
        svg.text(tick + Vector<2>(0.6 * em, -0.34 * em), text_of(i * step), {.size = 0.95 * em});
    }
}

/// Three segments with their forces, the topmost at `at`.
inline void draw_width_key(Svg& svg, const Vector<2>& at, double em, const WidthScale& scale,
                           const DrawingParams& params) {
    svg.text(at, "Contact force", {.size = em, .bold = true});
    svg.text(at - Vector<2>(0.0, 1.1 * em), "[" + params.unit_name + "]", {.size = 0.9 * em});
    const double largest = round_down_nicely(scale.strongest / params.unit);
    const double pitch = std::max(1.6 * em, 0.6 * scale.full_width + em);
    Vector<2> row = at - Vector<2>(0.0, 1.5 * em + pitch);
    for (const double share : {1.0, 0.5, 0.2}) {
        const double force = share * largest;
        svg.line(row + Vector<2>(0.3 * em, 0.0), row + Vector<2>(3.0 * em, 0.0),
                 {.stroke = chain_colour,
                  .stroke_width = scale.width(force * params.unit),
                  .round = true});
        svg.text(row + Vector<2>(4.0 * em, -0.34 * em), text_of(force), {.size = 0.95 * em});
        row[1] -= pitch;
    }
}

/// Title above, captions below.
inline void draw_words(Svg& svg, const Vector<2>& title_at, const Vector<2>& captions_at, double em,
                       const std::string& title, const std::vector<std::string>& captions) {
    svg.text(title_at, title, {.size = 1.5 * em, .bold = true});
    for (std::size_t i = 0; i < captions.size(); ++i)
        svg.text(captions_at - Vector<2>(0.0, 1.5 * em * static_cast<double>(i)), captions[i],
                 {.size = em, .fill = "#333"});
}

/// Throws input_error naming the contact unless its numbers can be drawn.
template <int Dim>
void require_drawable(const std::vector<DrawnContact<Dim>>& contacts) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const std::string name = "drawn contact " + std::to_string(i);
        require_non_negative(name + ": force [N]", contacts[i].force);
        for (const auto* p : {&contacts[i].from, &contacts[i].point, &contacts[i].to})
            require_finite(name, *p);
    }
}

/// Indices of the contacts from the weakest to the strongest, so that the strong lie on top.
template <int Dim>
std::vector<std::size_t> by_force(const std::vector<DrawnContact<Dim>>& contacts) {
    std::vector<std::size_t> order(contacts.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return contacts[a].force < contacts[b].force;
    });
    return order;
}

template <int Dim>
double strongest_force(const std::vector<DrawnContact<Dim>>& contacts) {
    double strongest = 0.0;
    for (const auto& c : contacts) strongest = std::max(strongest, c.force);
    return strongest > 0.0 ? strongest : 1.0;
}

}  // namespace detail
}  // namespace talus
