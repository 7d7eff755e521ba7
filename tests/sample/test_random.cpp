// SPDX-License-Identifier: BSL-1.0
#include <talus/sample/random.hpp>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>

BOOST_AUTO_TEST_SUITE(sample_random)

BOOST_AUTO_TEST_CASE(bits_follow_from_the_engine_of_the_standard) {
    // [rand.predef]: the 10000th number of a default-constructed mt19937_64 (seed 5489).
    talus::Random random(5489);
    for (int i = 1; i < 10000; ++i) random.uniform();
    BOOST_TEST(random.uniform() == static_cast<double>(9981545732273789042ull >> 11) / 0x1p53);
}

BOOST_AUTO_TEST_CASE(equal_seeds_give_equal_numbers_and_others_do_not) {
    talus::Random a(7), b(7), c(8);
    const double x = a.uniform();
    BOOST_TEST(x == b.uniform());
    BOOST_TEST(x != c.uniform());
}

BOOST_AUTO_TEST_CASE(uniform_numbers_have_the_moments_of_the_uniform_law) {
    constexpr int draws = 100000;
    talus::Random random(1);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < draws; ++i) {
        const double x = random.uniform(2.0, 5.0);
        BOOST_REQUIRE(x >= 2.0);
        BOOST_REQUIRE(x < 5.0);
        sum += x;
        squares += (x - 3.5) * (x - 3.5);
    }
    // Five standard deviations: of the mean sqrt(0.75 / n), of the variance sqrt(0.45 / n).
    BOOST_TEST(std::abs(sum / draws - 3.5) < 5.0 * std::sqrt(0.75 / draws));
    BOOST_TEST(std::abs(squares / draws - 0.75) < 5.0 * std::sqrt(0.45 / draws));
}

BOOST_AUTO_TEST_CASE(integers_are_even_over_their_range) {
    constexpr int draws = 60000, sides = 6;
    talus::Random random(2);
    std::array<int, sides> seen{};
    for (int i = 0; i < draws; ++i) ++seen.at(static_cast<std::size_t>(random.integer(-2, 3) + 2));
    double chi_squared = 0.0;
    for (const int n : seen) chi_squared += std::pow(n - draws / sides, 2) / (draws / sides);
    BOOST_TEST(chi_squared < 25.0);  // exceeded once in 7000 seeds, for 5 degrees of freedom
}

BOOST_AUTO_TEST_CASE(an_empty_range_of_integers_is_a_programming_error) {
    talus::Random random(3);
    BOOST_CHECK_THROW(random.integer(2, 1), talus::precondition_error);
}

BOOST_AUTO_TEST_SUITE_END()
