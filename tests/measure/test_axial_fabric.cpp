// SPDX-License-Identifier: BSL-1.0
#include <talus/core/input.hpp>
#include <talus/measure/axial_fabric.hpp>
#include <talus/sample/random.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(measure_axial_fabric)

using talus::AxialHistogram;
using V = talus::Vector<3>;
constexpr double pi = std::numbers::pi;

V at_angle(double angle, double longitude = 0.3) {
    return {std::sin(angle) * std::cos(longitude), std::sin(angle) * std::sin(longitude),
            std::cos(angle)};
}

BOOST_AUTO_TEST_CASE(directions_and_their_opposites_fall_into_bands_of_the_angle) {
    AxialHistogram h(2.0 * V::UnitZ(), 3);
    h.add(at_angle(0.1));
    h.add(-3.0 * at_angle(0.1), 2.0);
    h.add(at_angle(pi / 2));  // the equator belongs to the last band
    h.add(at_angle(0.0));
    BOOST_CHECK_EQUAL(h.count(0), 4.0);
    BOOST_CHECK_EQUAL(h.count(1), 0.0);
    BOOST_CHECK_EQUAL(h.count(2), 1.0);
    BOOST_CHECK_EQUAL(h.total(), 5.0);
    BOOST_CHECK_CLOSE(h.middle(1), pi / 4, 1e-12);
    // The cap up to 30 degrees, 2 pi (1 - cos 30) of the half sphere.
    BOOST_CHECK_CLOSE(h.density(0), 4.0 / 5.0 / (2 * pi * (1 - std::sqrt(0.75))), 1e-12);
}

BOOST_AUTO_TEST_CASE(even_directions_prefer_none) {
    talus::Random random(3);
    AxialHistogram h(V(1.0, 2.0, -1.0), 6);
    const int n = 100000;
    for (int k = 0; k < n; ++k) {
        const double z = random.uniform(-1.0, 1.0), turn = random.uniform(0.0, 2 * pi);
        const double r = std::sqrt(1 - z * z);
        h.add(V(r * std::cos(turn), r * std::sin(turn), z));
    }
    // Four standard errors: (2 n + 1) sqrt(<P_n^2> / N) = sqrt((2 n + 1) / N), and of each count.
    BOOST_CHECK_SMALL(h.second(), 4 * std::sqrt(5.0 / n));
    BOOST_CHECK_SMALL(h.fourth(), 4 * std::sqrt(9.0 / n));
    for (std::size_t k = 0; k < 6; ++k)
        BOOST_CHECK_SMALL(2 * pi * h.density(k) - 1, 4 / std::sqrt(h.count(k)));
}

// Weights of 1 + a2 P2 + a4 P4 on a fine grid of equal solid angles are the density itself.
BOOST_AUTO_TEST_CASE(coefficients_and_the_peak_are_found) {
    const double a2 = 0.3, a4 = -0.8;
    AxialHistogram h(V::UnitX(), 9);
    const auto density = [&](double c) {
        const double s = c * c;
        return 1 + a2 * (1.5 * s - 0.5) + a4 * ((35 * s - 30) * s + 3) / 8;
    };
    const int n = 20000;
    for (int k = 0; k < n; ++k) {
        const double c = (k + 0.5) / n;
        h.add(V(c, std::sqrt(1 - c * c), 0.0), density(c));
    }
    BOOST_CHECK_CLOSE(h.second(), a2, 1e-5);
    BOOST_CHECK_CLOSE(h.fourth(), a4, 1e-5);
    BOOST_CHECK_CLOSE(h.fitted_density(0.4), density(std::cos(0.4)) / (2 * pi), 1e-5);
    double best = 0.0;
    for (int k = 0; k <= n; ++k)
        if (density(std::cos(0.5 * pi * k / n)) > density(std::cos(0.5 * pi * best / n))) best = k;
    BOOST_CHECK_CLOSE(h.peak(), 0.5 * pi * best / n, 0.02);
}

BOOST_AUTO_TEST_CASE(peaks_at_the_ends) {
    AxialHistogram upright(V::UnitZ(), 9), level(V::UnitZ(), 9);
    upright.add(V::UnitZ());
    level.add(V::UnitX());
    BOOST_CHECK_SMALL(upright.peak(), 1e-7);
    BOOST_CHECK_CLOSE(level.peak(), pi / 2, 1e-9);
    BOOST_CHECK_CLOSE(upright.second(), 5.0, 1e-12);
    BOOST_CHECK_CLOSE(level.second(), -2.5, 1e-12);
    BOOST_CHECK_EQUAL(AxialHistogram(V::UnitZ(), 2).second(), 0.0);
    BOOST_CHECK_EQUAL(AxialHistogram(V::UnitZ(), 2).density(0), 0.0);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_refused) {
    BOOST_CHECK_THROW(AxialHistogram(V::Zero(), 9), talus::input_error);
    BOOST_CHECK_THROW(AxialHistogram(V::UnitZ(), 1), talus::input_error);
    BOOST_CHECK_THROW(AxialHistogram(V(std::nan(""), 0, 1), 9), talus::input_error);
    AxialHistogram h(V::UnitZ(), 9);
    BOOST_CHECK_THROW(h.add(V::Zero()), talus::input_error);
    BOOST_CHECK_THROW(h.add(V(std::nan(""), 0, 0)), talus::input_error);
    BOOST_CHECK_EQUAL(h.total(), 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
