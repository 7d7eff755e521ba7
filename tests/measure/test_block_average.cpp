// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/block_average.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

BOOST_AUTO_TEST_SUITE(measure_block_average)

BOOST_AUTO_TEST_CASE(of_a_few_numbers) {
    talus::BlockAverage average;
    BOOST_TEST(average.mean() == 0.0);
    BOOST_TEST(std::isinf(average.error()));
    for (const double x : {1.0, 2.0, 3.0, 6.0}) average.add(x);
    BOOST_TEST(average.count() == 4u);
    BOOST_TEST(average.mean() == 3.0);
    BOOST_CHECK_CLOSE(average.deviation(), std::sqrt(14.0 / 3.0), 1e-12);
    BOOST_CHECK_CLOSE(average.error_from(0), std::sqrt(14.0 / 12.0), 1e-12);
    // Pairs: 1.5 and 4.5.
    BOOST_CHECK_CLOSE(average.error_from(1), 1.5, 1e-12);
    BOOST_TEST(std::isinf(average.error_from(2)));
    BOOST_CHECK_THROW(average.add(std::numeric_limits<double>::quiet_NaN()), talus::input_error);
    BOOST_TEST(average.count() == 4u);
}

// x' = phi x + noise remembers: the error is sqrt((1 + phi) / (1 - phi)) times the naive one.
BOOST_AUTO_TEST_CASE(a_series_with_a_memory) {
    std::mt19937_64 rng(11);
    std::normal_distribution<double> noise;
    for (const double phi : {0.0, 0.9}) {
        const int n = 1 << 17, series = 60;
        double squares = 0.0, told = 0.0, naive = 0.0;
        for (int k = 0; k < series; ++k) {
            talus::BlockAverage average;
            double x = noise(rng) / std::sqrt(1.0 - phi * phi);
            for (int i = 0; i < n; ++i) {
                average.add(x);
                x = phi * x + noise(rng);
            }
            squares += average.mean() * average.mean() / series;
            told += average.error(64) / series;
            naive += average.error_from(0) / series;
        }
        const double exact = 1.0 / (1.0 - phi) / std::sqrt(n);
        BOOST_TEST(std::abs(std::sqrt(squares) / exact - 1.0) < 0.3);
        // The largest over the lengths of blocks is some way above what it scatters around.
        BOOST_TEST(told / exact > 0.95);
        BOOST_TEST(told / exact < 1.25);
        BOOST_TEST(std::abs(naive / exact * std::sqrt((1.0 + phi) / (1.0 - phi)) - 1.0) < 0.05);
    }
}

BOOST_AUTO_TEST_SUITE_END()
