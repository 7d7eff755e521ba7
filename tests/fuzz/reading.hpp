// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/hull/coordinate_rounding.hpp>
#include <talus/io/mesh/read_obj.hpp>
#include <talus/io/mesh/read_stl.hpp>
#include <talus/io/scene_file.hpp>

#include <cmath>
#include <cstdint>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What must hold of any bytes that a reader is given: they are refused in one printable sentence
/// that begins with the file's name, or what was read is sound.
namespace reading {

using talus::Vector;

/// What was expected and did not hold.
struct broken : std::logic_error {
    using std::logic_error::logic_error;
};

inline void demand(bool holds, const std::string& what) {
    if (!holds) throw broken(what);
}

/// Complaints of files quote them, but no byte of theirs reaches a terminal raw.
inline void demand_one_sentence(std::string_view complaint, std::string_view beginning) {
    demand(complaint.starts_with(beginning),
           "complaint without the file: " + std::string(complaint));
    demand(complaint.size() < 2000, "complaint of " + std::to_string(complaint.size()) + " bytes");
    for (const char c : complaint) {
        const auto byte = static_cast<unsigned char>(c);
        demand(byte >= 0x20 && byte != 0x7f, "control character in a complaint");
    }
}

/// The hull of any points, or a complaint of the library's own; what there is has a positive,
/// finite volume, holds all points and has faces of its own corners.
template <int Dim>
void check_hull_of(const std::vector<Vector<Dim>>& points) {
    constexpr std::size_t enough = 2000;  // the check costs points times faces
    if (points.size() > enough) return;
    try {
        const talus::HullOfPoints<Dim> hull(points);
        const talus::CoreView<Dim> core = hull.polytope.core();
        const double volume = hull.polytope.mass_properties().volume;
        demand(std::isfinite(volume) && volume > 0.0, "hull of volume " + std::to_string(volume));
        demand(hull.kept.size() == core.vertices.size(), "hull with corners of no point");
        // Faces are fitted to points of few digits, so that some are outside by their rounding.
        double extent = 0.0;
        for (const auto& x : points) extent = std::max(extent, x.norm());
        const double rounding = std::max(4.0 * talus::coordinate_rounding<Dim>(points),
                                         talus::convex_hull<Dim>(core.vertices, {}).tolerance);
        const double slack = 1e-12 * extent + 2.5 * rounding;
        for (const auto& n : core.normals) {
            demand(std::abs(n.norm() - 1.0) < 1e-9, "normal that is no unit vector");
            const double height = n.dot(hull.polytope.support(n));
            for (const auto& x : points)
                demand(n.dot(x) <= height + slack, "point outside of its hull");
        }
    } catch (const talus::input_error& error) {
        demand_one_sentence(error.what(), "");
    }
}

template <int Dim>
void check_scene_of(std::string_view bytes) {
    const std::string file = "pile.txt";
    try {
        std::istringstream text{std::string(bytes)};
        const talus::Scene<Dim> scene = talus::parse_scene<Dim>(text, file);
        const std::string written = talus::scene_text(scene);
        std::istringstream again{written};
        demand(talus::scene_text(talus::parse_scene<Dim>(again, file)) == written,
               "scene that does not read back");
        for (const auto& grain : scene.grains) {
            if (grain.is_ball()) continue;
            // What the reader takes can be simulated.
            const talus::ConvexPolytope<Dim> shape(grain.vertices);
            const double volume = shape.mass_properties().volume;
            demand(std::isfinite(volume) && volume > 0.0, "grain of no volume");
            demand(shape.mass_properties().centroid.norm() <=
                       1.001 * talus::detail::grain_tolerance(grain),
                   "grain off its position");
        }
    } catch (const talus::input_error& error) {
        demand_one_sentence(error.what(), file + ", line ");
    }
}

inline void check_scene(std::string_view bytes) {
    check_scene_of<2>(bytes);
    check_scene_of<3>(bytes);
}

template <class Parse>
void check_mesh(std::string_view bytes, const std::string& file, Parse&& parse) {
    talus::Mesh mesh;
    try {
        mesh = parse(bytes, file);
    } catch (const talus::input_error& error) {
        demand_one_sentence(error.what(), file);
        return;
    }
    demand(!mesh.triangles.empty(), "mesh without a triangle");
    for (const auto& x : mesh.vertices)
        demand(x.allFinite() && x.cwiseAbs().maxCoeff() <= 1e12, "vertex out of range");
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t)
            demand(v < mesh.vertices.size(), "triangle of a vertex that is not there");
        demand(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "triangle of two corners");
    }
    check_hull_of<3>(mesh.vertices);
}

inline void check_obj(std::string_view bytes) {
    check_mesh(bytes, "rock.obj", [](std::string_view b, const std::string& file) {
        std::istringstream text{std::string(b)};
        return talus::parse_obj(text, file);
    });
}
inline void check_stl(std::string_view bytes) {
    check_mesh(bytes, "rock.stl", [](std::string_view b, const std::string& file) {
        return talus::parse_stl(std::string(b), file);
    });
}

/// Points from the bytes themselves, three of them a coordinate: few digits, so that many fall
/// into planes and lines, or all that a number has.
template <int Dim>
void check_points(std::string_view bytes) {
    if (bytes.empty()) return;
    const auto at = [&](std::size_t i) {
        return static_cast<int>(static_cast<unsigned char>(bytes[i]));
    };
    const int digits = at(0) % 17;
    const double unit = std::pow(10.0, -digits);
    std::vector<Vector<Dim>> points;
    for (std::size_t i = 1; i + 3 * Dim <= bytes.size() && points.size() < 200; i += 3 * Dim) {
        Vector<Dim> x;
        for (std::size_t c = 0; c < Dim; ++c) {
            const int number = at(i + 3 * c) * 65536 + at(i + 3 * c + 1) * 256 + at(i + 3 * c + 2);
            x[static_cast<int>(c)] = std::round((number / 8388608.0 - 1.0) / unit) * unit;
        }
        points.push_back(x);
    }
    check_hull_of<Dim>(points);
}

inline void check_hulls(std::string_view bytes) {
    check_points<2>(bytes);
    check_points<3>(bytes);
}

}  // namespace reading
