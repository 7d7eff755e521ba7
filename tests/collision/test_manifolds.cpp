// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <cstdint>
#include <set>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(collision_manifolds)

const double rounding = 1e-13;  // a few dozen operations on numbers of order one
const double lateral = 1e-6;    // over NarrowPhaseTolerance::lateral, of bodies of size one

template <int Dim>
using Contacts = talus::Column<talus::ContactPoint<Dim>>;

template <int Dim>
Contacts<Dim> contacts(const talus::AnyShape<Dim>& a, const talus::Pose<Dim>& at_a,
                       const talus::AnyShape<Dim>& b, const talus::Pose<Dim>& at_b = {},
                       double margin = 0.0) {
    Contacts<Dim> out;
    talus::contact_points<Dim>(a, at_a, b, at_b, margin, out);
    return out;
}

template <int Dim>
std::set<std::uint64_t> codes(const Contacts<Dim>& found) {
    std::set<std::uint64_t> result;
    for (const auto& c : found) result.insert(c.feature.code);
    return result;
}

template <int Dim>
talus::Pose<Dim> raised(double height) {
    talus::Pose<Dim> at;
    at.position[Dim - 1] = height;
    return at;
}

/// Turns by `angle` [rad] so that axis 0 rises towards the last axis.
template <int Dim>
talus::Rotation<Dim> tilt(double angle) {
    talus::AngularVector<Dim> spin = talus::AngularVector<Dim>::Zero();
    spin[Dim == 2 ? 0 : 1] = Dim == 2 ? angle : -angle;
    return talus::Rotation<Dim>::exp(spin);
}

template <int Dim>
talus::Box<Dim> cube(double half) {
    return talus::Box<Dim>(talus::Vector<Dim>::Constant(half));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_cube_on_an_equal_cube_touches_by_its_corners, D, dimensions) {
    constexpr int Dim = D::value;
    const auto found = contacts<Dim>(cube<Dim>(0.5), raised<Dim>(0.99), cube<Dim>(0.5));
    BOOST_CHECK_EQUAL(found.size(), Dim == 2 ? 2u : 4u);
    for (const auto& c : found) {
        BOOST_CHECK_SMALL(c.gap + 0.01, rounding);
        BOOST_CHECK_SMALL((c.normal - talus::Vector<Dim>::Unit(Dim - 1)).norm(), rounding);
        for (int k = 0; k < Dim - 1; ++k) BOOST_CHECK_SMALL(std::abs(c.point[k]) - 0.5, rounding);
        BOOST_CHECK_SMALL(c.point[Dim - 1] - 0.495, rounding);
    }
}

/// The oracle: corners of the overlap of two rectangles, one turned, as the vertices of either
/// inside the other and the crossings of their sides.
BOOST_AUTO_TEST_CASE(the_overlap_of_two_turned_faces_is_complete) {
    random_geometry::Generator g(9);
    for (int trial = 0; trial < 100; ++trial) {
        const double angle = random_geometry::uniform(g, 0.05, 1.5);
        talus::Pose<3> at = raised<3>(0.9);
        at.rotation = talus::Rotation<3>::exp({0.0, 0.0, angle});
        at.position[0] = random_geometry::uniform(g, -0.6, 0.6);
        at.position[1] = random_geometry::uniform(g, -0.6, 0.6);
        const talus::Vector<3> h(0.7, 0.4, 0.5);
        const auto found = contacts<3>(talus::Box<3>(h), at, cube<3>(0.5));
        const auto in_a = [&](const talus::Vector<3>& x) {
            const talus::Vector<3> y = at.point_body(x);
            return std::abs(y[0]) < h[0] && std::abs(y[1]) < h[1];
        };
        std::vector<talus::Vector<3>> a, b, expected;
        for (const auto& s : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            a.push_back(at.point_world({s.first * h[0], s.second * h[1], 0.0}));
            b.emplace_back(0.5 * s.first, 0.5 * s.second, 0.0);
            if (std::abs(a.back()[0]) < 0.5 && std::abs(a.back()[1]) < 0.5)
                expected.push_back(a.back());
            if (in_a(b.back())) expected.push_back(b.back());
        }
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                const talus::Vector<3> u = a[(i + 1) % 4] - a[i], v = b[(j + 1) % 4] - b[j];
                talus::Matrix<2> m;
                m << u[0], -v[0], u[1], -v[1];
                const talus::Vector<2> t = m.inverse() * (b[j] - a[i]).head<2>();
                if ((t.array() > 0.0).all() && (t.array() < 1.0).all())
                    expected.push_back(a[i] + t[0] * u);
            }
        BOOST_CHECK_EQUAL(found.size(), expected.size());
        for (const auto& x : expected)
            BOOST_CHECK(std::ranges::any_of(found, [&](const auto& c) {
                return (c.point - x).template head<2>().norm() < lateral &&
                       std::abs(c.gap + 0.1) < rounding;
            }));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_rocking_box_keeps_codes_and_turns_its_normal_smoothly, D,
                              dimensions) {
    constexpr int Dim = D::value;
    talus::Vector<Dim> wide = talus::Vector<Dim>::Constant(2.0);
    wide[Dim - 1] = 0.5;
    const talus::AnyShape<Dim> ground[] = {talus::Box<Dim>(wide), cube<Dim>(0.5)};
    for (const auto& base : ground) {
        const double shift = 0.1;
        const auto placed = [&](double angle) {
            talus::Pose<Dim> at = raised<Dim>(0.9995);
            at.position[0] = shift;
            at.rotation = tilt<Dim>(angle);
            return at;
        };
        const auto rest = contacts<Dim>(cube<Dim>(0.5), placed(0.0), base, {}, 0.01);
        BOOST_CHECK_EQUAL(rest.size(), Dim == 2 ? 2u : 4u);
        for (const double angle : {-3e-3, -1e-3, -1e-6, -1e-9, -1e-15, 1e-15, 1e-9, 1e-6, 1e-3}) {
            const auto found = contacts<Dim>(cube<Dim>(0.5), placed(angle), base, {}, 0.01);
            BOOST_CHECK(codes<Dim>(found) == codes<Dim>(rest));
            for (const auto& c : found)
                BOOST_CHECK_LE((c.normal - talus::Vector<Dim>::Unit(Dim - 1)).norm(),
                               1.1 * std::abs(angle) + rounding);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sliding_box_keeps_codes, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::AnyShape<Dim> floor =
        talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1), 0.5);
    const talus::AnyShape<Dim> bases[] = {floor, cube<Dim>(0.5)};
    for (const auto& base : bases) {
        std::set<std::uint64_t> first;
        for (double x = 0.05; x < 0.9; x += 0.05) {
            talus::Pose<Dim> at = raised<Dim>(0.999);
            at.position[0] = x;
            const auto now = codes<Dim>(contacts<Dim>(cube<Dim>(0.5), at, base));
            if (first.empty()) first = now;
            BOOST_CHECK_EQUAL(now.size(), Dim == 2 ? 2u : 4u);
            BOOST_CHECK(now == first);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_capsule_lying_on_a_box_touches_at_two_places, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double shift : {0.0, 0.6}) {
        talus::Pose<Dim> at = raised<Dim>(0.74);
        at.position[0] = shift;
        const auto found = contacts<Dim>(talus::Capsule<Dim>(0.4, 0.25), at, cube<Dim>(0.5));
        BOOST_REQUIRE_EQUAL(found.size(), 2u);
        const double low = shift - 0.4, high = std::min(0.5, shift + 0.4);
        BOOST_CHECK_SMALL(std::min(found[0].point[0], found[1].point[0]) - low, lateral);
        BOOST_CHECK_SMALL(std::max(found[0].point[0], found[1].point[0]) - high, lateral);
        for (const auto& c : found) BOOST_CHECK_SMALL(c.gap + 0.01, rounding);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_rocking_capsule_keeps_codes_even_over_an_edge, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double shift : {0.0, 0.6}) {
        std::set<std::uint64_t> rest;
        for (const double angle : {0.0, -5e-4, -1e-6, -1e-12, 1e-12, 1e-6, 5e-4}) {
            talus::Pose<Dim> at = raised<Dim>(0.75);
            at.position[0] = shift;
            at.rotation = tilt<Dim>(angle);
            const auto found =
                contacts<Dim>(talus::Capsule<Dim>(0.4, 0.25), at, cube<Dim>(0.5), {}, 0.01);
            if (rest.empty()) rest = codes<Dim>(found);
            BOOST_CHECK_EQUAL(found.size(), 2u);
            BOOST_CHECK(codes<Dim>(found) == rest);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_scaled_scene_has_scaled_contacts, D, dimensions) {
    constexpr int Dim = D::value;
    const double scale = 0x1.0p-20;  // a power of two: then even the rounding is the same
    for (int kind_a = 0; kind_a < 4; ++kind_a)
        for (int kind_b = 0; kind_b < 4; ++kind_b)
            for (unsigned seed = 0; seed < 10; ++seed) {
                const auto scene = [&](double unit) {
                    random_geometry::Generator g(seed);
                    const auto a = random_geometry::convex_shape<Dim>(g, kind_a, unit);
                    const auto b = random_geometry::convex_shape<Dim>(g, kind_b, unit);
                    return contacts<Dim>(a, random_geometry::pose<Dim>(g, 1.5 * unit), b, {},
                                         0.1 * unit);
                };
                const auto large = scene(1.0), small = scene(scale);
                BOOST_REQUIRE_EQUAL(large.size(), small.size());
                for (std::size_t i = 0; i < large.size(); ++i) {
                    BOOST_CHECK(large[i].feature == small[i].feature);
                    BOOST_CHECK_SMALL(large[i].gap - small[i].gap / scale, 1e-12);
                }
            }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(parallel_capsules_touch_at_two_places_crossed_ones_at_one, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const talus::Capsule<Dim> capsule(0.5, 0.1);
    for (const double angle : {0.0, 1e-9, 1e-5, 1e-3}) {
        talus::Pose<Dim> at = raised<Dim>(0.2);
        at.rotation = tilt<Dim>(angle);
        const auto found = contacts<Dim>(capsule, at, capsule, {}, 0.01);
        BOOST_REQUIRE_EQUAL(found.size(), 2u);
        // One end sinks as much as the other rises.
        BOOST_CHECK_SMALL(std::abs(found[0].gap - found[1].gap) - std::sin(angle), 1e-5);
    }
    if constexpr (Dim == 3) {
        talus::Pose<3> across = raised<3>(0.19);
        across.rotation = talus::Rotation<3>::exp({0.0, 0.0, 1.0});
        const auto found = contacts<3>(capsule, across, capsule);
        BOOST_REQUIRE_EQUAL(found.size(), 1u);
        BOOST_CHECK_SMALL(found[0].gap + 0.01, rounding);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_at_a_corner_sees_the_corner, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Pose<Dim> at;
    at.position.setConstant(0.5 + 0.09 / std::sqrt(double{Dim}));
    const auto found = contacts<Dim>(talus::Ball<Dim>(0.1), at, cube<Dim>(0.5));
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    BOOST_CHECK_SMALL(found[0].gap + 0.01, rounding);
    BOOST_CHECK_SMALL((found[0].normal - talus::Vector<Dim>::Constant(1.0).normalized()).norm(),
                      1e-11);
}

BOOST_AUTO_TEST_CASE(crossed_edges_touch_at_one_place) {
    // Two cubes, each standing on an edge, the edges at right angles.
    talus::Pose<3> a = raised<3>(2.0 * std::sqrt(0.5) - 0.01), b;
    const double quarter = std::numbers::pi / 4.0;
    a.rotation = talus::Rotation<3>::exp({quarter, 0.0, 0.0});
    b.rotation = talus::Rotation<3>::exp({0.0, quarter, 0.0});
    const auto found = contacts<3>(cube<3>(0.5), a, cube<3>(0.5), b);
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    BOOST_CHECK_SMALL(found[0].gap + 0.01, rounding);
    BOOST_CHECK_SMALL((found[0].normal - talus::Vector<3>::UnitZ()).norm(), rounding);
    BOOST_CHECK_SMALL(found[0].point.head<2>().norm(), rounding);
}

BOOST_AUTO_TEST_CASE(an_edge_on_a_face_touches_at_both_ends) {
    talus::Pose<3> at = raised<3>(0.5 + std::sqrt(0.5) - 0.01);
    at.rotation = talus::Rotation<3>::exp({std::numbers::pi / 4.0, 0.0, 0.0});
    const auto found = contacts<3>(cube<3>(0.5), at, talus::Box<3>({2.0, 2.0, 0.5}));
    BOOST_REQUIRE_EQUAL(found.size(), 2u);
    for (const auto& c : found) BOOST_CHECK_SMALL(c.gap + 0.01, rounding);
    BOOST_CHECK_SMALL(std::abs(found[0].point[0] - found[1].point[0]) - 1.0, rounding);
}

BOOST_AUTO_TEST_CASE(an_extruded_polygon_pair_gives_the_gaps_and_normals_of_the_plane) {
    random_geometry::Generator g(10);
    const auto extruded = [](const std::vector<talus::Vector<2>>& flat, double half) {
        std::vector<talus::Vector<3>> v;
        for (const auto& x : flat)
            for (const double z : {-half, half}) v.emplace_back(x[0], x[1], z);
        return talus::ConvexPolytope<3>(v);
    };
    for (int trial = 0; trial < 200; ++trial) {
        const auto p = random_geometry::corners<2>(g, 6, 1.0);
        const auto q = random_geometry::corners<2>(g, 5, 1.0);
        talus::Pose<2> at;
        at.position = random_geometry::displacement<2>(g, 1.6, 2.2);
        const double angle = random_geometry::uniform(g, -3.0, 3.0);
        at.rotation = talus::Rotation<2>(angle);
        talus::Pose<3> lifted;
        lifted.position << at.position, 0.0;
        lifted.rotation = talus::Rotation<3>::exp({0.0, 0.0, angle});
        const auto flat =
            contacts<2>(talus::ConvexPolytope<2>(p), at, talus::ConvexPolytope<2>(q), {}, 0.1);
        const auto deep = contacts<3>(extruded(p, 5.0), lifted, extruded(q, 4.0), {}, 0.1);
        BOOST_CHECK_EQUAL(deep.size(), 2 * flat.size());
        for (const auto& c : flat)
            BOOST_CHECK_EQUAL(std::ranges::count_if(
                                  deep,
                                  [&](const auto& d) {
                                      return std::abs(d.gap - c.gap) < 1e-10 &&
                                             (d.normal.template head<2>() - c.normal).norm() <
                                                 1e-9 &&
                                             (d.point.template head<2>() - c.point).norm() < 1e-9;
                                  }),
                              2);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_compound_of_one_acts_like_its_child, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(12);
    for (int trial = 0; trial < 40; ++trial) {
        const talus::Box<Dim> box = cube<Dim>(0.5);
        const talus::Compound<Dim> clump({{box, {}}});
        const auto at = random_geometry::pose<Dim>(g, 1.2);
        const auto alone = contacts<Dim>(box, at, cube<Dim>(0.5), {}, 0.05);
        for (const auto& found : {contacts<Dim>(clump, at, cube<Dim>(0.5), {}, 0.05),
                                  contacts<Dim>(clump, at, clump, {}, 0.05)}) {
            BOOST_REQUIRE_EQUAL(found.size(), alone.size());
            for (std::size_t i = 0; i < found.size(); ++i)
                BOOST_CHECK_SMALL(found[i].gap - alone[i].gap, rounding);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(children_of_compounds_have_codes_of_their_own, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Pose<Dim> left, right;
    left.position[0] = -1.0;
    right.position[0] = 1.0;
    const talus::Compound<Dim> pair({{cube<Dim>(0.5), left}, {cube<Dim>(0.5), right}});
    const auto found = contacts<Dim>(pair, raised<Dim>(0.99), pair);
    BOOST_CHECK_EQUAL(found.size(), Dim == 2 ? 4u : 8u);
    BOOST_CHECK_EQUAL(codes<Dim>(found).size(), found.size());
    const talus::AnyShape<Dim> floor =
        talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1), 0.5);
    const auto standing = contacts<Dim>(pair, raised<Dim>(0.99), floor);
    BOOST_CHECK_EQUAL(codes<Dim>(standing).size(), Dim == 2 ? 4u : 8u);
    const auto mirrored = contacts<Dim>(floor, {}, pair, raised<Dim>(0.99));
    BOOST_REQUIRE_EQUAL(mirrored.size(), standing.size());
    for (std::size_t i = 0; i < mirrored.size(); ++i)
        BOOST_CHECK(mirrored[i].feature == talus::mirrored(standing[i].feature));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(coinciding_shapes_give_finite_contacts, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(13);
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
            const auto shape_a = random_geometry::convex_shape<Dim>(g, a, 1.0);
            const auto shape_b = random_geometry::convex_shape<Dim>(g, b, 1.0);
            const auto found = contacts<Dim>(shape_a, {}, shape_b);
            BOOST_CHECK(!found.empty());
            for (const auto& c : found) {
                BOOST_CHECK(std::isfinite(c.gap) && c.point.allFinite() && c.gap < 0.0);
                BOOST_CHECK_SMALL(c.normal.norm() - 1.0, rounding);
            }
        }
}

/// Those of one pair, mostly few and in order, but there may be thousands.
BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_are_sorted_by_feature_however_many, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(11);
    for (const std::size_t n : {0u, 1u, 2u, 3u, 22u, 23u, 24u, 60u, 140u, 900u, 5000u}) {
        talus::Column<talus::ContactPoint<Dim>> points;
        for (std::size_t k = 0; k < n; ++k) {
            const std::uint64_t code = g();
            points.push_back({.gap = static_cast<double>(code % 1000), .feature = {code}});
        }
        std::multiset<talus::FeatureId> expected;
        for (const auto& point : points) expected.insert(point.feature);
        talus::sort_by_feature(points);
        BOOST_TEST(points.size() == n);
        std::size_t k = 0;
        for (const talus::FeatureId& feature : expected) {
            BOOST_REQUIRE(points[k].feature == feature);
            BOOST_REQUIRE_EQUAL(points[k].gap, static_cast<double>(feature.code % 1000));
            ++k;
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
