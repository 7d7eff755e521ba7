// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/grain_checks.hpp>
#include <talus/io/line_reader.hpp>
#include <talus/io/write_file.hpp>
#include <talus/sample/overlap.hpp>
#include <talus/sample/scene.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>

namespace talus {
namespace detail {

/// Names of the shapes in scene files: a ball and a shape with corners, by dimension.
inline constexpr std::array ball_names{"disc", "sphere"};
inline constexpr std::array corner_names{"polygon", "polyhedron"};
inline constexpr long largest_grain_count = 10'000'000;
inline constexpr long most_vertices = 64;
inline constexpr double longest = 1e6;    ///< no length in a scene is greater [m]
inline constexpr double shortest = 1e-9;  ///< no radius or side of a box is smaller [m]

/// A number with `digits` significant digits, or the shortest that reads as the same bits for 0.
inline std::string number_text(double x, int digits) {
    char text[64];
    const auto end =
        digits > 0 ? std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits)
                   : std::to_chars(text, text + sizeof text, x, std::chars_format::general);
    return std::string(text, end.ptr);
}

struct SceneHeader {
    int dim;
    bool corners;
    std::size_t grain_count;
};

inline SceneHeader read_header(LineReader& in) {
    in.next_line("the line 'pile 1'");
    in.keyword("pile");
    in.integer("version of the format", 1, 1);
    in.expect_end_of_line();
    in.next_line("the line 'dim <2|3> shape <name> n <count>'");
    in.keyword("dim");
    SceneHeader header{};
    header.dim = static_cast<int>(in.integer("dim", 2, 3));
    const auto names = static_cast<std::size_t>(header.dim - 2);
    in.keyword("shape");
    const std::string& shape = in.word("shape");
    header.corners = shape == corner_names[names];
    if (!header.corners && shape != ball_names[names])
        in.fail("shape", "is '" + detail::shown(shape) + "', but must be '" + ball_names[names] +
                             "' or '" + corner_names[names] + "' in dim " +
                             std::to_string(header.dim));
    in.keyword("n");
    header.grain_count = static_cast<std::size_t>(in.integer("n", 1, largest_grain_count));
    in.expect_end_of_line();
    return header;
}

template <int Dim>
void read_box_and_material(LineReader& in, Scene<Dim>& scene) {
    in.next_line("the line 'box <Lx> <Ly> <Lz>'");
    in.keyword("box");
    constexpr std::array sides{"Lx", "Ly", "Lz"};
    for (int i = 0; i < 3; ++i) {
        const std::string name = std::string("box ") + sides[static_cast<std::size_t>(i)] + " [m]";
        if (i + 1 < Dim)
            scene.box_size[i] = in.number(name, shortest, longest);
        else
            in.number(name, 0.0, 0.0);  // upwards the box is open
    }
    in.expect_end_of_line();
    in.next_line("the line 'mu <mu> rho <density> g <gravity> rmean <radius>'");
    in.keyword("mu");
    scene.mu = in.number("mu", 0.0, 1e3);
    in.keyword("rho");
    scene.density = in.number("rho", 1e-6, 1e9);
    in.keyword("g");
    scene.gravity = in.number("g [m/s^2]", 0.0, 1e6);
    in.keyword("rmean");
    scene.mean_radius = in.number("rmean [m]", shortest, longest);
    in.expect_end_of_line();
}

template <int Dim>
Grain<Dim> read_grain(LineReader& in, bool corners, std::size_t index) {
    const std::string name = "grain " + std::to_string(index + 1);
    constexpr std::array axes{"x", "y", "z"};
    in.next_line(name);
    Grain<Dim> grain;
    for (int i = 0; i < Dim; ++i)
        grain.position[i] =
            in.number(name + ": " + axes[static_cast<std::size_t>(i)] + " [m]", 0.0, longest);
    grain.radius = in.number(name + ": r [m]", shortest, longest);
    if (corners) {
        const long count = in.integer(name + ": vertex count k", Dim + 1, most_vertices);
        grain.vertices.resize(static_cast<std::size_t>(count));
        for (std::size_t v = 0; v < grain.vertices.size(); ++v)
            for (int i = 0; i < Dim; ++i)
                grain.vertices[v][i] = in.number(
                    name + ": " + vertex_name(v) + " " + axes[static_cast<std::size_t>(i)] + " [m]",
                    -longest, longest);
    }
    in.expect_end_of_line();
    return grain;
}

}  // namespace detail

/// Reads a scene from text; `file` is the name that complaints begin with. The format is described
/// in the README of this folder. Throws input_error, one sentence, when anything is not as it
/// should be: words, counts, ranges, polygons, grains outside the box, a mean radius that is not
/// between those of the grains, grains that overlap.
template <int Dim>
Scene<Dim> parse_scene(std::istream& text, const std::string& file) {
    constexpr std::size_t mean_radius_line = 4, first_grain_line = 5;
    LineReader in(text, file);
    const detail::SceneHeader header = detail::read_header(in);
    if (header.dim != Dim)
        in.fail("dim", "is " + std::to_string(header.dim) + ", but must be " + std::to_string(Dim) +
                           " here");
    Scene<Dim> scene;
    detail::read_box_and_material(in, scene);
    // Memory is taken as grains come: a wrong count should not ask for all of it at once.
    scene.grains.reserve(std::min<std::size_t>(header.grain_count, 1u << 16));
    for (std::size_t i = 0; i < header.grain_count; ++i) {
        auto grain = detail::read_grain<Dim>(in, header.corners, i);
        const auto name = "grain " + std::to_string(i + 1);
        for (const std::string& complaint :
             {detail::grain_complaint(grain), detail::box_complaint(grain, scene.box_size)})
            if (!complaint.empty()) in.fail(name, complaint);
        scene.grains.push_back(std::move(grain));
    }
    in.expect_end_of_text();
    if (const std::string complaint = detail::mean_radius_complaint(scene); !complaint.empty())
        in.fail_at(mean_radius_line, "rmean [m]", complaint);
    if (const auto pair = first_overlap(scene.grains, detail::file_tolerance))
        in.fail_at(first_grain_line + pair->second, "grain " + std::to_string(pair->second + 1),
                   "overlaps grain " + std::to_string(pair->first + 1) + " of line " +
                       std::to_string(first_grain_line + pair->first) +
                       ", but grains must be apart at the start");
    return scene;
}

/// Reads a scene file; see parse_scene.
template <int Dim>
Scene<Dim> read_scene(const std::filesystem::path& path) {
    std::ifstream file = detail::open_file(path, "a scene file");
    return parse_scene<Dim>(file, path.string());
}

/// The dimension a scene file speaks of, to choose between read_scene<2> and read_scene<3>.
inline int scene_dimension(const std::filesystem::path& path) {
    std::ifstream file = detail::open_file(path, "a scene file");
    LineReader in(file, path.string());
    return detail::read_header(in).dim;
}

/// The text of a scene file, as many digits as it takes to read back the same bits; or at most
/// `digits` significant ones. Throws input_error when balls and shapes with corners are mixed,
/// which the format cannot say, or when there is no grain.
template <int Dim>
std::string scene_text(const Scene<Dim>& scene, int digits = 0) {
    const auto text_of = [digits](double x) { return detail::number_text(x, digits); };
    const auto corners = static_cast<std::size_t>(std::count_if(
        scene.grains.begin(), scene.grains.end(), [](const auto& g) { return !g.is_ball(); }));
    require_in("grains with corners in a scene", static_cast<double>(corners),
               corners == 0 ? 0.0 : static_cast<double>(scene.grains.size()),
               static_cast<double>(scene.grains.size()));
    require_in("grains in a scene", static_cast<double>(scene.grains.size()), 1.0,
               static_cast<double>(detail::largest_grain_count));
    const auto& names = corners == 0 ? detail::ball_names : detail::corner_names;
    std::string text = "pile 1\ndim " + std::to_string(Dim) + " shape " + names[Dim - 2] + " n " +
                       std::to_string(scene.grains.size()) + "\nbox";
    for (int i = 0; i < 3; ++i) text += i + 1 < Dim ? " " + text_of(scene.box_size[i]) : " 0";
    text += "\nmu " + text_of(scene.mu) + " rho " + text_of(scene.density) + " g " +
            text_of(scene.gravity) + " rmean " + text_of(scene.mean_radius) + "\n";
    for (const auto& grain : scene.grains) {
        for (const double x : grain.position) text += text_of(x) + " ";
        text += text_of(grain.radius);
        if (!grain.is_ball()) text += " " + std::to_string(grain.vertices.size());
        for (const auto& v : grain.vertices)
            for (const double x : v) text += " " + text_of(x);
        text += "\n";
    }
    return text;
}

/// Writes a scene file, whole or not at all; `digits` as for scene_text.
template <int Dim>
void write_scene(const std::filesystem::path& path, const Scene<Dim>& scene, int digits = 0) {
    write_file(path, scene_text(scene, digits));
}

}  // namespace talus
