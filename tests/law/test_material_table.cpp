// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>
#include <talus/law/material_table.hpp>
#include <talus/law/weighted_mean.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(material_table)
using Law = talus::Coulomb<3>;
auto says(const char* text) {
    return [text](const talus::input_error& e) {
        return std::string(e.what()).find(text) != std::string::npos;
    };
}

BOOST_AUTO_TEST_CASE(law_of_a_pair_does_not_depend_on_its_order) {
    talus::MaterialTable<Law> table(3, {.mu = 0.1});
    table.set(0, 2, {.mu = 0.7});
    table.set(2, 2, {.mu = 0.9});
    BOOST_TEST(table.material_count() == 3);
    BOOST_TEST(table.at(2, 0).mu == 0.7);
    BOOST_TEST(table.at(0, 2).mu == 0.7);
    BOOST_TEST(table.at(2, 2).mu == 0.9);
    BOOST_TEST(table.at(1, 2).mu == 0.1);
}

BOOST_AUTO_TEST_CASE(bad_input_is_named) {
    BOOST_CHECK_EXCEPTION(talus::MaterialTable<Law>(0), talus::input_error, says("materials is 0"));
    talus::MaterialTable<Law> table(2);
    BOOST_CHECK_EXCEPTION(table.at(0, 1), talus::input_error, says("(0, 1) is missing"));
    BOOST_CHECK_EXCEPTION(table.at(0, 2), talus::input_error, says("index is 2"));
    BOOST_CHECK_EXCEPTION(table.set(-1, 0, {}), talus::input_error, says("index is -1"));
    BOOST_CHECK_EXCEPTION(table.set(0, 1, {.mu = -0.1}), talus::input_error,
                          says("(0, 1).mu is -0.1"));
    BOOST_CHECK_EXCEPTION(table.set(0, 1, {.mu = NAN}), talus::input_error, says("(0, 1).mu is"));
    using Mean = talus::WeightedMean<3, Law>;
    BOOST_CHECK_EXCEPTION(talus::MaterialTable<Mean>(1, Mean{{.mu = 0.1}, 1.2, 0.0}),
                          talus::input_error, says("restitution_normal is 1.2"));
}

BOOST_AUTO_TEST_SUITE_END()
