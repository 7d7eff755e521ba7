// SPDX-License-Identifier: BSL-1.0
#include <talus/core/number_record.hpp>
#include <talus/core/types.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

BOOST_AUTO_TEST_SUITE(core_number_record)

struct Weather {
    double wind = 0.0;
    std::uint64_t seed = 0;
    std::string place;

    void write(talus::NumberRecord& out) const {
        out.real(wind);
        out.integer(seed);
        out.text(place);
    }
    static Weather read(talus::NumberRecordReader& in) {
        Weather w;
        w.wind = in.real();
        w.seed = in.integer<std::uint64_t>();
        w.place = in.text();
        return w;
    }
};
static_assert(talus::Recordable<Weather>);
static_assert(!talus::Recordable<int>);

BOOST_AUTO_TEST_CASE(comes_back_bit_for_bit) {
    const Weather storm{-0.0, std::numeric_limits<std::uint64_t>::max() - 3,
                        "Montpellier \xc3\xa9"};
    const talus::NumberRecord record = talus::record_of(storm);
    const auto back = talus::from_record<Weather>(record);
    BOOST_TEST(std::signbit(back.wind));
    BOOST_TEST(back.seed == storm.seed);
    BOOST_TEST(back.place == storm.place);
    talus::NumberRecord numbers;
    const talus::Vector<3> x(1.0 / 3.0, std::numeric_limits<double>::infinity(), 5e-324);
    numbers.array(x);
    talus::NumberRecordReader in(numbers);
    BOOST_TEST((in.array<talus::Vector<3>>() == x));
}

BOOST_AUTO_TEST_CASE(a_record_of_something_else_is_refused) {
    talus::NumberRecord record = talus::record_of(Weather{1.0, 2, "here"});
    record.reals.push_back(0.0);
    BOOST_CHECK_THROW(talus::from_record<Weather>(record), talus::input_error);
    record.reals.clear();
    BOOST_CHECK_THROW(talus::from_record<Weather>(record), talus::input_error);
    // A length that is a claim: nothing is allocated for it.
    record = {{1.0}, {2, std::int64_t{1} << 60, 'h'}};
    BOOST_CHECK_THROW(talus::from_record<Weather>(record), talus::input_error);
    record = {{1.0}, {2, -1}};
    BOOST_CHECK_THROW(talus::from_record<Weather>(record), talus::input_error);
    talus::NumberRecordReader in(record);
    BOOST_CHECK_THROW(in.integer(0, 1), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
