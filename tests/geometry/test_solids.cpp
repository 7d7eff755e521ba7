// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/any_shape.hpp>
#include <talus/geometry/superellipsoid.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <functional>
#include <limits>

#include "common/dimensions.hpp"
#include "common/shape_tester.hpp"

BOOST_AUTO_TEST_SUITE(geometry_solids)

const double rounding = 1e-13;  // a few dozen operations on numbers of order one

template <int Dim>
bool in_capsule(const talus::Vector<Dim>& x, double half_length, double radius) {
    talus::Vector<Dim> on_axis = talus::Vector<Dim>::Zero();
    on_axis[0] = std::clamp(x[0], -half_length, half_length);
    return (x - on_axis).norm() <= radius;
}

/// Membership by the definition of a convex hull's planes, found by brute force over all tuples of
/// vertices: x is outside if a plane (line) through them has all vertices on one side and x on the
/// other.
template <int Dim>
bool in_hull(const std::vector<talus::Vector<Dim>>& v, const talus::Vector<Dim>& x) {
    const auto separates = [&](const talus::Vector<Dim>& n, const talus::Vector<Dim>& p) {
        double low = 0.0, high = 0.0;
        for (const auto& y : v) {
            low = std::min(low, n.dot(y - p));
            high = std::max(high, n.dot(y - p));
        }
        const double at_x = n.dot(x - p), eps = 1e-12 * n.norm();
        return (high <= eps && at_x > eps) || (low >= -eps && at_x < -eps);
    };
    for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t j = i + 1; j < v.size(); ++j) {
            if constexpr (Dim == 2) {
                if (separates((v[j] - v[i]).unitOrthogonal(), v[i])) return false;
            } else {
                for (std::size_t k = j + 1; k < v.size(); ++k)
                    if (separates((v[j] - v[i]).cross(v[k] - v[i]), v[i])) return false;
            }
        }
    return true;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_is_a_solid, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::Vector<Dim> centre = talus::Vector<Dim>::Constant(0.3);
    ShapeTester<Dim, talus::Ball<Dim>, std::function<bool(const talus::Vector<Dim>&)>>(
        talus::Ball<Dim>(0.7, centre), [&](const auto& x) { return (x - centre).norm() <= 0.7; })
        .check();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_capsule_is_a_solid, D, dimensions) {
    constexpr int Dim = D::value;
    ShapeTester<Dim, talus::Capsule<Dim>, std::function<bool(const talus::Vector<Dim>&)>>(
        talus::Capsule<Dim>(0.8, 0.5), [](const auto& x) { return in_capsule<Dim>(x, 0.8, 0.5); })
        .check();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_is_a_solid, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Vector<Dim> h = talus::Vector<Dim>::Constant(0.5);
    h[0] = 1.0;
    ShapeTester<Dim, talus::Box<Dim>, std::function<bool(const talus::Vector<Dim>&)>>(
        talus::Box<Dim>(h),
        [h](const auto& x) { return (x.cwiseAbs().array() <= h.array()).all(); })
        .check();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_polytope_is_the_hull_of_its_vertices, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(5);
    const auto corners = random_geometry::corners<Dim>(g, 9, 1.0);
    ShapeTester<Dim, talus::ConvexPolytope<Dim>, std::function<bool(const talus::Vector<Dim>&)>>(
        talus::ConvexPolytope<Dim>(corners),
        [&](const auto& x) { return in_hull<Dim>(corners, x); })
        .check();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_compound_is_the_union_of_children_apart, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Pose<Dim> left, right;
    left.position[0] = -1.5;
    right.position[0] = 1.5;
    const talus::Compound<Dim> shape(
        {{talus::Ball<Dim>(0.5), left}, {talus::Capsule<Dim>(0.8, 0.5), right}});
    ShapeTester<Dim, talus::Compound<Dim>,
                std::function<bool(const talus::Vector<Dim>&)>>(shape, [&](const auto& x) {
        return (x - left.position).norm() <= 0.5 || in_capsule<Dim>(x - right.position, 0.8, 0.5);
    }).check();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_as_a_polytope_has_the_same_integrals_and_merged_faces, D,
                              dimensions) {
    constexpr int Dim = D::value;
    talus::Vector<Dim> h = talus::Vector<Dim>::Constant(0.4);
    h[Dim - 1] = 1.1;
    random_geometry::Generator g(6);
    // Turned, so that coplanarity holds to rounding only.
    const talus::Box<Dim> box = talus::Box<Dim>(h).placed(random_geometry::pose<Dim>(g, 1.0));
    const auto v = box.core().vertices;
    std::vector<talus::Vector<Dim>> corners(v.begin(), v.end());
    if constexpr (Dim == 2) std::swap(corners[2], corners[3]);
    const talus::ConvexPolytope<Dim> polytope(corners);
    BOOST_CHECK_EQUAL(polytope.core().face_count(), 2u * Dim);
    if constexpr (Dim == 3) BOOST_CHECK_EQUAL(polytope.core().edges.size(), 12u);
    const auto m = box.mass_properties(), n = polytope.mass_properties();
    BOOST_CHECK_SMALL(m.volume - n.volume, rounding);
    BOOST_CHECK_SMALL((m.centroid - n.centroid).norm(), rounding);
    BOOST_CHECK_SMALL((m.inertia - n.inertia).norm(), rounding);
}

BOOST_AUTO_TEST_CASE(a_hull_has_every_vertex_below_every_face_and_obeys_euler) {
    random_geometry::Generator g(8);
    for (const int count : {4, 5, 8, 20, 60, 300}) {
        const talus::ConvexPolytope<3> shape(random_geometry::corners<3>(g, count, 1e-3));
        const auto c = shape.core();
        for (std::size_t f = 0; f < c.face_count(); ++f)
            for (const auto& v : c.vertices)
                BOOST_CHECK_LE(c.normals[f].dot(v) - c.offsets[f], 1e-12);
        BOOST_CHECK_EQUAL(c.vertices.size() + c.face_count(), c.edges.size() + 2);
        for (const auto& e : c.edges) {
            const auto left = c.face(e.left);
            const auto at = std::ranges::find(left, e.tail);
            BOOST_REQUIRE(at != left.end());
            BOOST_CHECK_EQUAL(at + 1 == left.end() ? left.front() : at[1], e.head);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_prism_with_many_sided_ends_has_two_faces_with_all_corners) {
    const int sides = 40;
    std::vector<talus::Vector<3>> v;
    for (int i = 0; i < sides; ++i)
        for (const double z : {-1.0, 1.0})
            v.emplace_back(std::cos(2 * std::numbers::pi * i / sides),
                           std::sin(2 * std::numbers::pi * i / sides), z);
    const talus::ConvexPolytope<3> prism(v);
    BOOST_CHECK_EQUAL(prism.core().face_count(), 2u + sides);
    const double area = 0.5 * sides * std::sin(2 * std::numbers::pi / sides);
    BOOST_CHECK_SMALL(prism.mass_properties().volume - 2.0 * area, rounding);
}

template <int Dim>
std::string refusal(const std::vector<talus::Vector<Dim>>& v) {
    try {
        talus::ConvexPolytope<Dim>{v};
    } catch (const talus::input_error& e) {
        return e.what();
    }
    return "";
}
bool has(const std::string& text, const char* part) { return text.find(part) != text.npos; }

BOOST_AUTO_TEST_CASE(bad_polygons_are_refused_by_vertex) {
    using V = std::vector<talus::Vector<2>>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {1, 0}}), "at least 3"));
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {1, 0}, {1, nan}}), "vertex 2"));
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "vertex 2 coincides"));
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {0, 1}, {1, 0}}), "clockwise"));
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {1, 0}, {2, 0}}), "no area"));
    BOOST_CHECK(has(refusal<2>(V{{0, 0}, {2, 0}, {1, 0.5}, {1, 2}}), "vertex 2 is no convex"));
    V star;
    for (int i = 0; i < 5; ++i)
        star.emplace_back(std::cos(0.8 * std::numbers::pi * i),
                          std::sin(0.8 * std::numbers::pi * i));
    BOOST_CHECK(has(refusal<2>(star), "more than once"));
}

BOOST_AUTO_TEST_CASE(bad_polyhedra_are_refused_by_vertex) {
    using V = std::vector<talus::Vector<3>>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const V good{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto with = [&](const talus::Vector<3>& x) {
        V v = good;
        v.push_back(x);
        return v;
    };
    BOOST_CHECK_EQUAL(refusal<3>(good), "");
    BOOST_CHECK(has(refusal<3>(V(good.begin(), good.begin() + 3)), "at least 4"));
    BOOST_CHECK(has(refusal<3>(with({nan, 0, 0})), "vertex 4"));
    BOOST_CHECK(has(refusal<3>(with({1, 0, 1e-12})), "vertex 4 coincides with vertex 1"));
    BOOST_CHECK(has(refusal<3>(with({0.1, 0.1, 0.1})), "vertex 4 is no corner"));
    BOOST_CHECK(has(refusal<3>(V{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), "in a plane"));
    BOOST_CHECK(has(refusal<3>(V{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), "on a line"));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(superellipsoids, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double n : {1.25, 1.6, 2.0, 3.0, 8.0}) {
        const talus::Vector<Dim> axes = talus::Vector<Dim>::Ones() * 0.3 +
                                        0.4 * talus::Vector<Dim>::Unit(0) +
                                        0.2 * talus::Vector<Dim>::Unit(Dim - 1);
        ShapeTester<Dim, talus::Superellipsoid<Dim>,
                    std::function<bool(const talus::Vector<Dim>&)>>(
            talus::Superellipsoid<Dim>(axes, n),
            [&](const talus::Vector<Dim>& x) {
                double sum = 0.0;
                for (int k = 0; k < Dim; ++k) sum += std::pow(std::abs(x[k]) / axes[k], n);
                return sum <= 1.0;
            })
            .check();
    }
    // Balls, and ellipses in closed form.
    const talus::Ball<Dim> ball(0.7);
    const talus::Superellipsoid<Dim> round(0.7 * talus::Vector<Dim>::Ones());
    BOOST_CHECK_CLOSE_FRACTION(round.mass_properties().volume, ball.mass_properties().volume,
                               1e-14);
    BOOST_CHECK_SMALL((round.mass_properties().inertia - ball.mass_properties().inertia).norm(),
                      1e-14);
    BOOST_TEST(round.half_thickness() == 0.7);
    // Directions of any length, along an axis too, where powers of zero stand.
    for (const double n : {2.0, 5.0})
        for (const double length : {1e-200, 1.0, 1e200}) {
            const talus::Vector<Dim> x = talus::Vector<Dim>::Unit(0);
            const talus::Superellipsoid<Dim> one(talus::Vector<Dim>::Ones(), n);
            BOOST_CHECK_SMALL((one.support(length * x) - x).norm(), 1e-14);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_sizes_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double n : {1.2, 8.1, 0.0, std::nan("")})
        BOOST_CHECK_THROW(talus::Superellipsoid<Dim>(talus::Vector<Dim>::Ones(), n),
                          talus::input_error);
    BOOST_CHECK_THROW(talus::Superellipsoid<Dim>(talus::Vector<Dim>::Unit(0)), talus::input_error);
    BOOST_CHECK_THROW(talus::Capsule<Dim>(0.0, 1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::Capsule<Dim>(1.0, -1.0), talus::input_error);
    const talus::Vector<Dim> zero = talus::Vector<Dim>::Zero();
    BOOST_CHECK_THROW(talus::Box<Dim>{zero}, talus::input_error);
    BOOST_CHECK_THROW(talus::Compound<Dim>({}), talus::input_error);
    BOOST_CHECK_THROW(talus::HalfSpace<Dim>{zero}, talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(overlapping_children_may_be_given_their_true_mass, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::Ball<Dim> ball(1.0);
    const talus::Compound<Dim> twice({{ball, {}}, {ball, {}}}, ball.mass_properties());
    BOOST_CHECK_EQUAL(twice.mass_properties().volume, ball.mass_properties().volume);
}

BOOST_AUTO_TEST_SUITE_END()
