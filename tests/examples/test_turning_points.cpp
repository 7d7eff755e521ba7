// SPDX-License-Identifier: BSL-1.0
#include <talus/core/number_record.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "examples/lab/measures/turning_points.hpp"

BOOST_AUTO_TEST_SUITE(lab_turning_points)

using lab::TurningPoints;

TurningPoints of(const std::vector<double>& series, double amplitude) {
    TurningPoints turns(amplitude);
    for (const double x : series) turns.add(x);
    return turns;
}
void require(const TurningPoints& turns, const std::vector<double>& peaks,
             const std::vector<double>& valleys) {
    BOOST_TEST(turns.peaks() == peaks, boost::test_tools::per_element());
    BOOST_TEST(turns.valleys() == valleys, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(ripples_below_the_amplitude_are_none) {
    require(of({0.0, 0.5, 0.1, 0.6, 0.2}, 1.0), {}, {});
    require(of({}, 1.0), {}, {});
}

BOOST_AUTO_TEST_CASE(what_is_not_final_is_left_out) {
    // 3 is a peak once the series is at 1.9, the valley 1 once it is at 2.5.
    require(of({0.0, 3.0, 1.9}, 1.0), {3.0}, {});
    require(of({0.0, 3.0, 1.9, 1.0, 1.5, 2.5, 2.2}, 1.0), {3.0}, {1.0});
}

BOOST_AUTO_TEST_CASE(a_series_may_begin_either_way) {
    require(of({5.0, 3.0, 6.0, 2.0, 4.0}, 1.5), {6.0}, {3.0, 2.0});
    require(of({3.0, 5.0, 2.0, 6.0, 1.0}, 1.5), {5.0, 6.0}, {2.0});
}

BOOST_AUTO_TEST_CASE(a_record_goes_on_where_it_was) {
    const std::vector<double> series{1.0, 4.0, 0.0, std::nan(""), 5.0, 2.0, 3.5, 0.5, 9.0, 1.0};
    TurningPoints whole(1.2), first(1.2), second(1.2);
    for (std::size_t k = 0; k < series.size(); ++k) {
        whole.add(series[k]);
        if (k < 5) first.add(series[k]);
    }
    second.restore(talus::record_of(first));
    for (std::size_t k = 5; k < series.size(); ++k) second.add(series[k]);
    require(second, whole.peaks(), whole.valleys());
    BOOST_TEST(whole.peaks().size() >= 2u);
}

BOOST_AUTO_TEST_SUITE_END()
