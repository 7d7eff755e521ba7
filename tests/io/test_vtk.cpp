// SPDX-License-Identifier: BSL-1.0
#include <talus/io/vtk.hpp>

#include <boost/test/unit_test.hpp>

#include <sstream>

BOOST_AUTO_TEST_SUITE(io_vtk)

/// The numbers between the tags of the array of this name.
std::vector<double> array(const std::string& text, const std::string& name) {
    auto at = text.find("Name=\"" + name + "\"");
    BOOST_REQUIRE(at != std::string::npos);
    at = text.find('>', at) + 1;
    std::istringstream in(text.substr(at, text.find('<', at) - at));
    std::vector<double> numbers;
    for (double x; in >> x;) numbers.push_back(x);
    return numbers;
}

talus::VtkPolyData triangle_and_line() {
    talus::VtkPolyData data;
    data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
    data.lines = {{0, 1}};
    data.polygons = {{0, 1, 2}};
    data.cell_fields = {{"load [N]", 1, {3.5, -2e-9}}};
    data.point_fields = {{"velocity", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}}};
    return data;
}

BOOST_AUTO_TEST_CASE(what_was_given_can_be_read_back) {
    const std::string text = talus::vtp_text(triangle_and_line());
    BOOST_CHECK(text.find("NumberOfPoints=\"3\"") != std::string::npos);
    BOOST_CHECK(text.find("NumberOfPolys=\"1\"") != std::string::npos);
    const auto load = array(text, "load [N]");
    BOOST_REQUIRE_EQUAL(load.size(), 2u);
    BOOST_CHECK_EQUAL(load[0], 3.5);
    BOOST_CHECK_EQUAL(load[1], -2e-9);
    BOOST_CHECK_EQUAL(array(text, "velocity").size(), 9u);
}

BOOST_AUTO_TEST_CASE(fields_and_indices_that_do_not_fit_are_rejected) {
    auto data = triangle_and_line();
    data.cell_fields[0].values.pop_back();
    BOOST_CHECK_EXCEPTION(talus::vtp_text(data), talus::input_error, [](const auto& e) {
        return std::string(e.what()).find("load [N]") != std::string::npos;
    });
    data = triangle_and_line();
    data.polygons[0][2] = 3;
    BOOST_CHECK_THROW(talus::vtp_text(data), talus::input_error);
    data.polygons[0][2] = -1;
    BOOST_CHECK_THROW(talus::vtp_text(data), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
