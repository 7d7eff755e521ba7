// SPDX-License-Identifier: BSL-1.0
// Questions to the narrow phase that other libraries were reported to answer wrongly. Where talus'
// answer is not a closed form it is compared with Minkowski, which tries everything.
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "minkowski.hpp"

BOOST_AUTO_TEST_SUITE(reports_geometry)

using V2 = talus::Vector<2>;
using V3 = talus::Vector<3>;
using Pose2 = talus::Pose<2>;
using Pose3 = talus::Pose<3>;

/// Rounding of coordinates of order 1.
constexpr double rounding = 1e-15;

template <int Dim, class A, class B>
talus::Column<talus::ContactPoint<Dim>> contacts(const A& a, const talus::Pose<Dim>& at_a,
                                                 const B& b, const talus::Pose<Dim>& at_b,
                                                 double margin) {
    talus::Column<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(a, at_a, b, at_b, margin, found);
    for (const auto& c : found) {
        BOOST_CHECK_CLOSE(c.normal.norm(), 1.0, 1e-12);
        BOOST_CHECK(c.point.allFinite());
    }
    return found;
}

/// The least gap, which is the signed distance; NaN if there is no contact.
template <int Dim>
double least_gap(const talus::Column<talus::ContactPoint<Dim>>& found) {
    if (found.empty()) return std::numeric_limits<double>::quiet_NaN();
    return std::ranges::min_element(found, {}, [](const auto& c) { return c.gap; })->gap;
}

talus::Box<3> cube(double side) { return talus::Box<3>(V3::Constant(0.5 * side)); }
talus::Box<3> block(double x, double y, double z) { return talus::Box<3>(0.5 * V3(x, y, z)); }

template <int Dim, class S>
std::vector<talus::Vector<Dim>> corners(const S& shape, const talus::Pose<Dim>& at) {
    std::vector<talus::Vector<Dim>> result;
    for (const auto& v : shape.core().vertices) result.push_back(at.point_world(v));
    return result;
}

/// The talus contacts of two polytopes against all of Minkowski.
template <int Dim, class A, class B>
void check_all(const A& a, const talus::Pose<Dim>& at_a, const B& b, const talus::Pose<Dim>& at_b,
               double margin, double tolerance) {
    const auto found = contacts<Dim>(a, at_a, b, at_b, margin);
    const double exact =
        Minkowski<Dim>(corners<Dim>(a, at_a), corners<Dim>(b, at_b)).signed_distance();
    BOOST_REQUIRE(!found.empty());
    BOOST_CHECK_SMALL(least_gap(found) - exact, tolerance);
}

Pose3 placed(std::initializer_list<double> rows) {
    talus::Matrix<3> r;
    V3 p;
    auto x = rows.begin();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) r(i, j) = *x++;
        p[i] = *x++;
    }
    return {p, talus::Rotation<3>::from_matrix(r)};
}

/// A prism over a regular polygon, which a cylinder of the same radius encloses; its axis is z.
talus::ConvexPolytope<3> prism(int sides, double radius, double height) {
    std::vector<V3> points;
    for (int k = 0; k < sides; ++k)
        for (const double z : {-0.5 * height, 0.5 * height}) {
            const double angle = 2.0 * std::numbers::pi * k / sides;
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    return talus::ConvexPolytope<3>(points);
}

// MattiaMontanari/openGJK#3
BOOST_AUTO_TEST_CASE(a_quadrilateral_and_a_triangle_that_overlap) {
    const talus::ConvexPolytope<2> a({{0.566564, 0.548772},
                                      {-0.412644, -0.770664},
                                      {-0.178424, -0.989183},
                                      {0.795121, -0.727851}});
    const talus::ConvexPolytope<2> b(
        {{0.277308, 0.969689}, {-0.347973, 0.45872}, {-0.211223, -0.511346}});
    const auto found = contacts<2>(a, Pose2{}, b, Pose2{}, 0.0);
    BOOST_TEST(least_gap(found) < 0.0);
    check_all<2>(a, Pose2{}, b, Pose2{}, 0.0, rounding);
}

// MattiaMontanari/openGJK#52
BOOST_AUTO_TEST_CASE(blocks_of_400_that_overlap_at_90000) {
    const auto of = [](std::vector<double> x, std::vector<double> y) {
        std::vector<V3> points;
        for (const double z : {300.0, 0.0})
            for (std::size_t i = 0; i < 4; ++i)
                points.emplace_back(static_cast<float>(x[i]), static_cast<float>(y[i]), z);
        return points;
    };
    const auto a =
        of({90945.08, 91077.46, 91454.92, 91322.54}, {54122.54, 53745.082, 53877.46, 54254.918});
    const auto b =
        of({90919.64, 91162.62, 91480.36, 91237.38}, {54037.383, 53719.637, 53962.617, 54280.363});
    const talus::ConvexPolytope<3> one(a), other(b);
    // The corners are rounded to 1/256, and the faces of one need not be parallel to better.
    check_all<3>(one, Pose3{}, other, Pose3{}, 0.0, 1.0 / 256);
    BOOST_TEST(least_gap(contacts<3>(one, Pose3{}, other, Pose3{}, 0.0)) < -250.0);
}

// FEniCS/dolfinx#3653
BOOST_AUTO_TEST_CASE(a_point_and_the_hull_of_seven_nearly_coplanar_groups) {
    const std::vector<V3> points{{46.0659, 38.6251, 16.3637}, {44.2764, 42.3867, 18.239},
                                 {50.0397, 38.4649, 19.9843}, {47.1963, 40.4563, 19.1057},
                                 {48.0266, 38.5593, 18.2475}, {45.1735, 40.495, 17.3336},
                                 {48.0415, 40.4456, 18.1963}};
    const V3 point(44.2919, 39.7508, 18.8208);
    const double exact = Minkowski<3>({point}, points).signed_distance();
    const talus::HullOfPoints<3> hull(points, {.rounding = 0.0});
    const auto found =
        contacts<3>(talus::Ball<3>(1e-3), Pose3{point, {}}, hull.polytope, Pose3{}, 10.0);
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    BOOST_CHECK_SMALL(found[0].gap + 1e-3 - exact, 50 * rounding);
}

// AlexanderFabisch/distance3d#72
BOOST_AUTO_TEST_CASE(a_long_bar_with_its_end_in_a_turned_cube) {
    const talus::ConvexPolytope<3> bar({{-119.5, -120.5, -119.5},
                                        {-119.5, -119.5, -119.5},
                                        {-119.5, -120.5, -120.5},
                                        {-119.5, -119.5, -120.5},
                                        {-89.5, -120.5, -119.5},
                                        {-89.5, -119.5, -119.5},
                                        {-89.5, -120.5, -120.5},
                                        {-89.5, -119.5, -120.5}});
    const talus::ConvexPolytope<3> turned({{-90.0, -120.14644661, -120.85355335},
                                           {-90.0, -120.85355339, -120.14644656},
                                           {-90.70710679, -119.64644658, -120.35355338},
                                           {-90.70710679, -120.35355336, -119.64644659},
                                           {-89.29289321, -119.64644664, -120.35355341},
                                           {-89.29289321, -120.35355342, -119.64644662},
                                           {-90.0, -119.14644661, -119.85355344},
                                           {-90.0, -119.85355339, -119.14644665}});
    check_all<3>(bar, Pose3{}, turned, Pose3{}, 0.0, 2e-7);  // corners have 8 decimals
}

// flexible-collision-library/fcl#493, flexible-collision-library/fcl#495
BOOST_AUTO_TEST_CASE(turned_cubes_that_kiss_touch_over_the_whole_face) {
    const auto half =
        placed({0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556,
                2.0770063995786869349, -0.19134171618254486313, 0.96936494951283913579,
                0.15401279915737359216, 0.48468247475641951239, -0.19509032201612822033,
                -0.19134171618254486313, 0.96193976625564348026, 1.1543291419087275962});
    Pose3 other = half;
    other.position = {2.0, 0.0, 1.25};
    const auto quarter =
        placed({0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667,
                0.073242100093223821977, -0.23569836841299879326, 0.92661523595848427348,
                -0.29296840037289506586, 0.2316538089896212349, -0.2429801799032638987,
                0.23569836841299884878, 0.94096063217417758029, 1.3089245921032497399});
    Pose3 below = quarter;
    below.position = {0.0, 0.0, 1.25};
    const auto check = [](double side, const Pose3& at_a, const Pose3& at_b) {
        const auto found = contacts<3>(cube(side), at_a, cube(side), at_b, 1e-12);
        BOOST_TEST(found.size() == 4u);
        const V3 up = at_a.rotation * V3::Unit(1);
        for (const auto& c : found) {
            BOOST_CHECK_SMALL(c.gap, rounding);
            BOOST_CHECK_SMALL((c.normal - up).norm(), rounding);
            BOOST_CHECK_SMALL(std::abs(at_b.point_body(c.point)[0]) - 0.5 * side, rounding);
        }
    };
    check(0.5, half, other);
    check(0.25, quarter, below);
}

// flexible-collision-library/fcl#399
BOOST_AUTO_TEST_CASE(a_board_beside_a_box_with_flush_ends) {
    const auto at_box = placed({-0.099432387353076273628, 0.99504432079443971837, 0,
                                0.29526406526565551758, -0.99504432079443971837,
                                -0.099432387353076273628, 0, -0.013230856508016586304, 0, 0, 1, 0});
    const auto at_board = placed({0.99506598442099225554, 0.099215354901756730444, 0,
                                  0.22759586545694214629, -0.099215354901756730444,
                                  0.99506598442099225554, 0, 0.14974093549228112421, 0, 0, 1, 0});
    // The faces are parallel to 2e-4: the gap along the normal of one exceeds the shortest way by
    // the square of half of that.
    check_all<3>(block(0.23768037557601928711, 0.15702305734157562256, 0.25), at_box,
                 block(0.01, 0.78165709972381591797, 0.25), at_board, 0.0, 3.4e-5 * 3e-8);
}

// flexible-collision-library/fcl#508
BOOST_AUTO_TEST_CASE(unit_cubes_four_apart_along_any_axis_are_three_apart) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto found =
            contacts<3>(cube(1.0), Pose3{4.0 * V3::Unit(axis), {}}, cube(1.0), Pose3{}, 5.0);
        BOOST_TEST(found.size() == 4u);
        for (const auto& c : found) BOOST_TEST(c.gap == 3.0);
    }
}

// flexible-collision-library/fcl#127, flexible-collision-library/fcl#275
BOOST_AUTO_TEST_CASE(nearest_points_of_a_ball_with_a_box_and_with_a_ball) {
    const auto box =
        contacts<3>(talus::Ball<3>(1.0), Pose3{}, block(10, 2, 10), Pose3{V3(0, 5, 3), {}}, 5.0);
    BOOST_REQUIRE_EQUAL(box.size(), 1u);
    BOOST_TEST(box[0].gap == 3.0);
    BOOST_TEST((box[0].point - V3(0, 2.5, 0)).norm() == 0.0);
    BOOST_TEST((box[0].normal - V3(0, -1, 0)).norm() == 0.0);
    const auto ball = contacts<3>(talus::Ball<3>(20.0), Pose3{}, talus::Ball<3>(10.0),
                                  Pose3{V3(0, 40, 0), {}}, 20.0);
    BOOST_REQUIRE_EQUAL(ball.size(), 1u);
    BOOST_TEST(ball[0].gap == 10.0);
    BOOST_TEST((ball[0].point - V3(0, 25, 0)).norm() == 0.0);
}

// flexible-collision-library/fcl#408
BOOST_AUTO_TEST_CASE(a_ball_that_kisses_a_cube_over_its_edge_line) {
    const auto found =
        contacts<3>(talus::Ball<3>(0.06),
                    Pose3{V3(1.7855056639081962376e-10, 0.04, 0.33000000000000012657), {}},
                    cube(0.1), Pose3{V3(0.05, 0.15, 0.35), {}}, 1e-12);
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    BOOST_CHECK_SMALL(found[0].gap, rounding);
    BOOST_CHECK_SMALL((found[0].normal + V3::Unit(1)).norm(), 1e-8);
}

// flexible-collision-library/fcl#545
BOOST_AUTO_TEST_CASE(a_small_cube_in_the_corner_of_a_big_one_leaves_through_a_face) {
    const auto small = cube(0.2), big = cube(1.0);
    const talus::ConvexPolytope<3> hull(corners<3>(big, Pose3{}));
    const Pose3 at{V3::Constant(0.4), {}};
    for (const double gap : {least_gap(contacts<3>(small, at, big, Pose3{}, 0.0)),
                             least_gap(contacts<3>(small, at, hull, Pose3{}, 0.0))})
        BOOST_CHECK_SMALL(gap + 0.2, rounding);
}

// danfis/libccd#25
BOOST_AUTO_TEST_CASE(two_cubes_one_on_the_other) {
    const auto found = contacts<3>(cube(2), Pose3{}, cube(2), Pose3{V3(0, 0, 1.9), {}}, 0.0);
    BOOST_TEST(found.size() == 4u);
    for (const auto& c : found) {
        BOOST_CHECK_SMALL(c.gap + 0.1, rounding);
        BOOST_CHECK_SMALL(c.point[2] - 0.95, rounding);
        BOOST_TEST((c.normal + V3::Unit(2)).norm() == 0.0);
    }
}

// danfis/libccd#17, google-deepmind/mujoco_warp#1430, google-deepmind/mujoco_warp#1526
BOOST_AUTO_TEST_CASE(a_small_box_on_a_big_one_touches_below_its_own_corners) {
    const double depth = 1.078e-4, half = 0.1;
    for (const double big : {0.1, 1.0, 2.5, 10.0, 25.0, 50.0, 100.0, 1000.0}) {
        const double x = big - half;  // in a corner of the big box
        const auto found = contacts<3>(cube(2 * half), Pose3{V3(x, x, big + half - depth), {}},
                                       cube(2 * big), Pose3{}, 0.0);
        BOOST_TEST(found.size() == 4u);
        for (const auto& c : found) {
            BOOST_CHECK_SMALL(c.gap + depth, big * rounding);
            BOOST_CHECK_SMALL(std::abs(c.point[0] - x) - half, big * rounding);
            BOOST_CHECK_SMALL(std::abs(c.point[1] - x) - half, big * rounding);
            BOOST_TEST((c.normal - V3::Unit(2)).norm() == 0.0);
        }
    }
}

// coal-library/coal#144
BOOST_AUTO_TEST_CASE(two_boxes_face_to_face_touch_at_four_corners) {
    const auto found = contacts<3>(cube(2), Pose3{}, cube(2), Pose3{V3(1.9999, 0, 0), {}}, 0.0);
    BOOST_TEST(found.size() == 4u);
    V3 sum = V3::Zero();
    for (const auto& c : found) {
        BOOST_CHECK_SMALL(c.gap + 1e-4, rounding);
        BOOST_CHECK_SMALL((c.point.cwiseAbs() - V3(0.99995, 1, 1)).norm(), rounding);
        sum += c.point;
    }
    BOOST_CHECK_SMALL((0.25 * sum - V3(0.99995, 0, 0)).norm(), rounding);
}

// bulletphysics/bullet3#2579
BOOST_AUTO_TEST_CASE(a_ball_of_a_centimetre_in_boxes_of_five_millimetres) {
    for (const double scale : {1.0, 10.0, 1e-6})
        for (const double z : {0.3925, 0.3975, 0.4025}) {
            const V3 ball = scale * V3(0.019576, -1.03115, 0.398155);
            const V3 box = scale * V3(0.0275, -1.0275, z);
            const auto found = contacts<3>(talus::Ball<3>(scale * 0.01), Pose3{ball, {}},
                                           cube(scale * 0.005), Pose3{box, {}}, 0.0);
            BOOST_REQUIRE_EQUAL(found.size(), 1u);
            const V3 outside =
                ((ball - box).cwiseAbs() - V3::Constant(scale * 0.0025)).cwiseMax(0.0);
            BOOST_CHECK_SMALL(found[0].gap - (outside.norm() - scale * 0.01), scale * rounding);
        }
}

// dimforge/parry#315
BOOST_AUTO_TEST_CASE(two_cubes_that_touch_over_a_plane) {
    const auto found = contacts<3>(cube(1), Pose3{V3(0.5, 0.5, 0.5), {}}, cube(1),
                                   Pose3{V3(1.5, 0.5, 0.5), {}}, 0.0);
    BOOST_TEST(found.size() == 4u);
    for (const auto& c : found) {
        BOOST_TEST(c.gap == 0.0);
        BOOST_TEST(c.point[0] == 1.0);
        BOOST_TEST((c.normal + V3::Unit(0)).norm() == 0.0);
    }
}

// dimforge/parry#34, dimforge/parry#148
BOOST_AUTO_TEST_CASE(a_ball_whose_centre_is_a_corner_or_on_a_face) {
    const talus::Box<2> square(V2(1, 1));
    const talus::Ball<2> disc(1.0);
    for (const V2& at : {V2(1, 1), V2(1, 0.3), V2(-1, 0)}) {
        const auto found = contacts<2>(disc, Pose2{at, {}}, square, Pose2{}, 1.0);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        BOOST_CHECK_SMALL(found[0].gap + 1.0, rounding);
        BOOST_TEST(found[0].normal.dot(at) > 0.0);
    }
    const auto face =
        contacts<3>(talus::Ball<3>(0.5), Pose3{V3(0.2, 0.1, 1), {}}, cube(2), Pose3{}, 0.0);
    BOOST_REQUIRE_EQUAL(face.size(), 1u);
    BOOST_CHECK_SMALL(face[0].gap + 0.5, rounding);
    BOOST_CHECK_SMALL((face[0].normal - V3::Unit(2)).norm(), rounding);
}

// google-deepmind/mujoco#2206
BOOST_AUTO_TEST_CASE(a_ball_that_sinks_into_a_box_is_as_deep_as_it_sank) {
    for (int k = 0; k < 200; ++k) {
        const double z = -0.01 + k * (0.01 / 199);
        const auto found = contacts<3>(talus::Ball<3>(0.005), Pose3{V3(0, 0, z), {}},
                                       block(1, 1, 0.5), Pose3{V3(0, 0, -0.255), {}}, 1e-12);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        BOOST_CHECK_SMALL(found[0].gap - z, rounding);
        BOOST_CHECK_SMALL(found[0].point[2] - (0.5 * z - 0.005), rounding);
    }
}

// google-deepmind/mujoco#3476
BOOST_AUTO_TEST_CASE(boxes_that_kiss_have_no_deep_contact) {
    // Boxes 71 mm wide, in mm as there, at tilts of which one corner enters by 0.06 at most.
    const auto box = block(112, 71, 50);
    for (int k = 0; k < 60; ++k) {
        const double tilt = 1e-5 * std::pow(1.2, k % 20);
        const V3 about = V3(std::sin(1.0 + k), 0.3 * std::cos(2.0 * k), std::cos(1.0 + k));
        const Pose3 at{V3(0.7 * std::sin(k), 71.0 + 0.01 * std::sin(3.0 * k), 0.4),
                       talus::Rotation<3>::exp(tilt * about)};
        const auto found = contacts<3>(box, at, box, Pose3{}, 0.1);
        BOOST_REQUIRE(!found.empty());
        const double exact =
            Minkowski<3>(corners<3>(box, at), corners<3>(box, Pose3{})).signed_distance();
        BOOST_CHECK_SMALL(least_gap(found) - exact, 1e-4 * std::abs(exact) + 71 * 1e-10);
    }
}

// RobotLocomotion/drake#8049
BOOST_AUTO_TEST_CASE(an_upright_cylinder_is_as_deep_upside_down) {
    const auto cylinder = prism(24, 0.5, 1.0);
    const talus::HalfSpace<3> floor{V3::Unit(2), 0.0};
    for (const double angle : {0.0, std::numbers::pi}) {
        const Pose3 at{V3(0, 0, 0.449), talus::Rotation<3>::exp(angle * V3::Unit(0))};
        const auto found = contacts<3>(cylinder, at, floor, Pose3{}, 0.0);
        BOOST_TEST(found.size() == 24u);
        for (const auto& c : found) BOOST_CHECK_SMALL(c.gap + 0.051, rounding);
    }
}

// flexible-collision-library/fcl#375, RobotLocomotion/drake#10578
BOOST_AUTO_TEST_CASE(a_coin_on_a_board_has_the_normal_of_the_board) {
    const auto coin = prism(32, 0.08, 0.002);
    const Pose3 at_board{V3(-0.25, 0, 0),
                         talus::Rotation<3>::exp(0.5 * std::numbers::pi * V3::Unit(2))};
    const Pose3 at{V3(-0.2, 0.1, 0.0085), {}};
    const auto found = contacts<3>(coin, at, block(0.49, 0.63, 0.015), at_board, 1e-12);
    BOOST_TEST(found.size() == 32u);
    for (const auto& c : found) {
        BOOST_CHECK_SMALL(c.gap, rounding);
        BOOST_CHECK_SMALL((c.normal - V3::Unit(2)).norm(), rounding);
    }
}

// flexible-collision-library/fcl#128
BOOST_AUTO_TEST_CASE(a_box_and_a_skewed_box_that_leans_over_it) {
    const auto leaning = [](double shift) {
        std::vector<V3> points;
        for (const double x : {2.0, 3.0})
            for (const double y : {0.0, 1.0}) {
                points.emplace_back(x, y, 0.0);
                points.emplace_back(x - shift, y, 1.0);
            }
        return talus::ConvexPolytope<3>(points);
    };
    const Pose3 middle{V3::Constant(0.5), {}};
    // The side that leans over the box has the normal (1, 0, s) / sqrt(1 + s^2).
    for (const double s : {1.0, 1.1, 1.5, 2.0}) {
        const auto found = contacts<3>(cube(1), middle, leaning(s), Pose3{}, 1e-12);
        BOOST_CHECK_SMALL(least_gap(found) + (s - 1.0) / std::sqrt(1 + s * s), rounding);
        for (const auto& c : found)  // within both bodies
            BOOST_TEST((c.point.minCoeff() > -1e-12 && c.point.maxCoeff() < 1 + 1e-12));
    }
}

// jrouwe/JoltPhysics#419, jrouwe/JoltPhysics#671
BOOST_AUTO_TEST_CASE(a_capsule_beside_a_box_wherever_it_stands) {
    const talus::Box<3> wall(V3(0.078, 2.5, 1.5));
    const talus::Capsule<3> capsule(0.6, 0.3);
    const auto upright = talus::Rotation<3>::exp(V3(0, -0.5 * std::numbers::pi, 0));
    const Pose3 at_wall{V3(6.92188, 0, 6.5), {}};
    for (const double gap : {1e-2, 1e-5, 0.0, -1e-5, -1e-2})
        for (int k = 0; k < 50; ++k) {
            const double y = -2.4 + 0.0973 * k;
            const Pose3 at{V3(6.92188 - 0.078 - 0.3 - gap, y, 6.5 + 0.01 * k), upright};
            const auto found = contacts<3>(capsule, at, wall, at_wall, 0.02);
            BOOST_REQUIRE_EQUAL(found.size(), 2u);
            for (const auto& c : found) {
                BOOST_CHECK_SMALL(c.gap - gap, 10 * rounding);
                BOOST_CHECK_SMALL((c.normal + V3::Unit(0)).norm(), 10 * rounding);
            }
        }
}

// bepu/bepuphysics2#101
BOOST_AUTO_TEST_CASE(an_upright_capsule_on_a_nearly_level_face) {
    const talus::Capsule<3> capsule(0.5, 0.5);
    const Pose3 at{V3(1, 0.9, 1), talus::Rotation<3>::exp(V3(0, 0, 0.5 * std::numbers::pi))};
    for (const double lift : {0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, -1e-6, -1e-3}) {
        const V3 a(10, 0, -5), b(10, 0, 5), c(-10, lift, 5), down(0, -1, 0);
        const talus::ConvexPolytope<3> slab({a, b, c, a + down, b + down, c + down});
        V3 normal = (b - a).cross(c - a).normalized();
        if (normal[1] < 0.0) normal = -normal;
        const auto found = contacts<3>(capsule, at, slab, Pose3{}, 0.1);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        BOOST_CHECK_SMALL(found[0].gap - (normal.dot(V3(1, 0.4, 1) - a) - 0.5), 10 * rounding);
        BOOST_CHECK_SMALL((found[0].normal - normal).norm(), 10 * rounding);
    }
}

// google-deepmind/mujoco#1325, cyberbotics/webots#6688
BOOST_AUTO_TEST_CASE(a_box_on_the_floor_touches_with_its_lower_corners) {
    const talus::HalfSpace<3> floor{V3::Unit(2), 0.0};
    const auto found = contacts<3>(cube(0.2), Pose3{V3(0, 0, 0.1), {}}, floor, Pose3{}, 0.0);
    BOOST_TEST(found.size() == 4u);
    for (const auto& c : found)
        BOOST_CHECK_SMALL((c.point.cwiseAbs() - V3(0.1, 0.1, 0)).norm(), rounding);
    // A thin plate all below: every corner as deep as it is, whatever its place in the order.
    const Pose3 buried{V3(0, 0, -0.01), talus::Rotation<3>::exp(V3(0.001, 0.002, 0.3))};
    const auto plate = block(0.3, 0.2, 0.002);
    const auto deep = contacts<3>(plate, buried, floor, Pose3{}, 0.0);
    BOOST_TEST(deep.size() == 8u);
    double least = 0.0;
    for (const V3& v : corners<3>(plate, buried)) least = std::min(least, v[2]);
    BOOST_CHECK_SMALL(least_gap(deep) - least, rounding);
}

// erincatto/box2d#672
BOOST_AUTO_TEST_CASE(overlapping_discs_touch_in_the_middle_of_the_overlap) {
    for (const double x : {3.5, 3.999999, 4.0}) {
        const auto found = contacts<2>(talus::Ball<2>(1.0), Pose2{}, talus::Ball<2>(3.0),
                                       Pose2{V2(x, 0), {}}, 0.0);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        BOOST_CHECK_SMALL(found[0].gap - (x - 4.0), rounding);
        BOOST_CHECK_SMALL((found[0].point - V2(0.5 * (x - 2.0), 0)).norm(), rounding);
    }
}

BOOST_AUTO_TEST_SUITE_END()
