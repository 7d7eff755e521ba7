// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "examples/pile/recorder.hpp"
#include "examples/pile/verdict.hpp"

BOOST_AUTO_TEST_SUITE(examples_verdict)

/// A grain of 1 N that fell 1 m, was stopped, and lies for ten steps of 0.1 s.
pile::Figures grain_at_rest() {
    pile::Figures f;
    f.dim = 2;
    f.grains = 1;
    f.tolerance = 1e-3;
    f.h = 0.1;
    f.mean_radius = 0.1;
    f.mass = 0.1;
    f.weight = 1.0;
    f.potential_start = 1.0;
    f.given = {.friction = -0.25, .impacts = -0.75};
    f.overlap = {0.01, 0.2, 2, "the floor", "grain 1"};
    for (int k = 1; k <= 10; ++k)
        f.steps.push_back({0.1 * k, 1, 3, 1e-4, 0.0, 0.0, -0.25, -0.75, 0.001, 0.001, 1.0, 0.0});
    return f;
}

void check_said(const pile::Figures& f, const std::string& words) {
    const auto said = pile::impossible_in(f);
    BOOST_REQUIRE_EQUAL(said.size(), 1u);
    BOOST_TEST(said[0].find(words) != std::string::npos, said[0]);
    BOOST_TEST(!pile::certified(f));
}

BOOST_AUTO_TEST_CASE(a_grain_at_rest_is_certified) {
    BOOST_TEST(pile::impossible_in(grain_at_rest()).empty());
    BOOST_TEST(pile::certified(grain_at_rest()));
}

BOOST_AUTO_TEST_CASE(a_missed_tolerance_and_an_early_end_are_not_certified) {
    auto f = grain_at_rest();
    f.missed = 1;
    BOOST_TEST(pile::impossible_in(f).empty());
    BOOST_TEST(!pile::certified(f));
    f = grain_at_rest();
    f.failure = "out of memory";
    BOOST_TEST(!pile::certified(f));
}

// Moreau's laws let friction and impacts take energy only. A square of 2 m on five of 2 mm once was
// said to be lifted by friction, by 53 J.
BOOST_AUTO_TEST_CASE(friction_and_impacts_that_give_energy_are_impossible) {
    auto f = grain_at_rest();
    f.given.friction = 53.0;
    check_said(f, "Friction gave 53 J");
    f.given.friction = std::nan("");
    check_said(f, "Friction gave nan J");
    f = grain_at_rest();
    f.given.impacts = 0.1;
    check_said(f, "Impacts gave 0.1 J");
}

BOOST_AUTO_TEST_CASE(what_steps_make_of_energy_by_rounding_is_possible) {
    auto f = grain_at_rest();
    f.given.friction = 1e-6;
    BOOST_TEST(pile::certified(f));
}

BOOST_AUTO_TEST_CASE(a_deep_overlap_is_named_with_its_step_and_bodies) {
    auto f = grain_at_rest();
    f.overlap.value = 0.3;
    check_said(f, "In step 2 the floor and grain 1 overlapped by 30 %");
}

BOOST_AUTO_TEST_CASE(a_floor_that_carries_too_little_is_impossible) {
    auto f = grain_at_rest();
    f.steps.back().reaction_over_weight = 0.9;
    check_said(f, "The floor carried 0.9 of the weight");
    f.steps.back().momentum_up = -0.01;  // it is falling: 0.1 N for 0.1 s
    BOOST_TEST(pile::certified(f));
}

BOOST_AUTO_TEST_CASE(energy_books_that_do_not_close_are_impossible) {
    auto f = grain_at_rest();
    f.energy_missing = 0.01;
    f.energy_closure = 0.01;
    check_said(f, "The energy books miss 0.01 J");
    f.energy_missing = std::nan("");
    check_said(f, "The energy books miss nan J");
}

BOOST_AUTO_TEST_CASE(rounding_of_the_height_of_a_heavy_body_is_no_fault) {
    auto f = grain_at_rest();
    f.potential_start = 1e5;
    f.given = {};
    for (auto& s : f.steps) {
        s.friction = s.impacts = 0.0;
        s.potential = 1e5;
    }
    f.energy_missing = 1e-11;
    BOOST_TEST(pile::certified(f));
    f.energy_missing = 1e-8;
    check_said(f, "The energy books miss");
}

BOOST_AUTO_TEST_CASE(nothing_is_wrong_with_a_run_in_which_nothing_happens) {
    auto f = grain_at_rest();
    f.weight = f.potential_start = 0.0;
    f.given = {};
    for (auto& s : f.steps) s.friction = s.impacts = s.reaction_over_weight = 0.0;
    BOOST_TEST(pile::certified(f));
}

BOOST_AUTO_TEST_CASE(bodies_have_names_that_people_know) {
    BOOST_TEST(pile::name_of(0, 2) == "the floor");
    BOOST_TEST(pile::name_of(1, 2) == "the wall at x = 0");
    BOOST_TEST(pile::name_of(2, 2) == "the wall opposite x = 0");
    BOOST_TEST(pile::name_of(3, 2) == "grain 1");
    BOOST_TEST(pile::name_of(3, 3) == "the wall at y = 0");
    BOOST_TEST(pile::name_of(4, 3) == "the wall opposite y = 0");
    BOOST_TEST(pile::name_of(5, 3) == "grain 1");
    BOOST_TEST(pile::name_of(talus::RunSummary::no_body, 3) == "");
}

BOOST_AUTO_TEST_SUITE_END()
