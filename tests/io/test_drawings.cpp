// SPDX-License-Identifier: BSL-1.0
#include <talus/io/pile_drawing.hpp>
#include <talus/io/space_drawing.hpp>
#include <talus/io/svg.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(io_drawings)

std::size_t occurrences(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

BOOST_AUTO_TEST_CASE(metres_become_pixels_with_y_upwards) {
    talus::Svg svg({0.0, 0.0}, {2.0, 1.0}, 200.0);
    svg.circle({0.5, 0.25}, 0.1, {.fill = "none"});
    svg.line({0.0, 0.0}, {2.0, 1.0}, {.stroke = "#000", .stroke_width = 0.02});
    const std::string text = svg.str();
    BOOST_CHECK_EQUAL(occurrences(text, "cx=\"50\" cy=\"75\" r=\"10\""), 1u);
    BOOST_CHECK_EQUAL(
        occurrences(text,
                    "x1=\"0\" y1=\"100\" x2=\"200\" y2=\"0\" stroke=\"#000\" stroke-width=\"2\""),
        1u);
    BOOST_CHECK_EQUAL(occurrences(text, "viewBox=\"0 0 200 100\""), 1u);
}

BOOST_AUTO_TEST_CASE(words_are_escaped_and_numbers_are_short) {
    talus::Svg svg({0.0, 0.0}, {1.0, 1.0}, 100.0);
    svg.text({0.5, 0.5}, "a < b & \"c\"\x01");
    BOOST_CHECK_EQUAL(occurrences(svg.str(), ">a &lt; b &amp; &quot;c&quot;</text>"), 1u);
    BOOST_CHECK_EQUAL(talus::Svg::number(1.0), "1");
    BOOST_CHECK_EQUAL(talus::Svg::number(-0.001), "0");
    BOOST_CHECK_EQUAL(talus::Svg::number(-12.345), "-12.35");
    BOOST_CHECK_EQUAL(talus::svg_grey(0.0), "#000000");
    BOOST_CHECK_EQUAL(talus::svg_grey(2.0), "#ffffff");
}

/// Two grains, the heavier loaded one second, and one contact with a wall.
talus::PileDrawing two_grains() {
    talus::PileDrawing pile{.box_width = 1.0};
    pile.grains = {{{0.3, 0.1}, 0.1, 1.0, {}},
                   {{0.6, 0.1}, 0.1, 4.0, {{0.5, 0.0}, {0.7, 0.0}, {0.6, 0.2}}}};
    pile.contacts = {{{0.3, 0.1}, {0.3, 0.0}, {0.3, 0.0}, 2.0}};
    pile.title = "two";
    return pile;
}

BOOST_AUTO_TEST_CASE(the_picture_of_the_plane_shows_every_grain_and_every_strong_contact) {
    auto pile = two_grains();
    const std::string text = talus::pile_svg(pile);
    BOOST_CHECK_EQUAL(occurrences(text, "<circle"), 1u);
    BOOST_CHECK_EQUAL(occurrences(text, "<polygon"), 1u);
    // Walls and the one chain are polylines.
    BOOST_CHECK_EQUAL(occurrences(text, "<polyline"), 2u);
    pile.contacts.push_back({{0.3, 0.1}, {0.45, 0.1}, {0.6, 0.1}, 1e-6});
    BOOST_CHECK_EQUAL(occurrences(talus::pile_svg(pile), "<polyline"), 2u);
    pile.contacts.back().force = 1.0;
    BOOST_CHECK_EQUAL(occurrences(talus::pile_svg(pile), "<polyline"), 3u);
}

BOOST_AUTO_TEST_CASE(lines_lie_on_top_and_must_be_drawable) {
    auto pile = two_grains();
    pile.lines = {{{{0.1, 0.1}, {0.2, 0.3}, {0.4, 0.1}}, "#123456", 0.5}};
    const std::string text = talus::pile_svg(pile);
    BOOST_CHECK_EQUAL(occurrences(text, "<polyline"), 3u);
    BOOST_CHECK_GT(text.find("#123456"), text.find(talus::detail::chain_colour));
    pile.lines[0].width = 0.0;
    BOOST_CHECK_THROW(talus::pile_svg(pile), talus::input_error);
    pile.lines[0].width = 0.5;
    pile.lines[0].points[1][0] = std::nan("");
    BOOST_CHECK_THROW(talus::pile_svg(pile), talus::input_error);
}

BOOST_AUTO_TEST_CASE(a_heavier_load_is_darker) {
    const talus::detail::GreyScale grey{10.0, 0.3, 0.9};
    BOOST_CHECK_EQUAL(grey.lightness(0.0), 0.9);
    BOOST_CHECK_CLOSE(grey.lightness(10.0), 0.3, 1e-12);
    BOOST_CHECK_CLOSE(grey.lightness(99.0), 0.3, 1e-12);
    BOOST_CHECK_LT(grey.lightness(6.0), grey.lightness(5.0));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_is_named) {
    const double nan = std::nan("");
    auto pile = two_grains();
    pile.grains[1].centre[0] = nan;
    BOOST_CHECK_EXCEPTION(talus::pile_svg(pile), talus::input_error, [](const auto& e) {
        return std::string(e.what()).find("drawn grain 1") == 0;
    });
    pile = two_grains();
    pile.contacts[0].force = -1.0;
    BOOST_CHECK_THROW(talus::pile_svg(pile), talus::input_error);
    pile = two_grains();
    pile.box_width = 0.0;
    BOOST_CHECK_THROW(talus::pile_svg(pile), talus::input_error);
    talus::SpaceDrawing space{.box_sides = {1.0, 1.0}};
    BOOST_CHECK_THROW(talus::space_svg(space), talus::input_error);
    space.grains = {{{0.5, 0.5, nan}, 0.1, 1.0}};
    BOOST_CHECK_THROW(talus::space_svg(space), talus::input_error);
}

BOOST_AUTO_TEST_CASE(the_picture_of_space_shows_the_back_half) {
    talus::SpaceDrawing space{.box_sides = {1.0, 1.0}};
    space.grains = {{{0.5, 0.8, 0.1}, 0.1, 1.0}, {{0.5, 0.2, 0.1}, 0.1, 1.0}};
    // A ball is a disc and its shade.
    BOOST_CHECK_EQUAL(occurrences(talus::space_svg(space), "<circle"), 2u);
    space.grains[1].centre[1] = 0.6;
    BOOST_CHECK_EQUAL(occurrences(talus::space_svg(space), "<circle"), 4u);
}

BOOST_AUTO_TEST_CASE(of_a_cube_three_faces_show) {
    talus::DrawnSolid cube{{0.5, 0.8, 0.1}, 0.2, 1.0};
    using V = talus::Vector<3>;
    for (int axis = 0; axis < 3; ++axis)
        for (double sign : {1.0, -1.0}) {
            const V n = sign * V::Unit(axis), u = V::Unit((axis + 1) % 3), v = n.cross(u);
            cube.faces.push_back({});
            for (const V& corner : {V(n + u + v), V(n - u + v), V(n - u - v), V(n + u - v)})
                cube.faces.back().push_back(cube.centre + 0.1 * corner);
        }
    talus::SpaceDrawing space{.box_sides = {1.0, 1.0}};
    space.grains = {cube};
    BOOST_CHECK_EQUAL(occurrences(talus::space_svg(space), "<polygon"), 3u);
}

BOOST_AUTO_TEST_SUITE_END()
