// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/overlap.hpp>
#include <talus/sample/polygon.hpp>
#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_scene.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"

using talus::Grain;
using talus::Vector;

BOOST_AUTO_TEST_SUITE(sample_overlap)

/// A cube of side 2 about `position`: a square in the plane.
template <int Dim>
Grain<Dim> cube(const Vector<Dim>& position) {
    Grain<Dim> g{position, std::sqrt(static_cast<double>(Dim)), {}};
    for (unsigned corner = 0; corner < 1u << Dim; ++corner) {
        Vector<Dim> v;
        for (int i = 0; i < Dim; ++i) v[i] = corner >> i & 1u ? 1.0 : -1.0;
        g.vertices.push_back(v);
    }
    return g;
}

/// Independent oracle: two convex polygons are apart iff the normal of some side says so.
bool apart_by_sides(const Grain<2>& a, const Grain<2>& b, double tolerance) {
    const std::size_t n = a.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector<2> side = a.vertices[(i + 1) % n] - a.vertices[i];
        const Vector<2> normal = Vector<2>(side[1], -side[0]).normalized();
        double least = 1e9;
        for (const auto& v : b.vertices)
            least = std::min(least, normal.dot(b.position + v - a.position - a.vertices[i]));
        if (least > -tolerance) return true;
    }
    return false;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(cubes_overlap_when_nearer_than_their_side, D, dimensions) {
    constexpr int Dim = D::value;
    const auto at = [](double x) {
        return cube<Dim>(Vector<Dim>::Unit(0) * x + Vector<Dim>::Unit(1) * 0.3);
    };
    const auto origin = cube<Dim>(Vector<Dim>::Zero());
    BOOST_TEST(talus::overlap(origin, at(0.0)));
    BOOST_TEST(talus::overlap(origin, at(1.0)));
    BOOST_TEST(talus::overlap(origin, at(1.9999)));
    BOOST_TEST(!talus::overlap(origin, at(2.0)));  // touching is not overlapping
    BOOST_TEST(!talus::overlap(origin, at(2.0001)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_overlap_when_nearer_than_their_radii, D, dimensions) {
    constexpr int Dim = D::value;
    const Grain<Dim> a{Vector<Dim>::Zero(), 1.0, {}};
    const Vector<Dim> d = Vector<Dim>::Constant(1.0).normalized();
    BOOST_TEST(talus::overlap(a, Grain<Dim>{2.9999 * d, 2.0, {}}));
    BOOST_TEST(!talus::overlap(a, Grain<Dim>{3.0 * d, 2.0, {}}));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_overlaps_a_cube_at_its_corner_only_when_it_reaches_it, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const auto origin = cube<Dim>(Vector<Dim>::Zero());
    const Vector<Dim> diagonal = Vector<Dim>::Constant(1.0);
    const double reach = std::sqrt(static_cast<double>(Dim));
    BOOST_TEST(talus::overlap(origin, Grain<Dim>{2.0 * diagonal, 1.0001 * reach, {}}));
    BOOST_TEST(!talus::overlap(origin, Grain<Dim>{2.0 * diagonal, 0.9999 * reach, {}}));
    BOOST_TEST(talus::overlap(Grain<Dim>{Vector<Dim>::Unit(0) * 2.5, 1.6, {}}, origin));
    BOOST_TEST(!talus::overlap(Grain<Dim>{Vector<Dim>::Unit(0) * 2.5, 1.4, {}}, origin));
}

BOOST_AUTO_TEST_CASE(polygons_agree_with_the_test_of_all_sides) {
    talus::Random random(41);
    int overlapping = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const Grain<2> a{Vector<2>::Zero(), 1.0, talus::random_polygon(random, 1.0)};
        const Vector<2> p(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
        const Grain<2> b{p, 1.0, talus::random_polygon(random, 1.0)};
        const bool seen = talus::overlap(a, b);
        overlapping += seen;
        BOOST_REQUIRE(seen == !(apart_by_sides(a, b, 2e-6) || apart_by_sides(b, a, 2e-6)));
    }
    BOOST_TEST(overlapping > 500);
    BOOST_TEST(overlapping < 4500);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_cells_find_the_pair_that_all_pairs_find, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(42);
    int found = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Grain<Dim>> grains(30);
        for (auto& g : grains) {
            for (double& x : g.position) x = random.uniform(-1.0, 1.0);
            g.radius = random.uniform(0.01, 0.06);
        }
        std::optional<std::pair<std::size_t, std::size_t>> expected;
        for (std::size_t b = 0; b < grains.size() && !expected; ++b)
            for (std::size_t a = 0; a < b && !expected; ++a)
                if (talus::overlap(grains[a], grains[b])) expected = {a, b};
        BOOST_REQUIRE((talus::first_overlap(grains) == expected));
        found += expected.has_value();
    }
    BOOST_TEST(found > 5);
    BOOST_TEST(found <= 200);
}

BOOST_AUTO_TEST_SUITE_END()
