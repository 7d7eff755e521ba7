// SPDX-License-Identifier: BSL-1.0
// Inputs that fuzzers found to reach something new, given to the same checks again.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/reading.hpp"

BOOST_AUTO_TEST_SUITE(fuzz_corpus)

/// Bytes from pairs of hexadecimal digits.
std::string decoded(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return bytes;
}

template <class Check>
void check_corpus(const std::string& name, Check&& check) {
    std::ifstream file(std::filesystem::path(TALUS_CORPUS) / (name + ".hex"));
    BOOST_REQUIRE(file);
    int line = 0;
    for (std::string hex; std::getline(file, hex);) {
        BOOST_TEST_CONTEXT("line " << ++line) { BOOST_CHECK_NO_THROW(check(decoded(hex))); }
    }
    BOOST_TEST(line > 20);
}

BOOST_AUTO_TEST_CASE(scenes) { check_corpus("scene", reading::check_scene); }
BOOST_AUTO_TEST_CASE(obj_files) { check_corpus("obj", reading::check_obj); }
BOOST_AUTO_TEST_CASE(stl_files) { check_corpus("stl", reading::check_stl); }
BOOST_AUTO_TEST_CASE(hulls) { check_corpus("hulls", reading::check_hulls); }

// The checks themselves: what is wrong is seen.
BOOST_AUTO_TEST_CASE(complaints_that_are_no_sentence_are_seen) {
    BOOST_CHECK_THROW(reading::demand_one_sentence("other.txt: bad", "pile.txt"), reading::broken);
    BOOST_CHECK_THROW(reading::demand_one_sentence("pile.txt: \x1b[31m", "pile.txt"),
                      reading::broken);
    BOOST_CHECK_NO_THROW(reading::demand_one_sentence("pile.txt: bad", "pile.txt"));
}

BOOST_AUTO_TEST_SUITE_END()
