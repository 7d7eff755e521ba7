// SPDX-License-Identifier: BSL-1.0
#include <talus/io/series/csv_series.hpp>
#include <talus/io/series/schedule.hpp>
#include <talus/io/series/vtk_series.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_series)

std::string content(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

BOOST_AUTO_TEST_CASE(schedules_are_due_once) {
    auto third = talus::Schedule::every_steps(3);
    std::vector<int> steps;
    for (int k = 1; k <= 10; ++k)
        if (third.due(k, 0.1 * k)) steps.push_back(k);
    BOOST_TEST(steps == std::vector<int>({3, 6, 9}), boost::test_tools::per_element());
    for (const double h : {1e-3, 0.01, 0.03, 0.1, 0.7, 2.5}) {
        auto tenths = talus::Schedule::every(0.1);
        int due = 0, steps_made = 0;
        double before = 0.0;
        for (int k = 1; k * h <= 7.0 + 1e-9; ++k, ++steps_made) {
            if (!tenths.due(k, k * h)) continue;
            ++due;
            // Never before its time, never a step late.
            const double reached = std::floor(k * h / 0.1 + 1e-6);
            BOOST_TEST(reached > before);
            if (h < 0.1) BOOST_TEST(k * h - 0.1 * reached < h - 1e-9);
            before = reached;
        }
        BOOST_TEST(due == (h <= 0.1 ? static_cast<int>(steps_made * h / 0.1 + 1e-6) : steps_made));
    }
    // One that goes on does not repeat what was there.
    auto later = talus::Schedule::every(0.1, 3.0);
    BOOST_TEST(!later.due(300, 3.0));
    BOOST_TEST(!later.due(301, 3.01));
    BOOST_TEST(later.due(310, 3.1));
    BOOST_CHECK_THROW(talus::Schedule::every_steps(0), talus::input_error);
    BOOST_CHECK_THROW(talus::Schedule::every(0.0), talus::input_error);
}

const std::vector<talus::CsvSeries::Column> columns{{"kinetic energy", "J"}, {"contacts", "-"}};

BOOST_AUTO_TEST_CASE(rows_read_back_bit_for_bit_as_they_are_added) {
    const TemporaryFolder folder("series");
    const auto path = folder / "energy.csv";
    talus::CsvSeries table(path, columns);
    BOOST_TEST(content(path) == "time [s],kinetic energy [J],contacts [-]\n");
    table.add(0.1, {1.0 / 3.0, 7.0});
    table.add(0.2, {std::numeric_limits<double>::quiet_NaN(), 1e-300});
    BOOST_TEST(
        content(path) ==
        "time [s],kinetic energy [J],contacts [-]\n0.1,0.3333333333333333,7\n0.2,nan,1e-300\n");
    BOOST_CHECK_THROW(table.add(0.3, {1.0}), talus::input_error);
    BOOST_CHECK_THROW(table.add(NAN, {1.0, 2.0}), talus::input_error);
    BOOST_CHECK_THROW(talus::CsvSeries(path, {{"a,b", "m"}}), talus::input_error);
    BOOST_CHECK_THROW(talus::CsvSeries(folder / "no/energy.csv", columns), std::runtime_error);
    BOOST_TEST(content(path).size() > 60u);
}

BOOST_AUTO_TEST_CASE(a_run_that_goes_on_appends) {
    const TemporaryFolder folder("series");
    const auto path = folder / "energy.csv";
    const auto rows = [&](double from, double to, talus::CsvSeries table) {
        for (double t = from; t <= to + 1e-12; t += 0.25) table.add(t, {t * t, 2.0 * t});
    };
    rows(0.25, 2.0, talus::CsvSeries(path, columns));
    const std::string whole = content(path);
    // Killed in the middle of a row, after more than the last checkpoint knows.
    std::ofstream(path, std::ios::app) << "2.25,5.06";
    rows(1.25, 2.0, talus::CsvSeries::resumed(path, columns, 1.0));
    BOOST_TEST(content(path) == whole);
    rows(0.25, 2.0, talus::CsvSeries::resumed(folder / "new.csv", columns, 1.0));
    BOOST_TEST(content(folder / "new.csv") == whole);
    // Of another table, and what is none.
    BOOST_CHECK_THROW(talus::CsvSeries::resumed(path, {{"speed", "m/s"}}, 1.0), talus::input_error);
    std::ofstream(path, std::ios::app) << "later,1,2\n";
    const std::string damaged = content(path);
    BOOST_CHECK_THROW(talus::CsvSeries::resumed(path, columns, 9.0), talus::input_error);
    BOOST_TEST(content(path) == damaged);
}

BOOST_AUTO_TEST_CASE(a_killed_run_leaves_whole_rows) {
    const TemporaryFolder folder("series");
    const auto path = folder / "energy.csv";
    for (int trial = 0; trial < 20; ++trial) {
        const pid_t child = ::fork();
        BOOST_REQUIRE(child >= 0);
        if (child == 0) {
            talus::CsvSeries table(path, columns);
            for (int k = 1;; ++k) table.add(k, {0.5 * k, 1.0 * k});
        }
        ::usleep(2000 + 700 * static_cast<unsigned>(trial));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        auto table = talus::CsvSeries::resumed(path, columns, 1e9);
        const std::string text = content(path);
        BOOST_REQUIRE(!text.empty());
        BOOST_TEST(text.back() == '\n');
    }
}

talus::VtkPolyData point(double x) {
    talus::VtkPolyData data;
    data.points = {{x, 0, 0}};
    data.vertices = {{0}};
    return data;
}

BOOST_AUTO_TEST_CASE(data_sets_are_listed_with_their_times) {
    const TemporaryFolder folder("series");
    const auto list = folder / "fall.pvd";
    talus::VtkSeries series(list);
    for (int k = 0; k < 4; ++k) series.add(0.1 * k, point(k));
    BOOST_TEST(series.size() == 4u);
    BOOST_TEST(
        content(list).find("<DataSet timestep=\"0.1\" part=\"0\" file=\"fall-000001.vtp\"/>") !=
        std::string::npos);
    BOOST_TEST(content(series.file(3)) == talus::vtp_text(point(3)));
    BOOST_CHECK_THROW(series.add(0.3, point(9)), talus::input_error);
    const std::string whole = content(list);
    auto more = talus::VtkSeries::resumed(list, 0.1);
    BOOST_TEST(more.size() == 2u);
    more.add(0.2, point(2));
    more.add(0.1 * 3, point(3));
    BOOST_TEST(content(list) == whole);
    BOOST_CHECK_THROW(talus::VtkSeries(folder / "fall.vtp"), talus::input_error);
    std::ofstream(folder / "other.pvd") << "something else";
    BOOST_CHECK_THROW(talus::VtkSeries::resumed(folder / "other.pvd", 1.0), talus::input_error);
    BOOST_TEST(content(folder / "other.pvd") == "something else");
}

BOOST_AUTO_TEST_SUITE_END()
