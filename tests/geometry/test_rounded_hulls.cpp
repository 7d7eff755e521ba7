// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/hull/coordinate_rounding.hpp>

#include <boost/test/unit_test.hpp>

#include <cstdio>
#include <cstdlib>

#include "common/hull_tester.hpp"

using hull_tester::rounded;
using hull_tester::Source;
using talus::Vector;

BOOST_AUTO_TEST_SUITE(geometry_rounded_hulls)

/// Each number as printf writes it with `digits` significant digits.
std::vector<Vector<3>> printed(std::vector<Vector<3>> v, int digits) {
    char text[40];
    for (auto& x : v)
        for (double& c : x) {
            std::snprintf(text, sizeof text, "%.*g", digits, c);
            c = std::strtod(text, nullptr);
        }
    return v;
}
std::vector<Vector<3>> in_single_precision(std::vector<Vector<3>> v) {
    for (auto& x : v)
        for (double& c : x) c = static_cast<double>(static_cast<float>(c));
    return v;
}
double rounding_of(const std::vector<Vector<3>>& v) { return talus::coordinate_rounding<3>(v); }

template <int Dim>
std::string refusal(const std::vector<Vector<Dim>>& v, const talus::HullOptions& options = {}) {
    try {
        talus::ConvexPolytope<Dim>(v, options);
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return {};
}

BOOST_AUTO_TEST_CASE(the_rounding_of_coordinates_is_read_off_their_digits) {
    Source random(71);
    for (int trial = 0; trial < 200; ++trial) {
        const auto exact = hull_tester::turned(
            hull_tester::prism(random.integer(4, 12), random.uniform(0.2, 0.5), 0.6),
            random.rotation());
        double largest = 0.0;
        for (const auto& x : exact) largest = std::max(largest, x.cwiseAbs().maxCoeff());
        const double decade = std::pow(10.0, std::floor(std::log10(largest)));
        BOOST_TEST(rounding_of(exact) < 1e-14);
        for (const double unit : {1e-4, 1e-6, 1e-8})
            BOOST_TEST(std::abs(rounding_of(rounded(exact, unit)) / unit - 0.5) < 1e-9);
        for (const int digits : {5, 7, 9})
            BOOST_TEST(
                std::abs(rounding_of(printed(exact, digits)) / decade * std::pow(10.0, digits - 1) -
                         0.5) < 1e-9);
        const double half_ulp = std::ldexp(0.5, std::ilogb(largest) - 23);
        BOOST_TEST(rounding_of(in_single_precision(exact)) == half_ulp);
        // Single precision, written out with nine digits.
        BOOST_TEST(rounding_of(printed(in_single_precision(exact), 9)) == half_ulp);
    }
    BOOST_TEST(rounding_of({{0, 0, 0}}) == 0.0);
}

BOOST_AUTO_TEST_CASE(rounded_prisms_have_the_faces_that_were_meant) {
    Source random(72);
    for (int trial = 0; trial < 1500; ++trial) {
        const int n = random.integer(3, 24);
        const double size = std::pow(10.0, random.integer(-3, 2));
        const double radius = size * random.uniform(0.4, 1.0),
                     height = size * random.uniform(0.2, 2);
        const double unit = trial % 8 == 0 ? 0.0 : size * std::pow(10.0, -random.integer(4, 10));
        const auto exact =
            hull_tester::turned(hull_tester::prism(n, radius, height), random.rotation());
        const talus::ConvexPolytope<3> shape(rounded(exact, unit));
        const double tolerance = std::max(3e-9 * size, 2.1 * unit);
        BOOST_TEST_CONTEXT("prism of " << n << " sides, radius " << radius << ", unit " << unit) {
            hull_tester::check_polyhedron(shape, tolerance);
            std::set<std::set<std::uint32_t>> meant;
            std::set<std::uint32_t> lower, upper;
            for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
                const auto m = static_cast<std::uint32_t>(n), j = (i + 1) % m;
                lower.insert(i);
                upper.insert(m + i);
                meant.insert({i, j, m + i, m + j});
            }
            meant.insert(lower);
            meant.insert(upper);
            BOOST_TEST((hull_tester::face_sets(shape) == meant));
            const double area = 0.5 * n * radius * radius * std::sin(2 * std::numbers::pi / n);
            const double surface =
                2 * area + n * height * 2 * radius * std::sin(std::numbers::pi / n);
            BOOST_TEST(std::abs(shape.mass_properties().volume - area * height) <=
                       surface * std::max(unit, 1e-14 * size));
        }
    }
}

BOOST_AUTO_TEST_CASE(hulls_of_random_points_agree_with_brute_force) {
    Source random(73);
    int compared = 0;
    for (int trial = 0; trial < 150; ++trial) {
        std::vector<Vector<3>> exact;
        // On a ball or on a lattice, whose hull has faces of many corners.
        const int count = random.integer(5, 16);
        const auto turn = random.rotation();
        for (int i = 0; i < count; ++i) {
            Vector<3> x(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            if (trial % 2 == 0)
                x.normalize();
            else
                for (double& c : x) c = std::round(1.2 * c);
            x = turn * x;
            if (std::ranges::none_of(exact, [&](const auto& y) { return (x - y).norm() < 1e-3; }))
                exact.push_back(x);
        }
        const auto [meant, clearance] = hull_tester::brute_force_faces(exact, 1e-9);
        if (meant.size() < 4) continue;
        // Digits that leave no doubt which points lie in which face.
        const double unit = std::pow(10.0, -random.integer(4, 8));
        if (clearance < 20 * unit) continue;
        try {
            const talus::HullOfPoints<3> hull{std::span<const Vector<3>>(rounded(exact, unit))};
            hull_tester::check_polyhedron(hull.polytope, 2.1 * unit + 4e-9);
            std::set<std::set<std::uint32_t>> found;
            for (const auto& set : hull_tester::face_sets(hull.polytope)) {
                std::set<std::uint32_t> named;
                for (const std::uint32_t v : set) named.insert(hull.kept[v]);
                found.insert(named);
            }
            // Brute force also names the points within faces and edges.
            BOOST_TEST(found.size() == meant.size());
            for (const auto& face : found)
                BOOST_TEST(std::ranges::any_of(
                    meant, [&](const auto& m) { return std::ranges::includes(m, face); }));
            ++compared;
        } catch (const talus::input_error& error) {
            BOOST_ERROR(error.what());
        }
    }
    BOOST_TEST(compared > 60);
}

BOOST_AUTO_TEST_CASE(vertices_within_faces_and_edges_stay_but_are_no_corners) {
    Source random(74);
    for (const double unit : {0.0, 1e-9, 1e-7, 1e-5}) {
        std::vector<Vector<3>> v;
        for (int i = 0; i < 8; ++i) v.emplace_back(i & 1, i >> 1 & 1, i >> 2);
        v.emplace_back(0.5, 0.5, 0.0);   // within a face
        v.emplace_back(0.0, 0.25, 0.7);  // within another
        v.emplace_back(0.3, 1.0, 1.0);   // on an edge
        const auto given = rounded(hull_tester::turned(v, random.rotation()), unit);
        const talus::ConvexPolytope<3> cube(given);
        hull_tester::check_polyhedron(cube, 2.1 * unit + 4e-9);
        BOOST_TEST(cube.core().face_count() == 6u);
        BOOST_TEST(cube.vertices().size() == 11u);
        for (std::size_t i = 0; i < given.size(); ++i) BOOST_TEST((cube.vertices()[i] == given[i]));
        BOOST_TEST(std::abs(cube.mass_properties().volume - 1.0) < 6 * unit + 1e-13);
        const talus::HullOfPoints<3> hull{std::span<const Vector<3>>(given)};
        BOOST_TEST((hull.kept == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    }
}

BOOST_AUTO_TEST_CASE(a_vertex_inside_is_named_with_its_depth) {
    auto v = hull_tester::prism(6, 1.0, 1.0);
    v.emplace_back(0.1, 0.0, 0.4);
    const std::string found = refusal<3>(v);
    BOOST_TEST(found.find("vertex 12 is no corner") != std::string::npos, found);
    BOOST_TEST(found.find("0.1 m inside") != std::string::npos, found);
    BOOST_TEST(refusal<3>(v, {.first_index = 1}).find("vertex 13") == 0u);
    BOOST_TEST(refusal<3>(v, {.rounding = 1.0}).find("rounding") == 0u);
}

BOOST_AUTO_TEST_CASE(extents_whose_squares_are_no_numbers_are_refused) {
    for (const double scale : {1e-120, 1e120, 1e170}) {
        auto v = hull_tester::prism(6, 1.0, 1.0);
        for (auto& x : v) x *= scale;
        BOOST_TEST(refusal<3>(v).find("extent of the vertices [m] is ") == 0u);
    }
    auto v = hull_tester::prism(6, 1e-80, 1e-80);
    BOOST_TEST(refusal<3>(v) == "");
}

BOOST_AUTO_TEST_CASE(the_caller_may_tell_the_rounding) {
    Source random(75);
    // Rounded, then scaled: the digits do not show it.
    auto v =
        rounded(hull_tester::turned(hull_tester::prism(12, 1.0, 1.0), random.rotation()), 1e-5);
    for (auto& x : v) x *= std::numbers::pi;
    BOOST_TEST(talus::ConvexPolytope<3>(v).core().face_count() > 14u);
    BOOST_TEST(talus::ConvexPolytope<3>(v, {.rounding = 2e-5}).core().face_count() == 14u);
}

BOOST_AUTO_TEST_CASE(thin_plates_keep_their_thickness) {
    for (const double thickness : {1e-2, 1e-3, 1e-4, 1e-5}) {
        std::vector<Vector<3>> v;
        for (int i = 0; i < 8; ++i) v.emplace_back(i & 1, i >> 1 & 1, thickness * (i >> 2));
        const talus::ConvexPolytope<3> plate(v);
        BOOST_TEST(plate.core().face_count() == 6u);
        BOOST_TEST(plate.core().slack == 0.0);
        BOOST_TEST(std::abs(plate.mass_properties().volume - thickness) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(polygons_merge_sides_that_were_one) {
    Source random(76);
    for (int trial = 0; trial < 500; ++trial) {
        const int n = random.integer(3, 12);
        const double unit = std::pow(10.0, -random.integer(4, 9)), start = random.uniform(0, 6);
        std::vector<Vector<2>> v;
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int k) {
                const double a = start + 2 * std::numbers::pi * k / n;
                return Vector<2>(std::cos(a), std::sin(a));
            };
            v.push_back(at(i));
            for (const double t : {0.2, 0.5, 0.9}) v.push_back((1 - t) * at(i) + t * at(i + 1));
        }
        v = rounded(v, unit);
        const talus::ConvexPolytope<2> polygon(v);
        BOOST_TEST(polygon.core().face_count() == static_cast<std::size_t>(n));
        BOOST_TEST(polygon.vertices().size() == v.size());
        std::ranges::shuffle(v, std::mt19937(1));
        const talus::HullOfPoints<2> hull{std::span<const Vector<2>>(v)};
        BOOST_TEST(hull.kept.size() == static_cast<std::size_t>(n));
        BOOST_TEST(std::abs(hull.polytope.mass_properties().volume -
                            polygon.mass_properties().volume) < 4 * unit);
    }
    BOOST_TEST(refusal<2>({{0, 0}, {1, 0}, {2, 0}, {0, 1}}) == "");
    BOOST_TEST(refusal<2>({{0, 0}, {1, 0.01}, {2, 0}, {0, 1}}).find("vertex 1 is no convex") == 0u);
}

BOOST_AUTO_TEST_CASE(the_hull_of_a_fine_mesh_is_found) {
    Source random(77);
    std::vector<Vector<3>> v;
    for (int i = 0; i < 5000; ++i) {
        const double z = random.uniform(-1, 1), a = random.uniform(0, 7), r = std::sqrt(1 - z * z);
        v.emplace_back(r * std::cos(a), 2 * r * std::sin(a), z);
        v.push_back(0.5 * v.back());
        if (i % 7 == 0) v.push_back(v.back());
    }
    const talus::HullOfPoints<3> hull{std::span<const Vector<3>>(in_single_precision(v))};
    const auto c = hull.polytope.core();
    BOOST_TEST(hull.kept.size() > 4900u);
    BOOST_TEST(hull.kept.size() <= 5000u);
    BOOST_TEST(hull.kept.size() + c.face_count() == c.edges.size() + 2);
    BOOST_TEST(std::abs(hull.polytope.mass_properties().volume / (8 * std::numbers::pi / 3) - 1) <
               0.005);
    for (const auto& x : {Vector<3>(0.5, 1.0, 0.2), Vector<3>(0, 0, 0)})
        for (std::size_t f = 0; f < c.face_count(); ++f)
            BOOST_TEST_REQUIRE(c.normals[f].dot(x) < c.offsets[f]);
}

BOOST_AUTO_TEST_SUITE_END()
