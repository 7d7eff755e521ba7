// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "examples/lab/measures/fits.hpp"

BOOST_AUTO_TEST_SUITE(lab_fits)

const std::vector<double> x{1.0, 2.0, 3.5, 5.0, 8.0, 13.0};

template <class F>
std::vector<double> values(F f) {
    std::vector<double> y;
    for (const double v : x) y.push_back(f(v));
    return y;
}

BOOST_AUTO_TEST_CASE(a_power_law_is_found) {
    const auto fit = lab::fit_power(x, values([](double v) { return 0.7 * std::pow(v, 1.5); }));
    BOOST_CHECK_CLOSE(fit.factor, 0.7, 1e-10);
    BOOST_CHECK_CLOSE(fit.exponent, 1.5, 1e-10);
    BOOST_CHECK_CLOSE(fit.r_squared, 1.0, 1e-10);
    BOOST_CHECK_CLOSE(fit(4.0), 5.6, 1e-10);
    BOOST_CHECK_THROW(lab::fit_power(x, values([](double v) { return v - 2.0; })),
                      talus::input_error);
    BOOST_CHECK_THROW(lab::fit_power(x, x, 1.0), talus::input_error);
}

BOOST_AUTO_TEST_CASE(an_offset_is_found_among_those_tried) {
    const auto y = values([](double v) { return 2.0 * std::pow(v + 0.5, 2.5); });
    const auto fit = lab::fit_offset_power(x, y, -1.0, 0.5);
    BOOST_CHECK_SMALL(fit.offset + 0.5, 0.0151);  // they are 0.015 apart
    BOOST_CHECK_CLOSE(fit.exponent, 2.5, 1.0);
}

BOOST_AUTO_TEST_CASE(a_saturation_is_found_from_far) {
    for (const double limit : {0.4, 3.0, 40.0}) {
        const auto fit = lab::fit_saturation(
            x, values([&](double v) { return -limit * std::expm1(-v / limit); }));
        BOOST_CHECK_CLOSE(fit.limit, limit, 1e-6);
        BOOST_CHECK_CLOSE(fit.r_squared, 1.0, 1e-6);
        BOOST_CHECK_SMALL(fit.error, 1e-5 * limit);
    }
    BOOST_CHECK_THROW(lab::fit_saturation({{1.0}}, {{1.0}}), talus::input_error);
    BOOST_CHECK_THROW(lab::fit_saturation(x, values([](double) { return -1.0; })),
                      talus::input_error);
}

// The error is the spread that scatter of the ordinates gives the limit.
BOOST_AUTO_TEST_CASE(the_error_of_a_saturation_follows_the_scatter) {
    const double limit = 3.0, scatter = 1e-3;
    double sum = 0.0, error = 0.0;
    const int samples = 400;
    unsigned state = 1;
    for (int k = 0; k < samples; ++k) {
        const auto fit = lab::fit_saturation(
            x, values([&](double v) {
                double noise = -6.0;  // of twelve even numbers: nearly normal, of variance 1
                for (int i = 0; i < 12; ++i) {
                    state = 1664525u * state + 1013904223u;
                    noise += state / 4294967296.0;
                }
                return -limit * std::expm1(-v / limit) + scatter * noise;
            }));
        sum += (fit.limit - limit) * (fit.limit - limit) / samples;
        error += fit.error * fit.error / samples;
    }
    BOOST_CHECK_CLOSE(std::sqrt(sum), std::sqrt(error), 15.0);
}

BOOST_AUTO_TEST_SUITE_END()
