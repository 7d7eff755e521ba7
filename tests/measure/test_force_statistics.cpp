// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/force_statistics.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

BOOST_AUTO_TEST_SUITE(measure_force_statistics)

BOOST_AUTO_TEST_CASE(equal_forces_have_no_spread) {
    const std::vector<double> f(7, 3.0);
    const auto s = talus::force_statistics(f);
    BOOST_TEST(s.count == 7u);
    BOOST_TEST(s.mean == 3.0);
    BOOST_TEST(s.largest == 3.0);
    BOOST_TEST(s.share_below_mean == 0.0);
    BOOST_TEST(s.decay == 0.0);
    BOOST_CHECK_SMALL(s.gini, 1e-15);
}

// exp(-f): the mean excess over the mean is the mean, 1 - 1/e lie below it, Gini's coefficient is a
// half.
BOOST_AUTO_TEST_CASE(exponential_forces_are_recognised) {
    constexpr int n = 200000;
    std::vector<double> f;
    for (int k = 0; k < n; ++k) f.push_back(-5.0 * std::log(1.0 - (k + 0.5) / n));
    f.push_back(0.0);
    f.push_back(-2.0);
    const auto s = talus::force_statistics(f);
    BOOST_TEST(s.count == static_cast<std::size_t>(n));
    BOOST_CHECK_CLOSE(s.mean, 5.0, 1e-3);
    BOOST_CHECK_CLOSE(s.share_below_mean, 1.0 - std::exp(-1.0), 1e-2);
    BOOST_CHECK_CLOSE(s.decay, 1.0, 1e-2);
    BOOST_CHECK_CLOSE(s.decay_error, 1.0 / std::sqrt(n * std::exp(-1.0)), 0.1);
    BOOST_CHECK_CLOSE(s.gini, 0.5, 1e-2);
    const auto density = talus::force_density(f, 40, 4.0);
    BOOST_CHECK_CLOSE(std::accumulate(density.begin(), density.end(), 0.0) * 0.1,
                      1.0 - std::exp(-4.0), 1e-2);
    for (std::size_t k = 0; k < 40; ++k) {
        const double low = 0.1 * static_cast<double>(k);
        BOOST_CHECK_CLOSE(density[k], 10.0 * (std::exp(-low) - std::exp(-low - 0.1)), 0.5);
    }
}

BOOST_AUTO_TEST_CASE(one_that_has_all) {
    std::vector<double> f(1000, 1e-9);
    f.back() = 1.0;
    BOOST_TEST(talus::force_statistics(f).gini > 0.99);
    BOOST_TEST(talus::force_statistics(std::vector<double>{}).count == 0u);
    BOOST_TEST(talus::force_statistics(std::vector<double>{-1.0, 0.0}).mean == 0.0);
}

BOOST_AUTO_TEST_CASE(what_is_no_force_is_refused) {
    const std::vector<double> f{1.0, std::numeric_limits<double>::quiet_NaN()};
    BOOST_CHECK_THROW(talus::force_statistics(f), talus::input_error);
    BOOST_CHECK_THROW(talus::force_density(f, 10, 4.0), talus::input_error);
    BOOST_CHECK_THROW(talus::force_density(std::vector<double>{1.0}, 0, 4.0), talus::input_error);
    BOOST_CHECK_THROW(talus::force_density(std::vector<double>{1.0}, 10, 0.0), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
