// SPDX-License-Identifier: BSL-1.0
// Where bodies get to if contacts hold them up, against what can be told by hand.
#include <talus/assembly/stopped_motion.hpp>

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <vector>

#include "common/dimensions.hpp"
#include "common/in_plane.hpp"

BOOST_AUTO_TEST_SUITE(assembly_stopped_motion)

template <int Dim>
struct Scene {
    using Vec = talus::Vector<Dim>;
    static Vec at(double x, double y) { return in_plane<Dim>(x, y); }

    talus::Bodies<Dim> bodies;
    std::vector<talus::Twist<Dim>> free;
    talus::StoppedMotion<Dim> motion;

    talus::BodyIndex add(double mass, const Vec& position, const Vec& way) {
        free.push_back({way, talus::AngularVector<Dim>::Zero()});
        return bodies.add({mass, talus::AngularVector<Dim>::Constant(mass)}, {position, {}});
    }
    talus::BodyIndex add_floor() {
        free.push_back({});
        return bodies.add_obstacle({});
    }
    void begin() { motion.begin(bodies, free); }
    bool stop(talus::BodyIndex a, talus::BodyIndex b, double gap) {
        return motion.add(a, b, {bodies.position[static_cast<std::size_t>(a)], at(0, 1), gap, {}},
                          1e-12);
    }
    Vec way(talus::BodyIndex i) const { return motion.motion(i).linear; }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_floor_takes_what_goes_into_it, D, dimensions) {
    Scene<D::value> s;
    const auto floor = s.add_floor(), box = s.add(2.0, s.at(0, 1), s.at(0.05, -0.05));
    s.begin();
    s.motion.release(box);
    s.motion.release(floor);
    BOOST_TEST(!s.motion.is_released(floor));
    BOOST_TEST(s.stop(box, floor, 0.01));
    s.motion.settle(box);
    // The gap may be used up in the two steps that are looked ahead.
    BOOST_CHECK_SMALL((s.way(box) - s.at(0.05, -0.005)).norm(), 1e-15);
    BOOST_TEST(s.motion.is_changed(box));
    BOOST_TEST(!s.motion.is_changed(floor));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_goes_away_is_left_alone, D, dimensions) {
    Scene<D::value> s;
    const auto floor = s.add_floor(), box = s.add(2.0, s.at(0, 1), s.at(0.0, -0.004));
    s.begin();
    s.motion.release(box);
    BOOST_TEST(!s.stop(box, floor, 0.01));
    s.motion.settle(box);
    BOOST_TEST(!s.motion.is_changed(box));
    BOOST_CHECK(s.way(box) == s.at(0.0, -0.004));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_share_by_their_masses_once_released, D, dimensions) {
    for (bool both : {true, false}) {
        Scene<D::value> s;
        const auto low = s.add(3.0, s.at(0, 0), s.at(0, 0)),
                   high = s.add(1.0, s.at(0, 1), s.at(0, -0.04));
        s.begin();
        s.motion.release(high);
        if (both) s.motion.release(low);
        BOOST_TEST(s.stop(high, low, 0.0));
        s.motion.settle(high);
        // Carried by what is not released as by a floor.
        const double common = both ? -0.01 : 0.0;
        BOOST_CHECK_SMALL((s.way(high) - s.at(0, common)).norm(), 1e-15);
        BOOST_CHECK_SMALL((s.way(low) - s.at(0, common)).norm(), 1e-15);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(turns_count_as_long_as_they_can_be_foreseen, D, dimensions) {
    constexpr int Dim = D::value;
    for (double turn : {0.5, 3.0}) {
        Scene<Dim> s;
        const auto floor = s.add_floor(), box = s.add(1.0, s.at(0, 1), s.at(0, 0));
        // About the axis that takes the first direction into the last.
        talus::AngularVector<Dim> axis = talus::AngularVector<Dim>::Zero();
        axis[Dim == 2 ? 0 : 1] = Dim == 2 ? 1.0 : -1.0;
        s.free.back().angular = -turn * axis;
        s.begin();
        s.motion.release(box);
        const bool held = s.motion.add(box, floor, {s.at(0.1, 1), s.at(0, 1), 0.0, {}}, 1e-12);
        BOOST_TEST(held == (turn < 1.0));
        s.motion.settle(box);
        BOOST_CHECK_SMALL(s.way(box)[Dim - 1] - (turn < 1.0 ? 0.1 * turn : 0.0), 1e-15);
    }
}

BOOST_AUTO_TEST_SUITE_END()
