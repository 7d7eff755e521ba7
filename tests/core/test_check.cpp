// SPDX-License-Identifier: BSL-1.0
#include <talus/core/check.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

BOOST_AUTO_TEST_SUITE(core_check)

using talus::input_error;

BOOST_AUTO_TEST_CASE(a_broken_precondition_names_expression_sentence_and_place) {
    const int n = 2;
    BOOST_CHECK_NO_THROW(TALUS_CHECK(n == 2, "n is two"));
    BOOST_CHECK_EXCEPTION(TALUS_CHECK(n == 3, "n must be three"), talus::precondition_error,
                          [](const auto& e) {
                              const std::string text = e.what();
                              return text.find("n == 3") != std::string::npos &&
                                     text.find("n must be three") != std::string::npos &&
                                     text.find("test_check.cpp:") != std::string::npos;
                          });
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_rejected_with_item_value_and_range) {
    const double nan = std::nan("");
    const double inf = std::numeric_limits<double>::infinity();
    BOOST_CHECK_EQUAL(talus::require_positive("mass", 2.0), 2.0);
    BOOST_CHECK_EQUAL(talus::require_non_negative("mu", 0.0), 0.0);
    BOOST_CHECK_EQUAL(talus::require_in("e", 1.0, 0.0, 1.0), 1.0);
    for (double bad : {0.0, -1.0, nan, inf})
        BOOST_CHECK_THROW(talus::require_positive("mass", bad), input_error);
    for (double bad : {-1e-300, nan, inf})
        BOOST_CHECK_THROW(talus::require_non_negative("mu", bad), input_error);
    for (double bad : {-0.1, 1.1, nan})
        BOOST_CHECK_THROW(talus::require_in("e", bad, 0.0, 1.0), input_error);
    BOOST_CHECK_EXCEPTION(
        talus::require_in("restitution", 1.5, 0.0, 1.0), input_error, [](const auto& e) {
            return std::string(e.what()) == "restitution is 1.5, but must be in [0, 1]";
        });
}

BOOST_AUTO_TEST_CASE(the_first_entry_that_is_not_finite_is_named) {
    const talus::Vector<3> good(1.0, 2.0, 3.0);
    const talus::Vector<3> bad(1.0, std::nan(""), 3.0);
    BOOST_CHECK_NO_THROW(talus::require_finite("position", good));
    BOOST_CHECK_EXCEPTION(talus::require_finite("position", bad), input_error, [](const auto& e) {
        return std::string(e.what()).find("position[1]") == 0;
    });
}

BOOST_AUTO_TEST_CASE(contact_keys_are_ordered_by_bodies_then_feature) {
    using talus::ContactKey;
    BOOST_CHECK((ContactKey{1, 5, {9}} < ContactKey{2, 3, {0}}));
    BOOST_CHECK((ContactKey{1, 3, {9}} < ContactKey{1, 5, {0}}));
    BOOST_CHECK((ContactKey{1, 3, {0}} < ContactKey{1, 3, {1}}));
    BOOST_CHECK((ContactKey{1, 3, {1}} == ContactKey{1, 3, {1}}));
}

BOOST_AUTO_TEST_CASE(text_of_others_is_shown_without_its_control_characters) {
    using talus::detail::printable;
    BOOST_TEST(printable("a\x1b[2Jb\n\tc\x7f\x01") == R"(a\x1b[2Jb\n\tc\x7f\x01)");
    const std::string nothing_to_do = "Körner, \u20ac, \U0001F600";
    BOOST_TEST(printable(nothing_to_do) == nothing_to_do);
    BOOST_TEST(printable("\xc2\x9b") == R"(\xc2\x9b)");        // a control character
    BOOST_TEST(printable("\xff x \xc3") == R"(\xff x \xc3)");  // no UTF-8
    BOOST_TEST(printable("\xc0\x8a\xed\xa0\x80").find('\xc0') == std::string::npos);
    BOOST_TEST(printable("\xe2\x82"
                         "a") == R"(\xe2\x82a)");
    BOOST_TEST(printable(std::string_view("\0", 1)) == R"(\x00)");
    BOOST_TEST(printable("\x9b\x80") == R"(\x9b\x80)");  // begins in the middle of a character
    BOOST_TEST(printable("\xe2\x80\xae") == R"(\xe2\x80\xae)");  // writes backwards from here
    BOOST_TEST(printable("abcdef", 4) == "abcd...");
    BOOST_TEST(printable("abcd", 4) == "abcd");
}

BOOST_AUTO_TEST_CASE(errors_of_input_are_one_line_of_text) {
    BOOST_CHECK_EXCEPTION(
        throw input_error("file 'a\nb\x1b]0;c\a'"), input_error,
        [](const auto& e) { return std::string(e.what()) == R"(file 'a\nb\x1b]0;c\x07')"; });
}

BOOST_AUTO_TEST_SUITE_END()
