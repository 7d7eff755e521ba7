// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/granulometry.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

BOOST_AUTO_TEST_SUITE(sample_granulometry)

/// Checks of any law of radii: range, mean, and that the largest and smallest are approached.
template <talus::RadiusLaw Law>
void check_radius_law(const Law& law) {
    constexpr int draws = 100000;
    talus::Random random(11);
    const double low = law.low_end(), high = law.high_end();
    double sum = 0.0, smallest = high, largest = low;
    for (int i = 0; i < draws; ++i) {
        const double r = law(random);
        sum += r;
        smallest = std::min(smallest, r);
        largest = std::max(largest, r);
    }
    BOOST_TEST(smallest >= low);
    BOOST_TEST(largest <= high);
    // A variable in [low, high] has at most the deviation (high - low) / 2; five of the mean's, and
    // the rounding of a sum of that many numbers.
    const double bound = 2.5 * (high - low) / std::sqrt(draws) + 1e-16 * draws * high;
    BOOST_TEST(std::abs(sum / draws - law.mean()) <= bound);
    BOOST_TEST(smallest <= low + 0.01 * (high - low));
    BOOST_TEST(largest >= high - 0.01 * (high - low));
}

BOOST_AUTO_TEST_CASE(every_law_keeps_its_range_and_mean) {
    check_radius_law(talus::UniformRadii(0.004, 0.006));
    check_radius_law(talus::UniformRadii(0.005, 0.005));
    for (const double exponent : {0.0, 0.5, 1.0, 2.0, 4.0})
        check_radius_law(talus::PowerLawRadii(0.003, 0.009, exponent));
}

BOOST_AUTO_TEST_CASE(exponent_zero_is_the_uniform_law) {
    talus::Random a(5), b(5);
    const talus::UniformRadii uniform(1.0, 3.0);
    const talus::PowerLawRadii power(1.0, 3.0, 0.0);
    for (int i = 0; i < 100; ++i) BOOST_TEST(std::abs(uniform(a) - power(b)) < 1e-15 * 16);
    BOOST_TEST(std::abs(uniform.mean() - power.mean()) < 1e-15 * 16);
}

BOOST_AUTO_TEST_CASE(the_share_below_a_radius_is_that_of_the_density) {
    // Density r^-4 on [1, 2]: the share below x is (1 - x^-3) / (1 - 1/8).
    const talus::PowerLawRadii law(1.0, 2.0, 4.0);
    constexpr int draws = 100000;
    talus::Random random(6);
    int below = 0;
    for (int i = 0; i < draws; ++i) below += law(random) < 1.25;
    const double share = (1.0 - std::pow(1.25, -3)) / (1.0 - 0.125);
    BOOST_TEST(std::abs(static_cast<double>(below) / draws - share) <
               5.0 * std::sqrt(share * (1.0 - share) / draws));
}

BOOST_AUTO_TEST_CASE(wrong_radii_are_refused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(talus::UniformRadii(0.0, 1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::UniformRadii(2.0, 1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::UniformRadii(1.0, nan), talus::input_error);
    BOOST_CHECK_THROW(talus::PowerLawRadii(1.0, 2.0, -1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::PowerLawRadii(1.0, 2.0, nan), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
