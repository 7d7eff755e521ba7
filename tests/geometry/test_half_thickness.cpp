// SPDX-License-Identifier: BSL-1.0
// How thin a shape is at its thinnest part, however it lies in its frame: what overlaps and ways
// are measured with. Oracles: closed forms, and the least width over many directions.
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include "common/dimensions.hpp"
#include "common/hull_tester.hpp"

BOOST_AUTO_TEST_SUITE(geometry_half_thickness)

using talus::Pose;
using talus::Vector;
constexpr double rounding = 1e-12;

template <int Dim>
talus::Rotation<Dim> oblique() {
    talus::AngularVector<Dim> turn = talus::AngularVector<Dim>::Constant(0.4);
    turn[0] = 0.7;
    return talus::Rotation<Dim>::exp(turn);
}
template <int Dim>
Pose<Dim> obliquely() {
    return {0.3 * Vector<Dim>::Ones(), oblique<Dim>()};
}
template <int Dim>
Vector<Dim> sheet(double thickness) {
    Vector<Dim> half = 0.5 * Vector<Dim>::Ones();
    half[Dim - 1] = 0.5 * thickness;
    return half;
}
template <int Dim>
talus::ConvexPolytope<Dim> as_polytope(const talus::Box<Dim>& box) {
    const auto v = box.core().vertices;
    if constexpr (Dim == 2)
        return talus::ConvexPolytope<2>({v[0], v[1], v[3], v[2]});
    else
        return talus::ConvexPolytope<3>({v.begin(), v.end()});
}

/// A sheet that tells no more than its box, or also how thin it is.
template <int Dim>
struct OwnSheet {
    double thickness;
    Pose<Dim> pose = {};
    talus::Box<Dim> box() const { return talus::Box<Dim>(sheet<Dim>(thickness)).placed(pose); }
    talus::Aabb<Dim> aabb(const Pose<Dim>& at) const { return box().aabb(at); }
    Vector<Dim> support(const Vector<Dim>& d) const { return box().support(d); }
    talus::MassProperties<Dim> mass_properties() const { return box().mass_properties(); }
    OwnSheet placed(const Pose<Dim>& at) const { return {thickness, at * pose}; }
};
template <int Dim>
struct TellingSheet : OwnSheet<Dim> {
    double half_thickness() const { return 0.5 * this->thickness; }
};
/// A core with a rounding: nothing of talus', but a shape that one may write.
template <int Dim>
struct RoundedBox {
    talus::Box<Dim> box;
    double radius;
    talus::CoreView<Dim> core() const {
        auto view = box.core();
        view.radius = radius;
        return view;
    }
    talus::Aabb<Dim> aabb(const Pose<Dim>& pose) const { return core_aabb(core(), pose); }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(shapes_are_as_thin_as_they_are_however_they_lie, D, dimensions) {
    constexpr int Dim = D::value;
    const auto check = [](const auto& shape, double expected) {
        for (const auto& s : {shape, decltype(shape)(shape.placed(obliquely<D::value>()))}) {
            BOOST_TEST(talus::half_thickness<D::value>(s) == expected,
                       boost::test_tools::tolerance(1e-10));
            const talus::AnyShape<D::value> any(s);
            BOOST_TEST(talus::half_thickness<D::value>(any) == expected,
                       boost::test_tools::tolerance(1e-10));
        }
    };
    const talus::Box<Dim> plate(sheet<Dim>(1e-3));
    check(talus::Ball<Dim>(0.2), 0.2);
    check(talus::Capsule<Dim>(2.0, 0.1), 0.1);
    check(plate, 0.5e-3);
    check(as_polytope(plate), 0.5e-3);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Vector<Dim>& normal :
         {Vector<Dim>(Vector<Dim>::Unit(0)), Vector<Dim>(Vector<Dim>::Ones())})
        BOOST_TEST(talus::half_thickness<Dim>(talus::HalfSpace<Dim>(normal)) == infinity);
    const RoundedBox<Dim> rounded{plate.placed(obliquely<Dim>()), 0.01};
    BOOST_TEST(talus::half_thickness<Dim>(rounded) == 0.0105, boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_compound_is_as_thin_as_its_thinnest_child, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::Box<Dim> wall(sheet<Dim>(2e-3));
    const talus::Ball<Dim> ball(0.3);
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    const talus::Compound<Dim> walls({{wall, {}}, {wall, {up, oblique<Dim>()}}, {ball, {-up, {}}}});
    for (const auto& s : {walls, walls.placed(obliquely<Dim>())}) {
        BOOST_TEST(talus::half_thickness<Dim>(s) == 1e-3, boost::test_tools::tolerance(1e-10));
        BOOST_TEST(talus::half_thickness<Dim>(talus::AnyShape<Dim>(s)) == 1e-3,
                   boost::test_tools::tolerance(1e-10));
    }
    const talus::CompoundOf<Dim, talus::Ball<Dim>> clump({{ball, {}}, {ball, {up, {}}}});
    BOOST_TEST(talus::half_thickness<Dim>(clump) == 0.3);
    // Told by its box in its own frame, not in that of the compound.
    const talus::CompoundOf<Dim, OwnSheet<Dim>> own({{OwnSheet<Dim>{2e-3}, obliquely<Dim>()}});
    BOOST_TEST(talus::half_thickness<Dim>(own.placed(obliquely<Dim>())) == 1e-3,
               boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(own_shapes_are_known_by_their_box_unless_they_say, D, dimensions) {
    constexpr int Dim = D::value;
    const Pose<Dim> pose = obliquely<Dim>();
    const OwnSheet<Dim> silent{1e-3};
    const TellingSheet<Dim> telling{{1e-3, pose}};
    BOOST_TEST(talus::half_thickness<Dim>(silent) == 0.5e-3, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(talus::half_thickness<Dim>(silent.placed(pose)) > 0.05);
    BOOST_TEST(talus::half_thickness<Dim>(telling) == 0.5e-3);
    using Own = talus::AnyShapeOf<Dim, talus::Ball<Dim>, TellingSheet<Dim>, OwnSheet<Dim>>;
    BOOST_TEST(talus::half_thickness<Dim>(Own(telling)) == 0.5e-3);
    BOOST_TEST(talus::half_thickness<Dim>(Own(silent)) == 0.5e-3,
               boost::test_tools::tolerance(1e-10));
    for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()})
        BOOST_CHECK_EXCEPTION(
            talus::half_thickness<Dim>(Own(TellingSheet<Dim>{{2.0 * wrong}})), talus::input_error,
            [](const auto& e) {
                return std::string(e.what()).starts_with("half thickness of the shape is ");
            });
}

/// Least width of corners along their box's axes and many directions.
template <int Dim>
double least_half_width(const std::vector<Vector<Dim>>& v, hull_tester::Source& random) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20000; ++i) {
        const Vector<Dim> n = random.rotation().matrix().col(0).template head<Dim>().normalized();
        double low = n.dot(v[0]), high = low;
        for (const auto& x : v) low = std::min(low, n.dot(x)), high = std::max(high, n.dot(x));
        least = std::min(least, 0.5 * (high - low));
    }
    return least;
}

BOOST_AUTO_TEST_CASE(polygons_are_measured_exactly_and_polyhedra_between_width_and_box) {
    hull_tester::Source random(7);
    const auto regular = [&](int n) {
        std::vector<Vector<2>> v;
        for (int k = 0; k < n; ++k) {
            const double angle = 0.3 + 2.0 * std::acos(-1.0) * k / n;
            v.emplace_back(std::cos(angle), 0.2 * std::sin(angle));
        }
        return v;
    };
    for (const int n : {3, 4, 5, 8, 13}) {
        const double least = least_half_width<2>(regular(n), random);
        const double told = talus::half_thickness<2>(talus::ConvexPolytope<2>(regular(n)));
        BOOST_TEST(told <= least * (1.0 + rounding));
        BOOST_TEST(told > 0.99 * least);
    }
    // A slat, whose box is of no help.
    for (const int n : {3, 4, 6}) {
        auto v = hull_tester::turned(hull_tester::prism(n, 1.0, 0.01), random.rotation());
        const talus::ConvexPolytope<3> slat(v);
        const double told = talus::half_thickness<3>(slat);
        BOOST_TEST(told == 0.005, boost::test_tools::tolerance(1e-9));
    }
    // The least width of a tetrahedron is between two of its edges: no face has that normal.
    const std::vector<Vector<3>> tetrahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0.1}, {0, -1, 0.1}};
    const talus::ConvexPolytope<3> sliver(tetrahedron);
    BOOST_TEST(talus::half_thickness<3>(sliver) == 0.05, boost::test_tools::tolerance(1e-9));
    const double turned = talus::half_thickness<3>(sliver.placed(obliquely<3>()));
    BOOST_TEST(turned >= 0.05 * (1.0 - rounding));
    BOOST_TEST(turned < 0.1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_needle_has_none, D, dimensions) {
    constexpr int Dim = D::value;
    struct Needle {
        talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
            const talus::Vector<Dim> end = pose.point_world(talus::Vector<Dim>::Unit(0));
            return {pose.position.cwiseMin(end), pose.position.cwiseMax(end)};
        }
    };
    BOOST_TEST(talus::half_thickness<Dim>(Needle{}) == 0.0);
    struct Wrong : talus::Ball<Dim> {
        using talus::Ball<Dim>::Ball;
        double half_thickness() const { return -1.0; }
    };
    BOOST_CHECK_THROW(talus::half_thickness<Dim>(Wrong(0.1)), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
