// SPDX-License-Identifier: BSL-1.0
#include <talus/law/bracketed_root.hpp>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(bracketed_root)

/// The root of f in [low, high], and how many evaluations it took.
template <class Function>
double root(Function f, double low, double high, int& count) {
    count = 0;
    const auto counted = [&](double x) {
        ++count;
        return f(x);
    };
    return talus::bracketed_root(counted, {low, f(low)}, {high, f(high)}).best().x;
}

BOOST_AUTO_TEST_CASE(roots_are_found_to_rounding) {
    const auto close = boost::test_tools::tolerance(1e-15);
    int count = 0;
    BOOST_TEST(root([](double x) { return 4.0 * x - 1.0; }, 0.0, 1e3, count) == 0.25, close);
    BOOST_TEST(count <= 3);
    BOOST_TEST(root([](double x) { return 1.0 - 4.0 * x; }, 0.0, 1e3, count) == 0.25, close);
    BOOST_TEST(root([](double x) { return x * x - 2.0; }, 0.0, 2.0, count) == std::sqrt(2.0),
               close);
    BOOST_TEST(count <= 12);
    // Flat, steep, kinked, far down in a wide bracket.
    BOOST_TEST(root([](double x) { return std::pow(x - 1.0, 3); }, 0.0, 3.0, count) == 1.0,
               boost::test_tools::tolerance(1e-5));
    BOOST_TEST(root([](double x) { return std::atan(1e8 * (x - 0.3)); }, 0.0, 1.0, count) == 0.3,
               close);
    BOOST_TEST(
        root([](double x) { return std::max(x - 0.7, 1e-3 * (x - 0.7)); }, 0.0, 9.0, count) == 0.7,
        close);
    BOOST_TEST(root([](double x) { return x - 1e-10; }, 0.0, 1.0, count) == 1e-10, close);
    BOOST_TEST(root([](double x) { return x > 0.1 ? 1.0 : -1.0; }, 0.0, 1.0, count) == 0.1, close);
    BOOST_TEST(count < 80);
}

BOOST_AUTO_TEST_SUITE_END()
