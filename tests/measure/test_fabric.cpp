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

// Two oblique preferred directions, as in deposits: peaks on both sides of the vertical.
BOOST_AUTO_TEST_CASE(the_fit_finds_peaks_on_both_sides) {
    const talus::FabricFit given{{{2, 0.05, pi / 2}, {4, 0.2, pi / 4}}};
    DirectionHistogram h(24);
    for (std::size_t k = 0; k < 24; ++k)
        for (int j = 0; j < 200; ++j) {
            const double angle = h.middle(k) + ((j + 0.5) / 200 - 0.5) * 2 * pi / 24;
            h.add(direction(angle), given.density(angle));
        }
    const talus::FabricFit fit = talus::fit_fabric(h);
    BOOST_REQUIRE(fit.terms.size() == 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        BOOST_CHECK_CLOSE(fit.terms[k].amplitude, given.terms[k].amplitude, 0.01);
        BOOST_CHECK_CLOSE(fit.terms[k].direction, given.terms[k].direction, 0.01);
    }
    const auto peaks = fit.peaks();
    BOOST_REQUIRE(peaks.size() == 2u);
    BOOST_CHECK_CLOSE(peaks[0] + peaks[1], pi, 1e-6);
    // There 2 a2 sin 2(x - pi/2) + 4 a4 sin 4(x - pi/4) = 0.
    for (const double x : peaks) {
        const double slope =
            2 * 0.05 * std::sin(2 * (x - pi / 2)) + 4 * 0.2 * std::sin(4 * (x - pi / 4));
        BOOST_CHECK_SMALL(slope, 1e-5);
        BOOST_TEST(fit.density(x) > fit.density(pi / 2));
    }
    BOOST_TEST((talus::FabricFit{{{2, 0.1, 0.0}}}).peaks().front() == 0.0);
    for (const int odd : {0, 1, 3})
        BOOST_CHECK_THROW(talus::fit_fabric(h, odd), talus::input_error);
}

// Directions of density (1 + n . a n) / (2 pi), / (4 pi), on equal parts of circle and sphere.
BOOST_AUTO_TEST_CASE(the_tensor_gives_the_anisotropy_back) {
    talus::Matrix<2> a2;
    a2 << 0.2, 0.1, 0.1, -0.2;
    talus::FabricTensor<2> plane;
    for (int k = 0; k < 1000; ++k) {
        const talus::Vector<2> n = direction((k + 0.5) * pi / 500);
        plane.add(n, 1.0 + n.dot(a2 * n));
    }
    BOOST_CHECK_SMALL((plane.anisotropy() - a2).norm(), 1e-12);
    BOOST_CHECK_CLOSE(plane.tensor().trace(), 1.0, 1e-12);
    talus::Matrix<3> a3;
    a3 << 0.2, 0.1, 0.0, 0.1, -0.3, 0.05, 0.0, 0.05, 0.1;
    talus::FabricTensor<3> space;
    const int parts = 200;
    for (int i = 0; i < parts; ++i)
        for (int k = 0; k < parts; ++k) {
            const double z = (i + 0.5) / parts * 2.0 - 1.0, turn = (k + 0.5) / parts * 2.0 * pi;
            const double r = std::sqrt(1.0 - z * z);
            const talus::Vector<3> n(r * std::cos(turn), r * std::sin(turn), z);
            space.add(n, 1.0 + n.dot(a3 * n));
        }
    BOOST_CHECK_SMALL((space.anisotropy() - a3).norm(), 1e-3);
    BOOST_CHECK_THROW(talus::FabricTensor<3>().tensor(), talus::input_error);
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
