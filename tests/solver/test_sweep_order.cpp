// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/sweeps/sweep_order.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>

BOOST_AUTO_TEST_SUITE(sweep_order)
using Visits = std::vector<std::size_t>;
Visits next(talus::SweepSequence& sequence) {
    Visits v;
    sequence.next([&](std::size_t i) { v.push_back(i); });
    return v;
}

BOOST_AUTO_TEST_CASE(fixed_orders_are_as_named) {
    const Visits up{0, 1, 2, 3}, down{3, 2, 1, 0};
    talus::SweepSequence s;
    s.reset(talus::SweepOrder::forward, 1, 4);
    for (int k = 0; k < 3; ++k) BOOST_TEST(next(s) == up);
    s.reset(talus::SweepOrder::backward, 1, 4);
    for (int k = 0; k < 3; ++k) BOOST_TEST(next(s) == down);
    s.reset(talus::SweepOrder::symmetric, 1, 4);
    for (int k = 0; k < 3; ++k) {
        BOOST_TEST(next(s) == up);
        BOOST_TEST(next(s) == down);
    }
}

BOOST_AUTO_TEST_CASE(random_order_is_a_new_permutation_each_sweep_and_repeats_with_the_seed) {
    talus::SweepSequence s, t, other;
    s.reset(talus::SweepOrder::random, 5, 100);
    t.reset(talus::SweepOrder::random, 5, 100);
    other.reset(talus::SweepOrder::random, 6, 100);
    const Visits first = next(s), second = next(s);
    BOOST_TEST(first != second);
    BOOST_TEST(next(t) == first);
    BOOST_TEST(next(t) == second);
    BOOST_TEST(next(other) != first);
    Visits sorted = second;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < 100; ++i) BOOST_TEST(sorted[i] == i);
}

// Each contact is first in some 100 of 1000 sweeps of ten: 160 is six standard deviations off.
BOOST_AUTO_TEST_CASE(random_order_favours_no_contact) {
    talus::SweepSequence s;
    s.reset(talus::SweepOrder::random, 9, 10);
    Visits count(10, 0);
    for (int k = 0; k < 1000; ++k) ++count[next(s)[0]];
    for (const std::size_t c : count) BOOST_TEST((c > 40 && c < 160));
}

BOOST_AUTO_TEST_CASE(no_contact_is_visited_in_an_empty_problem) {
    talus::SweepSequence s;
    for (const auto order : {talus::SweepOrder::forward, talus::SweepOrder::backward,
                             talus::SweepOrder::symmetric, talus::SweepOrder::random}) {
        s.reset(order, 1, 0);
        BOOST_TEST(next(s).empty());
    }
}

BOOST_AUTO_TEST_SUITE_END()
