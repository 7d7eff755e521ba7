// SPDX-License-Identifier: BSL-1.0
#include <talus/io/sample/read_sieve_curve.hpp>

#include <boost/test/unit_test.hpp>

#include <fstream>
#include <sstream>
#include <string>

#include "temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_sieve_curve)

talus::SieveCurve<3> curve(const std::string& text) {
    std::istringstream in(text);
    return talus::parse_sieve_curve<3>(in, "sand.txt");
}

BOOST_AUTO_TEST_CASE(a_curve_in_two_columns) {
    const auto law = curve("# radius share\n\n0.002 0\r\n0.004\t0.35 # coarse\n8e-3 1\n");
    BOOST_TEST(law.low_end() == 0.002);
    BOOST_TEST(law.high_end() == 0.008);
    const talus::SieveCurve<3> same({{0.002, 0.0}, {0.004, 0.35}, {0.008, 1.0}});
    BOOST_TEST(law.mean() == same.mean());
}

BOOST_AUTO_TEST_CASE(complaints_name_file_and_line_or_point) {
    const auto says = [](const std::string& text, const std::string& words) {
        BOOST_CHECK_EXCEPTION(curve(text), talus::input_error, [&](const talus::input_error& e) {
            BOOST_TEST_CONTEXT(e.what()) {
                const std::string sentence = e.what();
                BOOST_TEST(sentence.starts_with("sand.txt"));
                BOOST_TEST(sentence.find(words) != std::string::npos);
            }
            return true;
        });
    };
    says("", "number of points");
    says("0.1 0\n0.2 x\n", "line 2: share of the mass is 'x'");
    says("0.1 0\n0.2\n", "line 2: share of the mass is missing");
    says("0.1 0\n-0.2 1\n", "line 2: radius [m] is '-0.2'");
    says("0.1 0 7\n0.2 1\n", "line 1: column 3");
    says("0.1 0\n0.2 100\n", "in [0, 1]");
    says("0.1 0\n0.3 0.5\n0.2 1\n", "radius of point 2");
    says("0.1 0\n0.3 0.5\n0.4 0.4\n", "share of point 2");
    says("0.1 0\n0.3 0.5\n", "last share");
}

BOOST_AUTO_TEST_CASE(a_file) {
    const TemporaryFolder folder("sieve");
    std::ofstream(folder / "sand.txt") << "0.1 0\n0.2 1\n";
    BOOST_TEST(talus::read_sieve_curve<2>(folder / "sand.txt").high_end() == 0.2);
    BOOST_CHECK_THROW(talus::read_sieve_curve<2>(folder / "none.txt"), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
