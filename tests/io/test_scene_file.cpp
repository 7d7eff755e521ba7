// SPDX-License-Identifier: BSL-1.0
#include <talus/io/scene_file.hpp>
#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_polyhedron.hpp>
#include <talus/sample/random_scene.hpp>

#include <boost/test/unit_test.hpp>

#include <sstream>
#include <string>
#include <vector>

#include "common/dimensions.hpp"
#include "common/hull_tester.hpp"
#include "io/temporary_folder.hpp"

using talus::Vector;

BOOST_AUTO_TEST_SUITE(io_scene_file)

/// Corners of a grain of either dimension, so that one test body serves both.
std::vector<Vector<2>> random_corners(talus::Random& random, double r, talus::DimensionTag<2>) {
    return talus::random_polygon(random, r);
}
std::vector<Vector<3>> random_corners(talus::Random& random, double r, talus::DimensionTag<3>) {
    return talus::random_polyhedron(random, r);
}

/// The complaint about a text, or nothing.
template <int Dim>
std::string complaint(const std::string& text) {
    std::istringstream stream(text);
    try {
        talus::parse_scene<Dim>(stream, "pile.txt");
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return {};
}

const std::string head =
    "pile 1\ndim 2 shape disc n 2\nbox 0.1 0 0\nmu 0.4 rho 2600 g 9.81 rmean 0.005\n";
const std::string discs = head + "0.01 0.01 0.005\n0.03 0.01 0.005\n";
const std::string square =
    "pile 1\ndim 2 shape polygon n 1\nbox 9 0 0\nmu 0.4 rho 2600 g 9.81 rmean 1.414\n"
    "3 3 1.41421356 4 1 1 -1 1 -1 -1 1 -1\n";

/// `text` with its first `from` replaced, which must be there.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    BOOST_REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// Demands that the complaint names the line and holds all the words, in one sentence.
template <int Dim>
void check_refused(const std::string& text, int line, const std::vector<std::string>& words) {
    const std::string found = complaint<Dim>(text);
    const std::string where = "pile.txt, line " + std::to_string(line) + ": ";
    BOOST_TEST(found.substr(0, where.size()) == where);
    for (const auto& word : words)
        BOOST_TEST(found.find(word) != std::string::npos, "'" << word << "' is not in: " << found);
    BOOST_TEST(found.find('\n') == std::string::npos);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_written_is_read_back, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("scene");
    const auto law = talus::UniformRadii(0.004, 0.006);
    const talus::RandomSceneParams params{.grain_count = 40, .width = 0.06, .mu = 0.3, .seed = 9};
    const auto corners = [](talus::Random& random, double r) {
        return random_corners(random, r, D{});
    };
    for (const auto& scene :
         {talus::random_scene<Dim>(params, law), talus::random_scene<Dim>(params, law, corners)}) {
        const auto path = folder / "scene.txt";
        talus::write_scene(path, scene);
        BOOST_TEST(talus::scene_dimension(path) == Dim);
        const auto again = talus::read_scene<Dim>(path);
        BOOST_REQUIRE(again.grains.size() == scene.grains.size());
        BOOST_TEST(again.mu == scene.mu);
        BOOST_TEST(again.box_size[0] == scene.box_size[0]);
        BOOST_TEST(!std::isfinite(again.box_size[Dim - 1]));
        for (std::size_t i = 0; i < scene.grains.size(); ++i) {
            const auto &a = scene.grains[i], &b = again.grains[i];
            // Bit for bit.
            BOOST_TEST((a.position == b.position));
            BOOST_TEST(a.radius == b.radius);
            BOOST_TEST((a.vertices == b.vertices));
        }
        BOOST_TEST(talus::scene_text(again) == talus::scene_text(scene));
    }
}

BOOST_AUTO_TEST_CASE(the_common_scenes_are_read_and_written_without_a_change) {
    const std::filesystem::path shared = TALUS_SHARED_DATA "/scenes";
    if (!std::filesystem::exists(shared / "S2P_1000.txt")) {
        BOOST_TEST_MESSAGE("skipped, data not found");
        return;
    }
    for (const char* name : {"S2D_1000.txt", "S2P_1000.txt"})
        BOOST_TEST(talus::scene_text(talus::read_scene<2>(shared / name)) ==
                   content_of(shared / name));
    BOOST_TEST(talus::scene_text(talus::read_scene<3>(shared / "S3_1000.txt")) ==
               content_of(shared / "S3_1000.txt"));
}

BOOST_AUTO_TEST_CASE(the_scenes_of_the_examples_are_read) {
    const std::filesystem::path folder = TALUS_SOURCE_DIR "/examples/scenes";
    BOOST_TEST(talus::read_scene<2>(folder / "discs.txt").grains.size() == 300u);
    BOOST_TEST(talus::read_scene<2>(folder / "polygons.txt").grains.size() == 240u);
    BOOST_TEST(talus::read_scene<3>(folder / "spheres.txt").grains.size() == 300u);
    BOOST_TEST(talus::read_scene<3>(folder / "polyhedra.txt").grains.size() == 60u);
}

BOOST_AUTO_TEST_CASE(right_texts_are_accepted) {
    BOOST_TEST(complaint<2>(discs) == "");
    BOOST_TEST(complaint<2>(discs + "\n  \n") == "");
    BOOST_TEST(complaint<2>(square) == "");
    std::string dos = discs;
    for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2)
        dos.insert(at, "\r");
    BOOST_TEST(complaint<2>(dos) == "");
}

BOOST_AUTO_TEST_CASE(a_missing_file_is_named) {
    BOOST_CHECK_EXCEPTION(
        talus::read_scene<2>("no/such/file.txt"), talus::input_error, [](const auto& e) {
            return std::string(e.what()).find("no/such/file.txt") != std::string::npos;
        });
    BOOST_CHECK_THROW(talus::read_scene<2>("/"), talus::input_error);
    BOOST_CHECK_THROW(talus::scene_dimension("no/such/file.txt"), talus::input_error);
}

BOOST_AUTO_TEST_CASE(wrong_heads_are_refused) {
    check_refused<2>("", 1, {"ends", "pile 1"});
    check_refused<2>(with(discs, "pile 1", "pile 2"), 1, {"version", "'2'", "[1, 1]"});
    check_refused<2>(with(discs, "pile", "pole"), 1, {"'pole'", "'pile'"});
    check_refused<2>(with(discs, "dim 2", "dim 4"), 2, {"dim", "'4'", "[2, 3]"});
    check_refused<3>(discs, 2, {"dim", "is 2", "must be 3"});
    check_refused<2>(with(discs, "disc", "sphere"), 2,
                     {"shape", "'sphere'", "'disc' or 'polygon'"});
    check_refused<2>(with(discs, "n 2", "n 0"), 2, {"n", "'0'", "[1, "});
    check_refused<2>(with(discs, "n 2", "n 2.5"), 2, {"n", "'2.5'", "an integer"});
    check_refused<2>(with(discs, "n 2", "n 2 3"), 2, {"column 7", "'3'"});
    check_refused<2>(with(discs, "0.1 0 0", "0.1 0"), 3, {"box Lz", "missing"});
    check_refused<2>(with(discs, "0.1 0 0", "0.1 0 1"), 3, {"box Lz", "'1'", "[0, 0]"});
    check_refused<2>(with(discs, "box 0.1", "box inf"), 3, {"box Lx", "'inf'"});
    check_refused<2>(with(discs, "mu 0.4", "mu -0.4"), 4, {"mu", "'-0.4'", "[0, 1000]"});
    check_refused<2>(with(discs, "mu 0.4", "mu nan"), 4, {"mu", "'nan'"});
    check_refused<2>(with(discs, "mu", "friction"), 4, {"'friction'", "'mu'"});
    check_refused<2>(with(discs, "rho 2600", "rho 0"), 4, {"rho", "'0'"});
    check_refused<2>(with(discs, "g 9.81", "g 9.81m"), 4, {"g", "'9.81m'"});
    check_refused<2>(with(discs, "rmean 0.005", "rmean 0"), 4, {"rmean", "'0'"});
}

BOOST_AUTO_TEST_CASE(a_mean_radius_is_between_the_radii) {
    const std::string mixed = with(discs, "0.03 0.01 0.005", "0.03 0.01 0.002");
    for (const char* mean : {"0.002", "0.0035", "0.005", "0.00199999", "0.0050001"})
        BOOST_TEST(complaint<2>(with(mixed, "rmean 0.005", std::string("rmean ") + mean)) == "");
    for (const char* mean : {"1e6", "0.0051", "0.0019", "1e-9"})
        check_refused<2>(with(mixed, "rmean 0.005", std::string("rmean ") + mean), 4,
                         {"rmean [m]", "is ", "[0.002, 0.005]", "smallest", "largest"});
    check_refused<2>(with(mixed, "rmean 0.005", "rmean 1e6"), 4, {"is 1000000"});
    // Of three digits, as numbers are often given.
    BOOST_TEST(complaint<2>(with(square, "rmean 1.414", "rmean 1.41")) == "");
    check_refused<2>(with(square, "rmean 1.414", "rmean 1.43"), 4,
                     {"[0.70710678, 1.41421356]", "1 / 2 of the smallest"});
    // Half the side of a square is meant, for want of a radius.
    BOOST_TEST(complaint<2>(with(square, "rmean 1.414", "rmean 1")) == "");
    check_refused<2>(with(square, "rmean 1.414", "rmean 0.7"), 4, {"is 0.7"});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(few_grains_of_a_broad_law_are_read_back, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::UniformRadii law(0.001, 0.009);
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const std::size_t n : {1u, 2u, 3u}) {
            const auto scene =
                talus::random_scene<Dim>({.grain_count = n, .width = 0.1, .seed = seed}, law);
            BOOST_TEST(complaint<Dim>(talus::scene_text(scene)) == "");
            BOOST_TEST(complaint<Dim>(talus::scene_text(scene, 9)) == "");
        }
}

BOOST_AUTO_TEST_CASE(wrong_grains_are_refused) {
    check_refused<2>(with(discs, "0.03 0.01 0.005\n", ""), 6, {"ends", "grain 2"});
    check_refused<2>(discs + "0.05 0.01 0.005\n", 7, {"after the last grain", "'0.05'"});
    check_refused<2>(with(discs, "0.03 0.01 0.005", "0.03 0.01"), 6,
                     {"grain 2", "r [m]", "missing"});
    check_refused<2>(with(discs, "0.03 0.01 0.005", "0.03 0.01 0.005 1"), 6, {"column 4", "'1'"});
    check_refused<2>(with(discs, "0.03 0.01", "0.03 abc"), 6,
                     {"grain 2: y [m]", "'abc'", "a number"});
    check_refused<2>(with(discs, "0.03 0.01", "0.03 nan"), 6, {"grain 2: y [m]", "'nan'"});
    check_refused<2>(with(discs, "0.03 0.01", "0.03 1e999"), 6, {"grain 2: y [m]", "'1e999'"});
    check_refused<2>(with(discs, "0.03 0.01 0.005", "0.03 0.01 -0.005"), 6,
                     {"r [m]", "'-0.005'", "[1e-09, "});
    check_refused<2>(with(discs, "0.03 0.01 0.005", "0.03 0.01 0"), 6, {"r [m]", "'0'"});
    check_refused<2>(with(discs, "0.03 0.01", "0.098 0.01"), 6,
                     {"grain 2", "axis 1", "0.103", "[0, 0.1]"});
    check_refused<2>(with(discs, "0.03 0.01", "0.03 0.004"), 6, {"grain 2", "axis 2", "-0.001"});
    check_refused<2>(with(discs, "0.03 0.01", "0.0199 0.01"), 6,
                     {"grain 2", "overlaps grain 1", "line 5"});
}

BOOST_AUTO_TEST_CASE(wrong_polygons_are_refused) {
    const std::string corners = "4 1 1 -1 1 -1 -1 1 -1";
    check_refused<2>(with(square, corners, "2 1 1 -1 -1"), 5, {"vertex count", "'2'", "[3, 64]"});
    check_refused<2>(with(square, corners, "4 1 1 -1 1 -1 -1 1"), 5, {"vertex 4 y", "missing"});
    check_refused<2>(with(square, corners, "4 1 -1 -1 -1 -1 1 1 1"), 5,
                     {"area", "-4", "counter-clockwise"});
    check_refused<2>(with(square, corners, "5 1 1 1 1 -1 1 -1 -1 1 -1"), 5,
                     {"coincident", "1 and 2"});
    check_refused<2>(with(square, corners, "5 1 1 0 0.5 -1 1 -1 -1 1 -1"), 5,
                     {"convex", "vertex 2"});
    check_refused<2>(with(square, "1.41421356", "1.5"), 5, {"bounding radius 1.5", "1.41421356"});
    check_refused<2>(with(square, corners, "4 1 1 -1 1 -1 -1 0.5 -1"), 5, {"centroid"});
    // A five-pointed star turns left at each of its corners.
    check_refused<2>(with(with(square, "1.41421356", "1"), corners,
                          "5 1 0 -0.809016994 0.587785252 0.309016994 -0.951056516 0.309016994 "
                          "0.951056516 -0.809016994 -0.587785252"),
                     5, {"not convex", "once"});
}

BOOST_AUTO_TEST_CASE(wrong_polyhedra_are_refused) {
    const std::string before =
        "pile 1\ndim 3 shape polyhedron n 1\nbox 9 9 0\nmu 0.4 rho 2600 g 9.81 rmean 1.73\n";
    const std::string cube = " 1 1 1 1 1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 -1 -1 1 -1 -1 -1\n";
    const std::string r = "3 3 3 1.7320508 ";
    BOOST_TEST(complaint<3>(before + r + "8" + cube) == "");
    check_refused<3>(before + r + "9 0.1 0.2 0.3" + cube, 5, {"not convex", "vertex 1"});
    check_refused<3>(before + r + "4 1 1 1 -1 1 1 -1 -1 1 1 -1 1\n", 5, {"flat"});
    check_refused<3>(before + r + "4 1 1 1 -1 1 1 -1 -1 1 1 -1 -1\n", 5, {"centroid"});
    check_refused<3>(before + "3 3 0.9 1.7320508 8" + cube, 5, {"axis 3", "-0.1"});
}

BOOST_AUTO_TEST_CASE(polyhedra_of_few_digits_are_what_was_meant) {
    const auto turn = talus::Rotation<3>::exp({0.3, -0.7, 0.2});
    for (const int digits : {4, 5, 6, 7, 8, 9, 12, 15, 0})
        for (int n = 3; n <= 16; ++n) {
            talus::Scene<3> scene;
            scene.box_size.head<2>() << 9.0, 9.0;
            scene.density = 1.0;
            scene.grains.push_back({{4, 4, 4}, 0.0, {}});
            auto& grain = scene.grains[0];
            grain.vertices = hull_tester::turned(hull_tester::prism(n, 0.5, 0.4), turn);
            grain.radius = scene.mean_radius = talus::bounding_radius<3>(grain.vertices);
            std::istringstream text(talus::scene_text(scene, digits));
            const auto again = talus::parse_scene<3>(text, "pile.txt");
            const talus::ConvexPolytope<3> shape(again.grains[0].vertices);
            BOOST_TEST(shape.core().face_count() == static_cast<std::size_t>(n + 2));
        }
}

BOOST_AUTO_TEST_CASE(the_polyhedra_that_were_refused_are_read) {
    const std::filesystem::path faults = TALUS_SHARED_DATA "/faults";
    if (!std::filesystem::exists(faults / "hexagonal_prism_9_digits.txt")) {
        BOOST_TEST_MESSAGE("skipped, data not found");
        return;
    }
    for (const char* name : {"hexagonal_prism_9_digits.txt", "hexagonal_prism_12_digits.txt"}) {
        const auto scene = talus::read_scene<3>(faults / name);
        BOOST_TEST_REQUIRE(scene.grains.size() == 1u);
        const talus::ConvexPolytope<3> shape(scene.grains[0].vertices);
        BOOST_TEST(shape.core().face_count() == 8u);
    }
    const auto scene = talus::read_scene<3>(faults / "cube_with_face_centres.txt");
    const talus::ConvexPolytope<3> cube(scene.grains[0].vertices);
    BOOST_TEST(cube.core().face_count() == 6u);
    BOOST_TEST(cube.core().edges.size() == 12u);
    BOOST_TEST(talus::read_scene<2>(faults / "bom.txt").grains.size() == 3u);
}

BOOST_AUTO_TEST_CASE(byte_order_marks_are_passed_over_or_named) {
    BOOST_TEST(complaint<2>("\xef\xbb\xbf" + discs) == "");
    check_refused<2>("\xff\xfe" + discs, 1, {"byte order mark", "\\xff\\xfe", "UTF-16"});
    check_refused<2>("\xfe\xff" + discs, 1, {"byte order mark", "UTF-16"});
    check_refused<2>(with(discs, "mu", "\xef\xbb\xbfmu"), 4, {"'\\xef\\xbb\\xbfmu'", "'mu'"});
}

BOOST_AUTO_TEST_CASE(control_characters_are_shown_escaped) {
    check_refused<2>(with(discs, "0.03 0.01", "0.03 0\x1b[31m"), 6, {"'0\\x1b[31m'"});
    check_refused<2>(with(discs, "disc", "d\xffsc\xc2\x9b"), 2, {"'d\\xffsc\\xc2\\x9b'"});
    check_refused<2>(with(discs, "pile", "p\u00eele"), 1, {"'p\u00eele'"});
    check_refused<2>(with(discs, "mu", std::string(1000, 'm')), 4, {"mmm...'"});
    for (const char c : complaint<2>(with(discs, "mu", std::string("\0\x07\b", 3))))
        BOOST_TEST((c >= ' ' && c <= '~'));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(scenes_that_the_format_cannot_say_are_not_written, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(1);
    talus::Scene<Dim> scene;
    BOOST_CHECK_THROW(talus::scene_text(scene), talus::input_error);
    scene.grains.push_back({Vector<Dim>::Ones(), 1.0, {}});
    scene.grains.push_back({Vector<Dim>::Ones() * 4.0, 1.0, random_corners(random, 1.0, D{})});
    BOOST_CHECK_THROW(talus::scene_text(scene), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
