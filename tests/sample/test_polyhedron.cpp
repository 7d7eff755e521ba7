// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/polygon.hpp>
#include <talus/sample/polyhedron.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

using talus::Vector;

BOOST_AUTO_TEST_SUITE(sample_polyhedron)

constexpr double rounding = 1e-14;  // lengths are of order one

std::vector<Vector<3>> cube() {
    std::vector<Vector<3>> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    return points;
}

std::vector<talus::VertexLoop> faces_of(const std::vector<Vector<3>>& points) {
    return talus::convex_hull_of_cloud<3>(points).faces;
}

BOOST_AUTO_TEST_CASE(a_cube_has_six_faces_of_four_corners) {
    const auto points = cube();
    const auto faces = faces_of(points);
    BOOST_TEST(faces.size() == 6u);
    for (const auto& face : faces) BOOST_TEST(face.size() == 4u);
    const auto centre = talus::solid_centre(points, faces);
    BOOST_TEST(std::abs(centre.volume - 1.0) < rounding);
    BOOST_TEST((centre.centroid - Vector<3>::Constant(0.5)).norm() < rounding);
}

BOOST_AUTO_TEST_CASE(faces_turn_left_seen_from_outside) {
    const auto points = cube();
    for (const auto& f : faces_of(points))
        for (std::size_t i = 0; i < f.size(); ++i) {
            const Vector<3> a = points[f[i]], b = points[f[(i + 1) % 4]],
                            c = points[f[(i + 2) % 4]];
            BOOST_TEST((b - a).cross(c - b).dot(a - Vector<3>::Constant(0.5)) > 0.4);
        }
}

BOOST_AUTO_TEST_CASE(a_point_inside_belongs_to_no_face) {
    auto points = cube();
    points.emplace_back(0.3, 0.4, 0.5);
    const auto faces = faces_of(points);
    BOOST_TEST(faces.size() == 6u);
    for (const auto& face : faces)
        for (const auto corner : face) BOOST_TEST(corner < 8u);
}

BOOST_AUTO_TEST_CASE(points_of_a_plane_have_no_hull_in_space) {
    BOOST_CHECK_THROW(faces_of({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}), talus::input_error);
}

BOOST_AUTO_TEST_CASE(a_tetrahedron_has_its_centroid_at_the_mean_of_its_corners) {
    const std::vector<Vector<3>> points{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    const auto faces = faces_of(points);
    BOOST_TEST(faces.size() == 4u);
    const auto centre = talus::solid_centre(points, faces);
    BOOST_TEST(std::abs(centre.volume - 4.0) < rounding * 10);
    BOOST_TEST((centre.centroid - Vector<3>(0.5, 0.75, 1.0)).norm() < rounding);
}

BOOST_AUTO_TEST_CASE(the_centroid_of_a_polygon_does_not_depend_on_where_it_starts) {
    // An L-free convex case with a closed form: a trapezoid of parallel sides 3 and 1, height 2.
    std::vector<Vector<2>> corners{{0, 0}, {3, 0}, {2, 2}, {1, 2}};
    for (int start = 0; start < 4; ++start) {
        const Vector<2> c = talus::centroid(corners);
        BOOST_TEST((c - Vector<2>(1.5, 2.0 / 3.0 * 5.0 / 4.0)).norm() < rounding);
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
}

BOOST_AUTO_TEST_SUITE_END()
