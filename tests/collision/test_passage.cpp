// SPDX-License-Identifier: BSL-1.0
// Which side two boxes meet by, and when, against what can be told by hand.
#include <talus/collision/passage.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/geometry/box.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "common/in_plane.hpp"

BOOST_AUTO_TEST_SUITE(collision_passage)

template <int Dim>
struct Flight {
    using Vec = talus::Vector<Dim>;
    static Vec at(double x, double y) { return in_plane<Dim>(x, y); }
    static constexpr double half = 0.1, reach = 0.3;

    talus::Column<talus::ContactPoint<Dim>> contacts;
    talus::Meeting meeting;

    /// Of a cube from a place with an offset from another of the same size.
    Flight(const Vec& offset, const Vec& way, double turn = 0.0) {
        const talus::Box<Dim> cube(Vec::Constant(half));
        const auto view = talus::view_of<Dim>(cube);
        talus::AngularVector<Dim> angular = talus::AngularVector<Dim>::Zero();
        angular[0] = turn;
        const talus::MovingShape<Dim> a{view, {offset, {}}, {way, angular}}, b{view, {}, {}};
        talus::Column<talus::ContactPoint<Dim>> present, near;
        talus::contact_points<Dim>(cube, a.pose, cube, b.pose, reach, present);
        BOOST_TEST_REQUIRE(!present.empty());
        meeting = talus::Passage<Dim>(a, b, talus::narrow_routines<Dim, talus::AnyShape<Dim>>, 1e-6,
                                      reach, near)
                      .append(present, contacts);
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_corner_meets_the_side_that_it_comes_to_last, D, dimensions) {
    using F = Flight<D::value>;
    // Diagonally before the corner: over the top after 0.02 / 0.05 steps, before the side until
    // 0.04 / 0.05. Seen from where it meets, the gap is the way that is left to the side.
    const F f(F::at(-0.24, 0.22), F::at(0.05, -0.05));
    BOOST_TEST(f.meeting.disputed);
    BOOST_CHECK_CLOSE(f.meeting.after, 0.8, 0.5);  // the slack lets it come a little later
    BOOST_TEST_REQUIRE(!f.contacts.empty());
    for (const auto& c : f.contacts) {
        BOOST_CHECK_SMALL((c.normal - F::at(-1, 0)).norm(), 1e-12);
        BOOST_CHECK_SMALL(c.gap - 0.04, 1e-12);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_passes_over_is_no_contact_to_stop_at, D, dimensions) {
    using F = Flight<D::value>;
    const double gap = 0.01;
    const F f(F::at(-0.21, 0.2 + gap), F::at(0.05, 0.0));
    for (const auto& c : f.contacts) {
        BOOST_CHECK_SMALL(c.normal.dot(F::at(0.05, 0.0)), 1e-12);
        BOOST_CHECK_GT(c.gap, 0.0);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_comes_straight_keeps_its_nearest_points, D, dimensions) {
    using F = Flight<D::value>;
    const F f(F::at(0.0, 0.25), F::at(0.0, -0.06));
    BOOST_TEST(!f.meeting.disputed);
    BOOST_CHECK_EQUAL(f.contacts.size(), D::value == 2 ? 2u : 4u);
    for (const auto& c : f.contacts) {
        BOOST_CHECK_SMALL((c.normal - F::at(0, 1)).norm(), 1e-12);
        BOOST_CHECK_SMALL(c.gap - 0.05, 1e-12);
        BOOST_CHECK(c.slide.isZero(0.0));
    }
}

BOOST_AUTO_TEST_SUITE_END()
