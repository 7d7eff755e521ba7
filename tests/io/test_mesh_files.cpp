// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/convex_polytope.hpp>
#include <talus/io/mesh/read_obj.hpp>
#include <talus/io/mesh/read_stl.hpp>
#include <talus/io/scene_file.hpp>
#include <talus/io/write_file.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <sys/stat.h>

#include "common/hull_tester.hpp"
#include "io/temporary_folder.hpp"

using talus::Mesh;
using talus::Vector;

BOOST_AUTO_TEST_SUITE(io_mesh_files)

Mesh obj(const std::string& text) {
    std::istringstream stream(text);
    return talus::parse_obj(stream, "rock.obj");
}
Mesh stl(const std::string& bytes) { return talus::parse_stl(bytes, "rock.stl"); }

template <class Read>
std::string complaint(Read read, const std::string& text) {
    try {
        read(text);
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return {};
}
void check(const std::string& found, const std::vector<std::string>& words) {
    for (const auto& word : words)
        BOOST_TEST(found.find(word) != std::string::npos, "'" << word << "' is not in: " << found);
    BOOST_TEST(found.find('\n') == std::string::npos);
}

std::string bytes_of(std::uint32_t x) {
    std::string s;
    for (int i = 0; i < 4; ++i) s += static_cast<char>(x >> 8 * i & 0xffu);
    return s;
}
std::string bytes_of(double x) {
    return bytes_of(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
}

/// A binary STL file whose header reads `title`.
std::string binary(const Mesh& mesh, const std::string& title = "solid rock") {
    std::string s = title + std::string(80 - title.size(), ' ');
    s += bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& t : mesh.triangles) {
        s += std::string(12, '\0');
        for (const auto v : t)
            for (const double x : mesh.vertices[v]) s += bytes_of(x);
        s += std::string(2, '\0');
    }
    return s;
}
/// A text STL file with `digits` digits.
std::string text(const Mesh& mesh, int digits, const std::string& end_of_line) {
    std::string s = "solid rock" + end_of_line;
    char line[128];
    for (const auto& t : mesh.triangles) {
        s += "  facet normal 0 0 0" + end_of_line + "    outer loop" + end_of_line;
        for (const auto v : t) {
            const auto& x = mesh.vertices[v];
            std::snprintf(line, sizeof line, "      vertex %.*e %.*e %.*e", digits - 1, x[0],
                          digits - 1, x[1], digits - 1, x[2]);
            s += line + end_of_line;
        }
        s += "    endloop" + end_of_line + "  endfacet" + end_of_line;
    }
    return s + "endsolid rock" + end_of_line;
}
std::string obj_text(const Mesh& mesh, int decimals, const std::string& end_of_line) {
    std::string s = "# a rock" + end_of_line + "mtllib rock.mtl" + end_of_line;
    char line[128];
    for (const auto& x : mesh.vertices) {
        std::snprintf(line, sizeof line, "v %.*f %.*f %.*f", decimals, x[0], decimals, x[1],
                      decimals, x[2]);
        s += line + end_of_line;
    }
    for (const auto& t : mesh.triangles)
        s += "f " + std::to_string(t[0] + 1) + "//1 " + std::to_string(t[1] + 1) + "//1 " +
             std::to_string(t[2] + 1) + "//1" + end_of_line;
    return s;
}

/// A prism whose faces are divided into triangles as modelling programs do.
Mesh fine_prism(int sides, int divisions, const talus::Rotation<3>& turn) {
    const auto corners = hull_tester::turned(hull_tester::prism(sides, 0.7, 1.1), turn);
    talus::detail::MeshBuilder mesh;
    const auto quad = [&](const auto& a, const auto& b, const auto& c, const auto& d) {
        const auto at = [&](int i, int j) {
            const double s = static_cast<double>(i) / divisions,
                         t = static_cast<double>(j) / divisions;
            return mesh.vertex((1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c));
        };
        for (int i = 0; i < divisions; ++i)
            for (int j = 0; j < divisions; ++j) {
                mesh.triangle({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                mesh.triangle({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
    };
    const auto n = static_cast<std::size_t>(sides);
    const Vector<3> low = turn * Vector<3>(0, 0, -0.55), high = turn * Vector<3>(0, 0, 0.55);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        quad(corners[i], corners[j], corners[n + j], corners[n + i]);
        quad(low, corners[j], Vector<3>(0.5 * (corners[i] + corners[j])), corners[i]);
        quad(high, corners[n + i], Vector<3>(0.5 * (corners[n + i] + corners[n + j])),
             corners[n + j]);
    }
    return mesh.take();
}

const std::string one_triangle =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid\n";
std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    BOOST_REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

BOOST_AUTO_TEST_CASE(meshes_of_any_digits_give_the_body_that_was_meant) {
    hull_tester::Source random(91);
    for (const int sides : {3, 4, 6, 12, 24})
        for (const int digits : {5, 6, 7, 8}) {
            const Mesh meant = fine_prism(sides, 6, random.rotation());
            const std::string end = digits % 2 ? "\r\n" : "\n";
            for (const Mesh& mesh : {stl(binary(meant)), stl(text(meant, digits, end)),
                                     obj(obj_text(meant, digits, end))}) {
                BOOST_TEST(mesh.triangles.size() == meant.triangles.size());
                const talus::HullOfPoints<3> hull{std::span<const Vector<3>>(mesh.vertices)};
                BOOST_TEST(hull.polytope.core().face_count() == static_cast<std::size_t>(sides + 2),
                           sides << " sides, " << digits
                                 << " digits: " << hull.polytope.core().face_count() << " faces");
                BOOST_TEST(hull.kept.size() == static_cast<std::size_t>(2 * sides));
                hull_tester::check_polyhedron(hull.polytope, 3e-4);
            }
        }
}

BOOST_AUTO_TEST_CASE(the_quads_and_counts_of_obj_are_read) {
    const Mesh cube = obj(
        "\xef\xbb\xbf# cube\no cube\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0 0.5 0.5 0.5\nv 0 0 1\n"
        "v 1 0 1\nv 1 1 1\nv 0 1 1 # last\nvn 0 0 1\nvt 0 0\nusemtl grey\ns off\n"
        "f 4 3 2 1\nf -4 -3 -2 -1 # top\nf 1/1 2/1 6/1 5/1\nf 2//1 3//1 7//1 6//1\n"
        "f 3/1/1 4/1/1 8/1/1 7/1/1\nf 4 1 5 8\nl 1 2\n");
    BOOST_TEST(cube.vertices.size() == 8u);
    BOOST_TEST(cube.triangles.size() == 12u);
    BOOST_TEST(cube.degenerate_count == 0u);
    double volume = 0.0;  // of a closed surface, turned outwards
    for (const auto& t : cube.triangles)
        volume += cube.vertices[t[0]].dot(cube.vertices[t[1]].cross(cube.vertices[t[2]])) / 6.0;
    BOOST_TEST(std::abs(volume - 1.0) < 1e-14);
}

BOOST_AUTO_TEST_CASE(what_writers_of_obj_are_free_to_do_is_read) {
    const Mesh plain = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const auto same = [&](const std::string& text) {
        const Mesh mesh = obj(text);
        BOOST_TEST((mesh.vertices == plain.vertices && mesh.triangles == plain.triangles), text);
        return mesh;
    };
    same("v +0 0 0\nv +1.0 0 0\nv 1 1 0\nv 0 +1e+0 0\nf 1 2 3 4\n");
    same("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n3\\\n 4\n");
    same("v 0 0 0# first\nv 1 0 0 # second\nv 1 1 0#\nv 0 1 0\nf 1 2 3 4# all\n# no more\n");
    same("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r");
    same("# C:\\\nv 0 0 0\nv 1 0 0 # C:\\\nv 1 1 0\nusemtl C:\\\nv 0 1 0\nf 1 2 3 \\ # C:\\\n4\n");
    same("v 0 0 1e-400\nv 1 0 -2E-9999\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    // Points that no face names are no part of the surface.
    const Mesh more =
        same("v 9 9 9\nv 0 0 0\nv 1 0 0\nv -5 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 5 6\nv 7 7 7\n");
    BOOST_TEST(more.unused_count == 3u);
    BOOST_TEST(plain.unused_count == 0u);
    check(complaint(obj, "v 0 0 0\nv 1 0 0\nv 0 +-1 0\nf 1 2 3\n"), {"line 3", "'+-1'"});
    check(complaint(obj, "v 0 0 0\nv 1 0 \\\nx\n"), {"line 3: vertex 2 z [m] is 'x'"});
}

BOOST_AUTO_TEST_CASE(what_is_no_file_is_refused_at_once) {
    const TemporaryFolder folder("pipe");
    const auto pipe = folder / "pipe";
    BOOST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);  // opening it would wait for a writer
    for (const auto& path : {pipe, folder / "", std::filesystem::path("/dev/zero")}) {
        BOOST_CHECK_THROW(talus::read_stl(path), talus::input_error);
        BOOST_CHECK_THROW(talus::read_obj(path), talus::input_error);
        BOOST_CHECK_THROW(talus::read_scene<2>(path), talus::input_error);
        BOOST_CHECK_THROW(talus::scene_dimension(path), talus::input_error);
    }
}

BOOST_AUTO_TEST_CASE(equal_corners_are_welded) {
    const Mesh two =
        obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv -0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n"
            "f 2 4 6\n");
    BOOST_TEST(two.vertices.size() == 4u);
    BOOST_TEST((two.triangles == std::vector<Mesh::Triangle>{{0, 1, 2}, {1, 3, 2}}));
    BOOST_TEST(two.degenerate_count == 1u);
}

BOOST_AUTO_TEST_CASE(a_surface_without_a_triangle_is_refused) {
    const auto refused = [](auto read, const std::string& text, const std::string& file,
                            const std::string& count) {
        check(complaint(read, text), {file, "holds 0 triangles", count, "at least one"});
    };
    refused(obj, "v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\nf 1 1 2\n", "rock.obj", "all 2 ");
    refused(obj, "v 0 0 0\nv 0 0 0\nf 1 2 1 2\n", "rock.obj", "all 2 ");
    const std::string point = with(with(one_triangle, "1 0 0", "0 0 0"), "0 1 0", "0 0 0");
    refused(stl, point, "rock.stl", "all 1 ");
    refused(stl, point + point, "rock.stl", "all 2 ");
    Mesh needle = stl(one_triangle);
    needle.triangles = {{0, 1, 0}, {1, 1, 1}, {2, 0, 0}};
    refused(stl, binary(needle), "rock.stl", "all 3 ");
    needle.triangles.push_back({0, 1, 2});
    BOOST_TEST(stl(binary(needle)).degenerate_count == 3u);
}

BOOST_AUTO_TEST_CASE(both_kinds_of_stl_are_told_apart_by_their_bytes) {
    const Mesh one = stl(one_triangle);
    BOOST_TEST(one.triangles.size() == 1u);
    for (const char* title : {"solid rock", "rock", "\x01\x02"})
        BOOST_TEST((stl(binary(one, title)).vertices == one.vertices));
    std::string capitals = one_triangle;
    for (char& c : capitals)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    BOOST_TEST((stl(capitals).vertices == one.vertices));
    BOOST_TEST(stl(one_triangle + one_triangle).triangles.size() == 2u);
    const TemporaryFolder folder("mesh");
    talus::write_file(folder / "rock.stl", binary(one));
    talus::write_file(folder / "rock.obj", obj_text(one, 7, "\n"));
    BOOST_TEST((talus::read_stl(folder / "rock.stl").vertices == one.vertices));
    BOOST_TEST((talus::read_obj(folder / "rock.obj").vertices == one.vertices));
    BOOST_CHECK_THROW(talus::read_stl(folder / "none.stl"), talus::input_error);
    BOOST_CHECK_THROW(talus::read_obj(folder / "none.obj"), talus::input_error);
}

BOOST_AUTO_TEST_CASE(wrong_stl_is_refused_by_line_or_byte) {
    const auto said = [](const std::string& bytes) { return complaint(stl, bytes); };
    check(said(""), {"rock.stl, line 1", "no triangle"});
    check(said("solid\nendsolid\n"), {"no triangle"});
    check(said(with(one_triangle, "1 0 0", "1 nan 0")),
          {"rock.stl, line 5: triangle 1: vertex 2 y [m] is 'nan'", "[-1e+12, 1e+12]"});
    check(said(with(one_triangle, "vertex 1 0 0", "vertex 1 0")),
          {"line 5", "vertex 2 z", "missing"});
    check(said(with(one_triangle, "outer", "inner")), {"line 3", "'inner'", "'outer'"});
    check(said(with(one_triangle, "endsolid", "")), {"ends", "'endsolid'"});
    check(said(with(one_triangle, "endloop", "vertex 0 0 0")), {"line 7", "'vertex'", "'endloop'"});
    check(said("v 0 0 0\n"), {"line 1", "'v'", "'solid'"});
    const Mesh one = stl(one_triangle);
    const std::string good = binary(one, "\x7frock");
    check(said(binary({})), {"byte 80", "is 0", "at least 1"});
    check(said(std::string("\0", 1) + good.substr(1, good.size() - 2)),
          {"byte 80", "count of triangles is 1", "134 bytes", "133"});
    // A header in words, as many programs write it.
    for (const char* title : {"numpy-stl", "solid x"}) {
        std::string padded = binary(one, title);
        std::replace(padded.begin(), padded.begin() + 80, '\0', ' ');
        BOOST_TEST((stl(padded).vertices == one.vertices));
        check(said(padded.substr(0, padded.size() - 1)), {"byte 80", "134 bytes", "133"});
        check(said(padded + '\0'), {"byte 80", "134 bytes", "135"});
    }
    std::string nan = good;
    nan.replace(96, 4, "\xff\xff\xff\x7f");
    check(said(nan), {"rock.stl, byte 96: triangle 1: vertex 1 x [m] is ", "nan"});
}

BOOST_AUTO_TEST_CASE(wrong_obj_is_refused_by_line) {
    const auto said = [](const std::string& bytes) { return complaint(obj, bytes); };
    const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    BOOST_TEST(said(good) == "");
    check(said(""), {"rock.obj, line 1", "no face"});
    check(said(with(good, "1 0 0", "1 0")), {"line 2: vertex 2 z [m]", "missing"});
    check(said(with(good, "1 0 0", "1 inf 0")), {"line 2: vertex 2 y [m]", "'inf'"});
    for (const char* corner : {"4", "0", "-4", "x", "1.5", "/2", "99999999999999999999"})
        check(said(with(good, "f 1", std::string("f ") + corner)),
              {"line 4: face 1: corner 1", "'" + std::string(corner) + "'", "[1, 3]", "[-3, -1]"});
    check(said(with(good, "f 1 2 3", "f 1 2")), {"line 4: face 1: corner 3", "missing"});
    check(said("f 1 2 3\n" + good), {"line 1", "corner 1 is '1'", "after the vertices"});
    check(said(with(good, "f 1", "f \x1b[2J")), {"'\\x1b[2J'"});
}

BOOST_AUTO_TEST_SUITE_END()
