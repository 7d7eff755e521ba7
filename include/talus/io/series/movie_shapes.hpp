// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/printable.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/geometry/shape_view.hpp>
#include <talus/io/series/directions.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::detail {

/// Adds a number to JSON text, with this many significant digits; 0: as many as it takes to read
/// the same bits. What is no finite number is `null`, as JSON has no other.
inline void add_number(std::string& text, double x, int digits = 6) {
    if (!std::isfinite(x)) {
        text += "null";
        return;
    }
    std::array<char, 32> room{};
    char* const end = room.data() + room.size();
    const auto written =
        digits > 0 ? std::to_chars(room.data(), end, x, std::chars_format::general, digits)
                   : std::to_chars(room.data(), end, x);
    text.append(room.data(), written.ptr);
}

/// Adds numbers after what a list holds already.
inline void add_numbers(std::string& text, std::span<const double> numbers) {
    for (const double x : numbers) {
        if (text.back() != '[') text += ',';
        add_number(text, x);
    }
}
template <int Dim>
void add_numbers(std::string& text, const Vector<Dim>& v) {
    add_numbers(text, std::span(v.data(), static_cast<std::size_t>(v.size())));
}

/// Words as a string of JSON. What terminals would not print is shown as `\x1b`.
inline std::string json_string(std::string_view words) {
    std::string text = "\"";
    for (const char c : printable(words)) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + "\"";
}

/// How a turn is told: its angle [rad] in the plane, the quaternion x, y, z, w in space.
inline void add_rotation(std::string& text, const Rotation<2>& rotation) {
    const double angle = rotation.angle();
    add_numbers(text, {&angle, 1});
}
inline void add_rotation(std::string& text, const Rotation<3>& rotation) {
    add_numbers(text, {rotation.quaternion().coeffs().data(), 4});
}

template <class Face>
void add_face(std::string& text, const Face& face) {
    text += text.back() == '[' ? "[" : ",[";
    for (const auto v : face) text += std::to_string(v) + ",";
    text.back() = ']';
}

/// A convex shape without a core: the points farthest in all directions, as corners.
template <int Dim>
void add_outline(std::string& text, const ShapeView<Dim>& shape) {
    const Directions<Dim> around(rotation_dof<Dim> == 1 ? 64 : 24);
    text += R"({"kind":"core","radius":0,"vertices":[)";
    for (const auto& d : around.unit) add_numbers<Dim>(text, shape.support(d));
    text += R"(],"faces":[)";
    for (const auto& face : around.faces) add_face(text, face);
    text += "]}";
}

template <int Dim>
void add_core(std::string& text, const CoreView<Dim>& core) {
    text += R"({"kind":"core","radius":)";
    add_number(text, core.radius);
    text += R"(,"vertices":[)";
    for (const auto& v : core.vertices) add_numbers<Dim>(text, v);
    text += R"(],"faces":[)";
    for (std::size_t f = 0; f < core.face_count(); ++f) add_face(text, core.face(f));
    text += "]}";
}

template <int Dim>
void add_ball(std::string& text, const Ball<Dim>& ball) {
    text += R"({"kind":"ball","radius":)";
    add_number(text, ball.radius());
    text += R"(,"centre":[)";
    add_numbers<Dim>(text, ball.centre());
    text += "]}";
}

template <int Dim>
void add_half_space(std::string& text, const HalfSpace<Dim>& wall) {
    text += R"({"kind":"half_space","normal":[)";
    add_numbers<Dim>(text, wall.normal());
    text += R"(],"offset":)";
    add_number(text, wall.offset());
    text += "}";
}

template <int Dim>
void add_hole(std::string& text, const RoundHole<Dim>& wall) {
    text += R"({"kind":"hole","radius":)";
    add_number(text, wall.radius());
    text += R"(,"centre":[)";
    add_numbers<Dim>(text, wall.centre());
    text += R"(],"axis":[)";
    add_numbers<Dim>(text, wall.axis());
    text += "]}";
}

/// What tells no more than its box; what has an end on no side cannot be drawn by that.
template <int Dim>
void add_box(std::string& text, const Aabb<Dim>& box) {
    if (!box.bounded()) {
        text += R"({"kind":"unbounded"})";
        return;
    }
    text += R"({"kind":"box","low":[)";
    add_numbers<Dim>(text, box.low);
    text += R"(],"high":[)";
    add_numbers<Dim>(text, box.high);
    text += "]}";
}

/// A shape as JSON, in its own frame, lengths in metres: one function for each kind.
template <int Dim>
void add_shape(std::string& text, const ShapeView<Dim>& shape) {
    switch (shape.kind()) {
        case ShapeKind::ball:
            return add_ball(text, shape.template as<Ball<Dim>>());
        case ShapeKind::core:
            return add_core(text, shape.core());
        case ShapeKind::half_space:
            return add_half_space(text, shape.template as<HalfSpace<Dim>>());
        case ShapeKind::hole:
            return add_hole(text, shape.template as<RoundHole<Dim>>());
        case ShapeKind::convex:
            return add_outline(text, shape);
        case ShapeKind::compound:
            text += R"({"kind":"compound","children":[)";
            for (std::size_t i = 0; i < shape.bounds().size(); ++i) {
                if (i > 0) text += ',';
                add_shape(text, shape.child(i));
            }
            text += "]}";
            return;
        default:
            return add_box(text, shape.aabb(Pose<Dim>{}));
    }
}

}  // namespace talus::detail
