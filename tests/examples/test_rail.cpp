// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "examples/lab/masonry/rail.hpp"

BOOST_AUTO_TEST_SUITE(lab_rail)

std::vector<double> shares(const lab::Rail& rail, double x, const std::vector<double>& heights) {
    std::vector<double> found = rail.forces(1.0, x, heights);
    for (double& f : found) f = -f;
    return found;
}

BOOST_AUTO_TEST_CASE(between_two_supports_it_is_a_lever) {
    const lab::Rail rail({1.0, 3.0}, 5.0, 7.0);
    const auto share = shares(rail, 1.5, {0.0, 0.0});
    BOOST_CHECK_CLOSE(share[0], 0.75, 1e-9);
    BOOST_CHECK_CLOSE(share[1], 0.25, 1e-9);
}

// Stiff against its pads: a rigid bar on springs, whose shares are 1/n + x x_i / sum x_j^2.
BOOST_AUTO_TEST_CASE(a_stiff_rail_spreads_as_a_rigid_bar) {
    const lab::Rail rail({-2.0, -1.0, 0.0, 1.0, 2.0}, 1e9, 1.0);
    const double x = 0.7;
    const auto share = shares(rail, x, std::vector<double>(5, 0.0));
    for (int i = 0; i < 5; ++i)
        BOOST_CHECK_CLOSE(share[static_cast<std::size_t>(i)], 0.2 + x * (i - 2) / 10.0, 1e-3);
}

// Soft against its pads: a beam on rigid supports. Three of them at 0, l, 2 l, the load in the
// middle of the first span: 13/32, 22/32, -3/32 (Clapeyron's three moments).
BOOST_AUTO_TEST_CASE(on_rigid_supports_it_is_a_continuous_beam) {
    const lab::Rail rail({0.0, 1.0, 2.0}, 1.0, 1e9);
    const auto share = shares(rail, 0.5, std::vector<double>(3, 0.0));
    BOOST_CHECK_CLOSE(share[0], 13.0 / 32.0, 1e-4);
    BOOST_CHECK_CLOSE(share[1], 22.0 / 32.0, 1e-4);
    BOOST_CHECK_CLOSE(share[2], -3.0 / 32.0, 1e-4);
}

BOOST_AUTO_TEST_CASE(a_long_one_on_close_pads_is_zimmermanns) {
    const double spacing = 0.1, bending = 50.0, pad = 40.0;  // length (4 EI a / k)^(1/4) = 0.84
    std::vector<double> places;
    for (int i = -100; i <= 100; ++i) places.push_back(i * spacing);
    const lab::Rail rail(places, bending, pad);
    const auto share = shares(rail, 0.0, std::vector<double>(places.size(), 0.0));
    for (int i = 0; i < 30; ++i)
        BOOST_CHECK_SMALL(share[static_cast<std::size_t>(100 + i)] -
                              lab::zimmermann_share(i * spacing, spacing, bending, pad),
                          1e-4 * share[100]);
}

BOOST_AUTO_TEST_CASE(it_carries_all_of_the_load_wherever_the_supports_are) {
    lab::Rail rail({0.0, 0.6, 1.5, 2.0}, 3.0, 20.0);
    rail.fasten({0.0, 0.01, 0.0, 0.0});
    const std::vector<double> heights{0.0, -0.02, 0.03, 0.0};
    for (const double x : {0.0, 0.1, 1.5, 2.0}) {
        const auto force = rail.forces(11.0, x, heights);
        double sum = 0.0, moment = 0.0;
        const std::vector<double> at{0.0, 0.6, 1.5, 2.0};
        for (std::size_t i = 0; i < 4; ++i) sum += force[i], moment += force[i] * at[i];
        BOOST_CHECK_CLOSE(sum, -11.0, 1e-9);
        BOOST_CHECK_SMALL(moment + 11.0 * x, 1e-9);
    }
    // Unloaded and where it was laid it is without stress.
    for (const double f : rail.forces(0.0, 1.0, rail.laid())) BOOST_CHECK_SMALL(f, 1e-12);
    BOOST_CHECK_THROW(rail.forces(1.0, 2.1, heights), talus::input_error);
    BOOST_CHECK_THROW(rail.fasten({0.0}), talus::input_error);
    BOOST_CHECK_THROW(lab::Rail({1.0, 1.0}, 1.0, 1.0), talus::input_error);
    BOOST_CHECK_THROW(lab::Rail({0.0, 1.0}, 0.0, 1.0), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
