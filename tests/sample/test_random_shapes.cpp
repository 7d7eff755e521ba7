// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_polyhedron.hpp>

#include <boost/test/unit_test.hpp>

using talus::Vector;

BOOST_AUTO_TEST_SUITE(sample_random_shapes)

constexpr double radius = 0.005;
constexpr double rounding = 1e-13 * radius;  // of a few tens of operations on lengths of this size

BOOST_AUTO_TEST_CASE(polygons_are_convex_and_centred_and_reach_their_radius) {
    talus::Random random(21);
    for (int trial = 0; trial < 500; ++trial) {
        const auto v = talus::random_polygon(random, radius);
        const std::size_t n = v.size();
        BOOST_REQUIRE(n >= 4u);
        BOOST_REQUIRE(n <= 8u);
        for (std::size_t i = 0; i < n; ++i)
            BOOST_REQUIRE(talus::turn(v[i], v[(i + 1) % n], v[(i + 2) % n]) > 0.0);
        BOOST_REQUIRE(talus::centroid(v).norm() < rounding);
        BOOST_REQUIRE(std::abs(talus::bounding_radius<2>(v) - radius) < rounding);
    }
}

BOOST_AUTO_TEST_CASE(polyhedra_are_convex_thick_and_centred_and_reach_their_radius) {
    talus::Random random(22);
    const talus::RandomPolyhedronParams params;
    for (int trial = 0; trial < 40; ++trial) {
        const auto v = talus::random_polyhedron(random, radius, params);
        BOOST_REQUIRE(v.size() >= 8u);
        BOOST_REQUIRE(v.size() <= 14u);
        const auto faces = talus::convex_hull<3>(v).faces;
        // Every corner is one of the hull, and Euler's formula holds.
        std::vector<bool> named(v.size(), false);
        std::size_t edges = 0;
        for (const auto& f : faces) {
            edges += f.size();
            for (const auto corner : f) named[corner] = true;
        }
        BOOST_REQUIRE(std::count(named.begin(), named.end(), true) ==
                      static_cast<std::ptrdiff_t>(v.size()));
        BOOST_REQUIRE(v.size() + faces.size() == edges / 2 + 2);
        BOOST_REQUIRE(talus::solid_centre(v, faces).centroid.norm() < rounding);
        BOOST_REQUIRE(std::abs(talus::bounding_radius<3>(v) - radius) < rounding);
        // Scaling about the centroid by at least 1 / (1 + eccentricity) keeps half the thickness.
        BOOST_REQUIRE(talus::detail::least_depth(v, faces, Vector<3>::Zero()) >
                      0.5 * params.thickness * radius);
    }
}

BOOST_AUTO_TEST_CASE(equal_seeds_give_equal_shapes) {
    talus::Random a(23), b(23);
    BOOST_TEST((talus::random_polygon(a, 1.0) == talus::random_polygon(b, 1.0)));
    BOOST_TEST((talus::random_polyhedron(a, 1.0) == talus::random_polyhedron(b, 1.0)));
}

BOOST_AUTO_TEST_CASE(impossible_shapes_are_refused) {
    talus::Random random(24);
    BOOST_CHECK_THROW(talus::random_polygon(random, 0.0), talus::input_error);
    BOOST_CHECK_THROW(talus::random_polygon(random, 1.0, {.fewest_vertices = 2}),
                      talus::input_error);
    BOOST_CHECK_THROW(talus::random_polygon(random, 1.0, {.fewest_vertices = 9}),
                      talus::input_error);
    BOOST_CHECK_THROW(talus::random_polyhedron(random, -1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::random_polyhedron(random, 1.0, {.spread = 1.0}), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
