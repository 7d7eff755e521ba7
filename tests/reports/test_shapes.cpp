// SPDX-License-Identifier: BSL-1.0
// Shapes that other libraries were reported to refuse, to weigh wrongly or to crash on.
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/stepping/system.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

BOOST_AUTO_TEST_SUITE(reports_shapes)

using V2 = talus::Vector<2>;
using V3 = talus::Vector<3>;
using talus::ConvexPolytope;
using talus::HullOfPoints;
using talus::input_error;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double from_bits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// Area, centroid and moment about it of a polygon, from its first corner on in long double.
struct Polygon {
    long double area = 0.0L, moment = 0.0L;
    V2 centroid;

    explicit Polygon(const std::vector<V2>& p) {
        long double x = 0.0L, y = 0.0L, about_first = 0.0L;
        const long double first[] = {p[0][0], p[0][1]};
        for (std::size_t i = 1; i + 1 < p.size(); ++i) {
            const long double ax = p[i][0] - first[0], ay = p[i][1] - first[1];
            const long double bx = p[i + 1][0] - first[0], by = p[i + 1][1] - first[1];
            const long double twice = ax * by - ay * bx;
            area += twice / 2;
            x += twice * (ax + bx) / 6;
            y += twice * (ay + by) / 6;
            about_first += twice * (ax * ax + ay * ay + bx * bx + by * by + ax * bx + ay * by) / 12;
        }
        x /= area;
        y /= area;
        moment = about_first - area * (x * x + y * y);
        centroid = {static_cast<double>(p[0][0] + x), static_cast<double>(p[0][1] + y)};
    }
};

/// `tolerance` is relative, `off` how far corners may be from where they were meant [m].
void check_polygon(const std::vector<V2>& points, double tolerance, double off = 0.0,
                   const talus::HullOptions& options = {}) {
    const Polygon exact(points);
    const auto mass = ConvexPolytope<2>(points, options).mass_properties();
    BOOST_CHECK_CLOSE(mass.volume, static_cast<double>(exact.area), 100 * tolerance);
    BOOST_CHECK_CLOSE(mass.inertia[0], static_cast<double>(exact.moment), 100 * tolerance);
    BOOST_CHECK_SMALL((mass.centroid - exact.centroid).norm(),
                      off + 1e-15 * (1.0 + exact.centroid.norm()));
}

/// Every vertex below every face, and V - E + F = 2.
void check_convex(const ConvexPolytope<3>& polytope, double tolerance) {
    const auto core = polytope.core();
    double worst = 0.0;
    std::size_t corners_of_faces = 0;
    std::set<std::uint32_t> used;
    for (std::size_t f = 0; f < core.face_count(); ++f) {
        const auto loop = core.face(f);
        corners_of_faces += loop.size();
        used.insert(loop.begin(), loop.end());
        for (const V3& v : core.vertices)
            worst = std::max(worst, core.normals[f].dot(v - core.vertices[loop[0]]));
    }
    BOOST_CHECK_SMALL(worst, tolerance);
    BOOST_TEST(used.size() + core.face_count() == corners_of_faces / 2 + 2);
}

/// Corners of a unit cube at `corner`, with more points on its faces.
std::vector<V3> unit_cube(const V3& corner, int more_on_one_face = 0) {
    std::vector<V3> points;
    for (int i = 0; i < 8; ++i) points.push_back(corner + V3(i & 1, i >> 1 & 1, i >> 2));
    for (int k = 1; k <= more_on_one_face; ++k)
        points.push_back(corner + V3(0.25, 1.0, k / (more_on_one_face + 1.0)));
    return points;
}

// erincatto/box2d#296
BOOST_AUTO_TEST_CASE(a_pentagon_with_a_corner_nearly_on_a_side) {
    const std::vector<V2> points{{-1.70082211, -1.43221712},
                                 {0.5, -0.5},
                                 {0.104992867, 0.97400856},
                                 {-0.658002853, 0.926608086},
                                 {-0.994554818, 0.165337861}};
    const double off = 5e-9;  // of eight decimals
    check_polygon(points, off, off);
    check_polygon(points, 1e-14, 0.0, {.rounding = 0.0});
}

// erincatto/box2d#728
BOOST_AUTO_TEST_CASE(hexagons_of_single_precision_with_corners_nearly_on_a_side) {
    const auto of = [](std::vector<std::uint32_t> bits) {
        std::vector<V2> points;
        for (std::size_t i = 0; i < bits.size(); i += 2)
            points.emplace_back(from_bits(bits[i]), from_bits(bits[i + 1]));
        return points;
    };
    // Corner 0 is an inner one by 4e-9, less than its coordinates are rounded.
    check_polygon(of({0xC1078533, 0x3F0BAB5E, 0xC0F5B2E8, 0x3F28AF8C, 0xC0E2B14A, 0x3F3E72AE,
                      0xC0EBC298, 0x402E521E, 0xC1158EA9, 0x401C2F82, 0xC1110602, 0x3EEBD078}),
                  1e-13, 16.0 * std::numeric_limits<float>::epsilon() / 4);
    check_polygon(of({0x3F800000, 0xBF800000, 0x3F800000, 0x3F800000, 0xBF800000, 0x3F800000,
                      0xBF800000, 0xBF800000, 0xBF09F775, 0xBF876E83, 0x3F3787C5, 0xBF81F4D7}),
                  1e-13);
}

// erincatto/box2d#756
BOOST_AUTO_TEST_CASE(a_triangle_of_centimetres_at_eighty_metres_has_a_moment) {
    check_polygon({{from_bits(0xc28e8d90), from_bits(0x42100000)},
                   {from_bits(0xc28eb4be), from_bits(0x42104e5f)},
                   {from_bits(0xc28ebf3e), from_bits(0x42100000)}},
                  1e-13);
}

// erincatto/box2d#422
BOOST_AUTO_TEST_CASE(a_square_of_0_72_at_15000_has_its_area) {
    const double s = 0.72;
    std::vector<V2> points{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    for (V2& p : points) p = V2(-15000, -15000) + s * p;
    check_polygon(points, 1e-13);
    const auto mass = ConvexPolytope<2>(points).mass_properties();
    BOOST_CHECK_CLOSE(mass.volume, s * s, 1e-9);
    BOOST_CHECK_CLOSE(mass.inertia[0], s * s * s * s / 6.0, 1e-9);
}

// erincatto/box2d#192
BOOST_AUTO_TEST_CASE(the_moment_of_a_pentagon_is_about_its_centroid) {
    check_polygon({{-2.625452, 4.425248},
                   {-3.101252, 8.107347},
                   {-4.639852, 5.767548},
                   {-4.937052, 4.040548},
                   {-3.365452, 3.517048}},
                  1e-14);
}

// erincatto/box2d#326, dimforge/parry#76
BOOST_AUTO_TEST_CASE(points_on_a_line_are_refused) {
    BOOST_CHECK_THROW(ConvexPolytope<2>({{0, 0}, {10, 10}, {5, 5}, {3, 3}}), input_error);
    const std::vector<V2> line{{0, 0}, {10, 10}, {5, 5}, {3, 3}};
    BOOST_CHECK_THROW(HullOfPoints<2>{line}, input_error);
    BOOST_CHECK_THROW(
        ConvexPolytope<3>({{2.277, -7.9, 16.318}, {-0.57, -8.1, 16.607}, {-0.57, -8.1, 16.607}}),
        input_error);
}

// bepu/bepuphysics2#316, mrdoob/three.js#13014
BOOST_AUTO_TEST_CASE(points_in_a_plane_are_refused_in_space) {
    std::vector<V3> flat;
    for (int i = 0; i < 40; ++i) flat.emplace_back(std::sin(i * i), std::cos(3.0 * i), 0.0);
    BOOST_CHECK_THROW(HullOfPoints<3>{flat}, input_error);
    flat.resize(4);
    BOOST_CHECK_THROW(ConvexPolytope<3>{flat}, input_error);
    BOOST_CHECK_THROW(talus::Box<3>(V3(1, 1, 0)), input_error);
}

// dimforge/ncollide#372
BOOST_AUTO_TEST_CASE(the_hull_of_a_hull_is_the_same_hull) {
    const std::vector<V3> points{{1, 0, 0},  {-2, 1, 1}, {2, 1, 1}, {2, 0, 2},
                                 {-2, 0, 2}, {1, 1, 0},  {2, 0, 1}, {-2, 0, 1},
                                 {-1, 0, 0}, {-2, 1, 2}, {2, 1, 2}, {-1, 1, 0}};
    const HullOfPoints<3> first(points);
    BOOST_TEST(first.kept.size() == 12u);
    check_convex(first.polytope, 1e-15);
    const auto vertices = first.polytope.vertices();
    const HullOfPoints<3> second(vertices);
    BOOST_TEST(second.kept.size() == 12u);
    // A slab 4 x 1 x 1 with half of a slab below, its section a trapezium of 4 and 2.
    for (const auto& hull : {first.polytope, second.polytope})
        BOOST_CHECK_CLOSE(hull.mass_properties().volume, 4.0 + 3.0, 1e-12);
}

// elalish/manifold#1785, tomilov/quickhull#14
BOOST_AUTO_TEST_CASE(the_sum_of_a_cylinder_and_a_sphere_is_convex) {
    const int segments = 12;
    std::vector<V3> points;
    const double pi = std::numbers::pi;
    for (int i = 0; i < segments; ++i)
        for (const double z : {-5.0, 5.0})
            for (int k = 0; k < segments; ++k)
                for (int l = 0; l <= segments / 2; ++l) {
                    const double a = 2 * pi * i / segments, b = 2 * pi * k / segments,
                                 c = pi * l / (segments / 2);
                    points.push_back(V3(3.5 * std::cos(a), 3.5 * std::sin(a), z) +
                                     2.0 * V3(std::cos(b) * std::sin(c), std::sin(b) * std::sin(c),
                                              std::cos(c)));
                }
    const HullOfPoints<3> hull(points);
    check_convex(hull.polytope, 1e-13);
    for (const V3& p : points)
        for (const auto& n : hull.polytope.core().normals)
            if (n.dot(p) > n.dot(hull.polytope.support(n)) + 1e-13) BOOST_ERROR("a point outside");
}

// NVIDIA/warp#251
BOOST_AUTO_TEST_CASE(the_mass_centre_of_a_cube_is_not_the_mean_of_its_corners) {
    for (const int more : {0, 1, 5}) {
        const auto mass = ConvexPolytope<3>(unit_cube(V3::Zero(), more)).mass_properties();
        BOOST_CHECK_SMALL((mass.centroid - V3::Constant(0.5)).norm(), 1e-15);
        BOOST_CHECK_CLOSE(mass.volume, 1.0, 1e-12);
    }
}

// JulioJerez/newton-dynamics#22, dfki-ric/phobos#233
BOOST_AUTO_TEST_CASE(the_inertia_of_a_cube_is_a_sixth_wherever_it_is) {
    for (const double far : {0.0, 3.0, 1000.0, 1e6}) {
        const auto mass = ConvexPolytope<3>(unit_cube(far * V3(1, -2, 3))).mass_properties();
        BOOST_CHECK_SMALL((mass.inertia - talus::Matrix<3>::Identity() / 6.0).norm(), 1e-14);
    }
    // A wedge, whose products of inertia differ: half of a 2 x 3 x 5 box cut along z, by integrals
    // over x/2 + y/3 <= 1.
    const ConvexPolytope<3> wedge(
        {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {0, 3, 5}});
    const auto mass = wedge.mass_properties();
    const double v = 15.0, xx = v * 4.0 / 18, yy = v * 9.0 / 18, zz = v * 25.0 / 12,
                 xy = -v * 6.0 / 36;  // second moments about the centroid
    talus::Matrix<3> exact;
    exact << yy + zz, -xy, 0, -xy, xx + zz, 0, 0, 0, xx + yy;
    BOOST_CHECK_SMALL((mass.inertia - exact).norm(), 1e-13 * exact.norm());
    BOOST_CHECK_SMALL((mass.centroid - V3(2.0 / 3, 1.0, 2.5)).norm(), 1e-15);
}

// notgiven688/jitterphysics2#55, gazebosim/gazebo-classic#307, RobotLocomotion/drake#17557,
// o3de/o3de#2767, dimforge/nphysics#125
BOOST_AUTO_TEST_CASE(no_mass_no_inertia_and_what_is_no_number_are_refused) {
    using Law = talus::DefaultLaw<3>;
    talus::System<3, Law> system(Law{{0.3}});
    const talus::Ball<3> ball(1.0);
    for (const double bad : {0.0, -1.0, nan, infinity}) {
        BOOST_CHECK_THROW(system.add(ball, bad, {}), input_error);
        BOOST_CHECK_THROW(system.add(ball, talus::Inertia<3>{bad, V3::Ones()}, {}), input_error);
        BOOST_CHECK_THROW(talus::Ball<3>{bad}, input_error);
        BOOST_CHECK_THROW(talus::Capsule<3>(1.0, bad), input_error);
        BOOST_CHECK_THROW(talus::Box<3>(V3(1, bad, 1)), input_error);
    }
    for (const double bad : {0.0, -1.0, nan})
        BOOST_CHECK_THROW(system.add(ball, talus::Inertia<3>{1.0, V3(1, bad, 1)}, {}), input_error);
    for (const double bad : {nan, infinity}) {
        BOOST_CHECK_THROW(system.add(ball, 1.0, {V3(0, bad, 0), {}}), input_error);
        BOOST_CHECK_THROW(system.add(ball, 1.0, {}, {V3(0, 0, bad), {}}), input_error);
        BOOST_CHECK_THROW(system.add(ball, 1.0, {}, {V3::Zero(), V3(bad, 0, 0)}), input_error);
        BOOST_CHECK_THROW(ConvexPolytope<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, bad}}),
                          input_error);
    }
    BOOST_TEST(system.bodies.count() == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
