// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/random_scene.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"

using talus::Vector;

BOOST_AUTO_TEST_SUITE(sample_lattice)

BOOST_AUTO_TEST_CASE_TEMPLATE(balls_of_the_largest_radius_fit_apart_and_in_the_box, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(31);
    const double r = 0.006, width = 0.05;
    const auto places =
        talus::jittered_lattice<Dim>(random, {.count = 60,
                                              .box_size = Vector<Dim>::Constant(width),
                                              .largest_radius = r,
                                              .looseness = 0.1});
    BOOST_REQUIRE(places.size() == 60u);
    for (std::size_t b = 0; b < places.size(); ++b) {
        BOOST_TEST((places[b].array() >= r).all());
        BOOST_TEST((places[b].template head<Dim - 1>().array() <= width - r).all());
        for (std::size_t a = 0; a < b; ++a) BOOST_REQUIRE((places[a] - places[b]).norm() > 2.0 * r);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_lattice_is_disordered, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(32);
    const auto places =
        talus::jittered_lattice<Dim>(random, {.count = 2,
                                              .box_size = Vector<Dim>::Constant(1.0),
                                              .largest_radius = 0.1,
                                              .looseness = 0.2});
    BOOST_TEST(places[0][Dim - 1] != places[1][Dim - 1]);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_box_too_narrow_for_a_grain_is_refused, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Random random(33);
    BOOST_CHECK_THROW(
        talus::jittered_lattice<Dim>(
            random, {.count = 2, .box_size = Vector<Dim>::Constant(0.1), .largest_radius = 0.1}),
        talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(scenes_hold_what_was_asked_for, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::UniformRadii law(0.004, 0.006);
    const auto scene = talus::random_scene<Dim>({.grain_count = 100, .width = 0.1, .seed = 5}, law);
    BOOST_TEST(scene.grains.size() == 100u);
    BOOST_TEST(scene.mean_radius == 0.005);
    BOOST_TEST(scene.box_size[0] == 0.1);
    BOOST_TEST(!std::isfinite(scene.box_size[Dim - 1]));
    for (const auto& g : scene.grains) BOOST_TEST(g.is_ball());
    const auto again = talus::random_scene<Dim>({.grain_count = 100, .width = 0.1, .seed = 5}, law);
    BOOST_TEST((again.grains[99].position == scene.grains[99].position));
    BOOST_CHECK_THROW(talus::random_scene<Dim>({.density = 0.0}, law), talus::input_error);
    BOOST_CHECK_THROW(talus::random_scene<Dim>({.width = -1.0}, law), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
