// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

#include "examples/pile/progress.hpp"

BOOST_AUTO_TEST_SUITE(examples_progress)

BOOST_AUTO_TEST_CASE(durations_are_said_in_words_that_fit) {
    using pile::duration_text;
    BOOST_TEST(duration_text(0.0) == "0:00");
    BOOST_TEST(duration_text(7.4) == "0:07");
    BOOST_TEST(duration_text(754.0) == "12:34");
    BOOST_TEST(duration_text(3599.6) == "1:00:00");
    BOOST_TEST(duration_text(18367.0) == "5:06:07");
    BOOST_TEST(duration_text(86400.0 * 3.2) == "3.2 days");
    BOOST_TEST(duration_text(1e16) == "3.17e+08 years");
    BOOST_TEST(duration_text(std::numeric_limits<double>::max()) == "5.7e+300 years");
    BOOST_TEST(duration_text(std::numeric_limits<double>::infinity()) == "unknown");
    BOOST_TEST(duration_text(std::nan("")) == "unknown");
    BOOST_TEST(duration_text(-1e12) == "0:00");
}

BOOST_AUTO_TEST_CASE(a_bar_is_as_wide_for_shares_beyond_one) {
    using pile::bar_text;
    BOOST_TEST(bar_text(0.5, 4) == "##..");
    BOOST_TEST(bar_text(1.25, 4) == "####");
    BOOST_TEST(bar_text(-1.0, 4) == "....");
    BOOST_TEST(bar_text(std::nan(""), 4) == "....");
}

BOOST_AUTO_TEST_SUITE_END()
