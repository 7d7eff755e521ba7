// SPDX-License-Identifier: BSL-1.0
#include <talus/io/write_file.hpp>

#include <boost/test/unit_test.hpp>

#include "io/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_write_file)

BOOST_AUTO_TEST_CASE(a_file_holds_what_was_written_and_nothing_else_is_left) {
    const TemporaryFolder folder("write");
    talus::write_file(folder / "a.txt", "first");
    talus::write_file(folder / "a.txt", std::string("second\0\n", 8));
    BOOST_TEST(content_of(folder / "a.txt") == std::string("second\0\n", 8));
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(a_missing_folder_is_named) {
    const TemporaryFolder folder("write");
    const auto path = folder / "missing/a.txt";
    BOOST_CHECK_EXCEPTION(talus::write_file(path, "x"), std::runtime_error, [&](const auto& e) {
        return std::string(e.what()).find(path.string()) != std::string::npos;
    });
    BOOST_TEST(folder.file_count() == 0);
}

BOOST_AUTO_TEST_CASE(a_failed_rename_leaves_nothing_behind_and_the_old_thing_in_place) {
    const TemporaryFolder folder("write");
    std::filesystem::create_directories(folder / "taken/by_a_folder");
    BOOST_CHECK_THROW(talus::write_file(folder / "taken", "x"), std::runtime_error);
    BOOST_TEST(std::filesystem::is_directory(folder / "taken"));
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_an_error_that_names_the_path) {
    // Linux offers a device that is always full; elsewhere there is nothing to try.
    if (!std::filesystem::exists("/dev/full")) return;
    const TemporaryFolder folder("write");
    std::filesystem::create_symlink("/dev/full", folder / "a.txt.part");
    BOOST_CHECK_EXCEPTION(
        talus::write_file(folder / "a.txt", std::string(100000, 'x')), std::runtime_error,
        [](const auto& e) { return std::string(e.what()).find("a.txt") != std::string::npos; });
    BOOST_TEST(folder.file_count() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
