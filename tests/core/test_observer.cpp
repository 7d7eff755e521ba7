// SPDX-License-Identifier: BSL-1.0
#include <talus/core/observer.hpp>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(core_observer)

BOOST_AUTO_TEST_CASE(only_an_observer_that_answers_false_stops_the_loop) {
    int seen = 0;
    auto watch = [&](int k) { seen = k; };
    auto stop_at_three = [](int k) { return k < 3; };
    talus::Ignore ignore;
    BOOST_CHECK(talus::notify(watch, 7));
    BOOST_CHECK_EQUAL(seen, 7);
    BOOST_CHECK(talus::notify(stop_at_three, 2));
    BOOST_CHECK(!talus::notify(stop_at_three, 3));
    BOOST_CHECK(talus::notify(ignore, 1, "anything"));
}

BOOST_AUTO_TEST_SUITE_END()
