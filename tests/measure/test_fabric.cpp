// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/fabric.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(measure_fabric)

using talus::DirectionHistogram;
constexpr double pi = std::numbers::pi;

talus::Vector<2> direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

BOOST_AUTO_TEST_CASE(directions_fall_into_their_sectors) {
    DirectionHistogram h(4);
    h.add(direction(0.1));
    h.add(direction(pi / 2 + 0.1), 2.0);
    h.add(direction(-0.1), 3.0);
    h.add(talus::Vector<2>(1.0, -0.0));
    BOOST_CHECK_EQUAL(h.count(0), 2.0);
    BOOST_CHECK_EQUAL(h.count(1), 2.0);
    BOOST_CHECK_EQUAL(h.count(2), 0.0);
    BOOST_CHECK_EQUAL(h.count(3), 3.0);
    BOOST_CHECK_CLOSE(h.density(3), 3.0 / 7.0 / (pi / 2), 1e-12);
    h.add_normal(direction(0.2));
    BOOST_CHECK_EQUAL(h.count(2), 1.0);
    BOOST_CHECK_EQUAL(h.total(), 9.0);
}

BOOST_AUTO_TEST_CASE(a_harmonic_is_found_with_its_direction) {
    // The exact content of each sector of (1 + a cos n (t - t0)) / (2 pi).
    const double a = 0.3, t0 = 0.4;
    const int n = 2;
    DirectionHistogram h(24);
    for (std::size_t k = 0; k < 24; ++k) {
        const double low = 2 * pi * static_cast<double>(k) / 24, high = low + 2 * pi / 24;
        const double content =
            high - low + a / n * (std::sin(n * (high - t0)) - std::sin(n * (low - t0)));
        h.add(direction(h.middle(k)), content);
    }
    const auto found = talus::fit_harmonic(h, n);
    BOOST_CHECK_CLOSE(found.amplitude, a, 1e-10);
    BOOST_CHECK_CLOSE(found.direction, t0, 1e-10);
    BOOST_CHECK_SMALL(talus::fit_harmonic(h, 4).amplitude, 1e-12);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_fitted_is_refused) {
    BOOST_CHECK_THROW(DirectionHistogram(2), talus::input_error);
    DirectionHistogram h(24);
    BOOST_CHECK_THROW(talus::fit_harmonic(h, 2), talus::input_error);
    h.add(direction(1.0));
    BOOST_CHECK_THROW(talus::fit_harmonic(h, 0), talus::input_error);
    BOOST_CHECK_THROW(talus::fit_harmonic(h, 12), talus::input_error);
    BOOST_CHECK_NO_THROW(talus::fit_harmonic(h, 11));
}

BOOST_AUTO_TEST_SUITE_END()
