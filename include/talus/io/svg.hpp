// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace talus {

/// How a thing is painted. What is empty or negative is inherited from the group around it.
struct SvgStyle {
    std::string fill = {};       ///< a colour, "none" or "url(#name)"
    std::string stroke = {};     ///< a colour or "none"
    double stroke_width = -1.0;  ///< [m]
    double opacity = -1.0;       ///< of the whole thing or group, in [0, 1]
    bool round = false;          ///< round ends and joints
};

/// How a text is set. It stands upright whatever the scale.
struct SvgText {
    double size = 0.01;                 ///< of the font [m]
    std::string_view anchor = "start";  ///< "start", "middle" or "end"
    std::string_view fill = "#1a1a1a";
    bool bold = false;
};

/// Shades of grey from black (0) to white (1), and mixtures of two colours of three bytes each.
inline std::string svg_colour(const Vector<3>& rgb) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const double c : rgb) {
        const auto byte = static_cast<std::size_t>(std::lround(255.0 * std::clamp(c, 0.0, 1.0)));
        text += digits[byte / 16];
        text += digits[byte % 16];
    }
    return text;
}
inline std::string svg_grey(double lightness) { return svg_colour(Vector<3>::Constant(lightness)); }

/// A drawing in metres, y upwards, mapped to pixels as it is written. Numbers carry a hundredth of
/// a pixel. Names and texts are escaped; a number that is not finite is a programmer's error.
class Svg {
  public:
    /// Shows the rectangle from `low` to `high` [m] on a page that is `width_pixels` wide.
    Svg(const Vector<2>& low, const Vector<2>& high, double width_pixels)
        : low_(low), high_(high), scale_(width_pixels / (high[0] - low[0])) {
        TALUS_CHECK((high - low).minCoeff() > 0.0 && width_pixels > 0.0, "a page has an area");
    }

    void circle(const Vector<2>& centre, double radius, const SvgStyle& style = {}) {
        body_ += "<circle";
        add("cx", x(centre));
        add("cy", y(centre));
        add("r", scale_ * radius);
        close(style);
    }
    void polygon(std::span<const Vector<2>> corners, const SvgStyle& style = {}) {
        points("polygon", corners, style);
    }
    void polyline(std::span<const Vector<2>> vertices, const SvgStyle& style = {}) {
        points("polyline", vertices, style);
    }
    void line(const Vector<2>& a, const Vector<2>& b, const SvgStyle& style = {}) {
        body_ += "<line";
        add("x1", x(a));
        add("y1", y(a));
        add("x2", x(b));
        add("y2", y(b));
        close(style);
    }
    void rectangle(const Vector<2>& low, const Vector<2>& high, const SvgStyle& style = {}) {
        body_ += "<rect";
        add("x", x(low));
        add("y", y(high));
        add("width", scale_ * (high[0] - low[0]));
        add("height", scale_ * (high[1] - low[1]));
        close(style);
    }
    void text(const Vector<2>& at, std::string_view words, const SvgText& how = {}) {
        body_ += "<text";
        add("x", x(at));
        add("y", y(at));
        add("font-size", scale_ * how.size);
        if (how.anchor != "start") add("text-anchor", how.anchor);
        add("fill", how.fill);
        if (how.bold) add("font-weight", "bold");
        body_ += ">" + escaped(words) + "</text>\n";
    }
    void open_group(const SvgStyle& style) {
        body_ += "<g";
        paint(style);
        body_ += ">\n";
        ++open_groups_;
    }
    /// Opens a group of which only what lies between two corners [m] is shown.
    void open_clipped(const Vector<2>& low, const Vector<2>& high) {
        const std::string name = "clip" + std::to_string(++clips_);
        definitions_ += "<clipPath id=\"" + name + "\"><rect x=\"" + number(x(low)) + "\" y=\"" +
                        number(y(high)) + "\" width=\"" + number(scale_ * (high[0] - low[0])) +
                        "\" height=\"" + number(scale_ * (high[1] - low[1])) + "\"/></clipPath>\n";
        body_ += "<g clip-path=\"url(#" + name + ")\">\n";
        ++open_groups_;
    }
    void close_group() {
        TALUS_CHECK(open_groups_ > 0, "a group is open");
        body_ += "</g>\n";
        --open_groups_;
    }
    /// A fill "url(#name)" running upwards from one colour to the other.
    void define_upward_gradient(std::string_view name, std::string_view low,
                                std::string_view high) {
        definitions_ += "<linearGradient id=\"" + escaped(name) +
                        "\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">" + stop(0.0, low, 1.0) +
                        stop(1.0, high, 1.0) + "</linearGradient>\n";
    }
    /// A fill "url(#name)" that makes a disc a ball lit from the upper left: laid over any colour.
    void define_ball_shade(std::string_view name) {
        definitions_ += "<radialGradient id=\"" + escaped(name) +
                        "\" cx=\"0.36\" cy=\"0.32\" r=\"0.75\">" + stop(0.0, "#fff", 0.75) +
                        stop(0.35, "#fff", 0.12) + stop(0.7, "#000", 0.12) +
                        stop(1.0, "#000", 0.55) + "</radialGradient>\n";
    }

    /// The document.
    std::string str() const {
        TALUS_CHECK(open_groups_ == 0, "every group is closed");
        const std::string width = number(scale_ * (high_[0] - low_[0]));
        const std::string height = number(scale_ * (high_[1] - low_[1]));
        return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" +
               height + "\" viewBox=\"0 0 " + width + " " + height +
               "\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', "
               "sans-serif\">\n<defs>\n" +
               definitions_ + "</defs>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
               body_ + "</svg>\n";
    }

    /// `x` with at most two decimals, as short as they allow.
    static std::string number(double x) {
        TALUS_CHECK(std::isfinite(x), "a drawn number is finite");
        char buffer[350];
        const auto end =
            std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed, 2).ptr;
        std::string text(buffer, end);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
        return text == "-0" ? "0" : text;
    }
    static std::string escaped(std::string_view words) {
        std::string text;
        for (const char c : words) {
            if (c == '&')
                text += "&amp;";
            else if (c == '<')
                text += "&lt;";
            else if (c == '>')
                text += "&gt;";
            else if (c == '"')
                text += "&quot;";
            else if (static_cast<unsigned char>(c) >= 0x20)
                text += c;  // XML has no others
        }
        return text;
    }

  private:
    double x(const Vector<2>& p) const { return scale_ * (p[0] - low_[0]); }
    double y(const Vector<2>& p) const { return scale_ * (high_[1] - p[1]); }
    void add(std::string_view key, double value) { add(key, number(value)); }
    void add(std::string_view key, std::string_view value) {
        body_ += " " + std::string(key) + "=\"" + escaped(value) + "\"";
    }
    void paint(const SvgStyle& style) {
        if (!style.fill.empty()) add("fill", style.fill);
        if (!style.stroke.empty()) add("stroke", style.stroke);
        if (style.stroke_width >= 0.0) add("stroke-width", scale_ * style.stroke_width);
        if (style.opacity >= 0.0) add("opacity", style.opacity);
        if (style.round) body_ += " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    }
    void close(const SvgStyle& style) {
        paint(style);
        body_ += "/>\n";
    }
    void points(std::string_view name, std::span<const Vector<2>> list, const SvgStyle& style) {
        body_ += "<" + std::string(name) + " points=\"";
        for (const auto& p : list) body_ += number(x(p)) + "," + number(y(p)) + " ";
        if (!list.empty()) body_.pop_back();
        body_ += "\"";
        close(style);
    }
    static std::string stop(double at, std::string_view colour, double opacity) {
        return "<stop offset=\"" + number(at) + "\" stop-color=\"" + escaped(colour) +
               "\" stop-opacity=\"" + number(opacity) + "\"/>";
    }

    Vector<2> low_, high_;
    double scale_;  ///< [pixel/m]
    int open_groups_ = 0, clips_ = 0;
    std::string definitions_, body_;
};

}  // namespace talus
