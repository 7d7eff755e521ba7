// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/granulometry.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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
    check_radius_law(talus::LogNormalRadii(0.005, 0.3, 0.003, 0.009));
    check_radius_law(talus::LogNormalRadii(0.005, 2.0, 0.004, 0.02));
    check_radius_law(talus::SieveCurve<2>({{0.003, 0.0}, {0.005, 0.4}, {0.009, 1.0}}));
    check_radius_law(
        talus::SieveCurve<3>({{0.003, 0.0}, {0.003, 0.2}, {0.005, 0.2}, {0.006, 1.0}}));
}

template <int Dim>
void sieve(double at, double expected) {
    const talus::SieveCurve<Dim> law(
        {{1.0, 0.0}, {1.0, 0.1}, {2.0, 0.4}, {3.0, 0.4}, {5.0, 0.9}, {5.0, 1.0}});
    constexpr int draws = 200000, lots = 20;
    talus::Random random(3);
    // Shares of the mass in lots, whose scatter says how far their mean may be off.
    double sum = 0.0, squares = 0.0;
    for (int lot = 0; lot < lots; ++lot) {
        double below = 0.0, all = 0.0;
        for (int k = 0; k < draws / lots; ++k) {
            const double r = law(random), mass = std::pow(r, Dim);
            all += mass;
            below += r <= at ? mass : 0.0;
        }
        sum += below / all;
        squares += below / all * (below / all);
    }
    const double mean = sum / lots;
    const double error = std::sqrt((squares / lots - mean * mean) / (lots - 1));
    BOOST_TEST(std::abs(mean - expected) < 5.0 * error + 1e-3);
    BOOST_TEST(error < 0.01);
}
BOOST_AUTO_TEST_CASE(a_sieve_passes_the_mass_that_the_curve_says) {
    for (const auto& [at, share] :
         {std::pair{1.0, 0.1}, {1.5, 0.25}, {2.5, 0.4}, {4.0, 0.65}, {4.999999, 0.9}}) {
        sieve<2>(at, share);
        sieve<3>(at, share);
    }
}

BOOST_AUTO_TEST_CASE(half_of_a_log_normal_law_is_below_its_median) {
    const talus::LogNormalRadii law(0.02, 0.5, 1e-4, 4.0);
    talus::Random random(8);
    int below_median = 0, below_one_deviation = 0;
    constexpr int draws = 100000;
    for (int k = 0; k < draws; ++k) {
        const double r = law(random);
        below_median += r < 0.02 ? 1 : 0;
        below_one_deviation += r < 0.02 * std::exp(0.5) ? 1 : 0;
    }
    BOOST_TEST(std::abs(below_median - 0.5 * draws) < 5.0 * std::sqrt(0.25 * draws));
    BOOST_TEST(std::abs(below_one_deviation - 0.841344746 * draws) <
               5.0 * std::sqrt(0.134 * draws));
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
    BOOST_CHECK_THROW(talus::LogNormalRadii(1.0, 0.0, 0.5, 2.0), talus::input_error);
    BOOST_CHECK_THROW(talus::LogNormalRadii(1.0, 0.1, 5.0, 6.0), talus::input_error);  // 16 sigma
    BOOST_CHECK_THROW(talus::LogNormalRadii(nan, 0.1, 0.5, 2.0), talus::input_error);
    using Points = std::vector<talus::SieveCurve<3>::Point>;
    for (const Points& points : {Points{}, Points{{1.0, 0.0}}, Points{{1.0, 0.1}, {2.0, 1.0}},
                                 Points{{1.0, 0.0}, {2.0, 0.9}}, Points{{0.0, 0.0}, {2.0, 1.0}},
                                 Points{{1.0, 0.0}, {0.5, 1.0}}, Points{{1.0, 0.0}, {nan, 1.0}},
                                 Points{{1.0, 0.0}, {2.0, 0.6}, {3.0, 0.5}, {4.0, 1.0}},
                                 Points{{1.0, 0.0}, {2.0, nan}, {3.0, 1.0}}})
        BOOST_CHECK_THROW(talus::SieveCurve<3>{points}, talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
