// SPDX-License-Identifier: BSL-1.0
#include <talus/io/write_file.hpp>

#include <boost/test/unit_test.hpp>

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "io/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_write_file)

int mode_of(const std::filesystem::path& path) {
    struct ::stat status = {};
    BOOST_REQUIRE(::stat(path.c_str(), &status) == 0);
    return static_cast<int>(status.st_mode & 07777);
}

/// While it lives, no file grows beyond some bytes: what a full disk does.
class SmallFiles {
  public:
    explicit SmallFiles(rlim_t most) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{most, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallFiles() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_ = {};
    void (*handler_)(int);
};

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
    const auto names_the_path = [&](const auto& e) {
        return std::string(e.what()).find(path.string()) != std::string::npos;
    };
    BOOST_CHECK_EXCEPTION(talus::write_file(path, "x"), std::runtime_error, names_the_path);
    BOOST_CHECK_EXCEPTION(talus::require_writable(path), std::runtime_error, names_the_path);
    BOOST_TEST(folder.file_count() == 0);
}

BOOST_AUTO_TEST_CASE(a_folder_is_not_replaced) {
    const TemporaryFolder folder("write");
    std::filesystem::create_directories(folder / "taken/by_a_folder");
    BOOST_CHECK_THROW(talus::write_file(folder / "taken", "x"), std::runtime_error);
    BOOST_CHECK_THROW(talus::require_writable(folder / "taken"), std::runtime_error);
    BOOST_TEST(std::filesystem::is_directory(folder / "taken"));
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(a_failure_leaves_the_old_file_whole_and_nothing_behind) {
    const TemporaryFolder folder("write");
    talus::write_file(folder / "a.txt", "old");
    const SmallFiles limit(1000);
    BOOST_CHECK_EXCEPTION(
        talus::write_file(folder / "a.txt", std::string(100000, 'x')), std::runtime_error,
        [](const auto& e) { return std::string(e.what()).find("a.txt") != std::string::npos; });
    BOOST_CHECK_THROW(talus::write_file(folder / "b.txt", std::string(100000, 'x')),
                      std::runtime_error);
    BOOST_TEST(content_of(folder / "a.txt") == "old");
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(a_file_of_another_that_is_called_part_is_not_touched) {
    const TemporaryFolder folder("write");
    talus::write_file(folder / "a.txt.part", "mine");
    talus::write_file(folder / "a.txt", "x");
    BOOST_CHECK_THROW(talus::write_file(folder / "a.txt/b", "x"), std::runtime_error);
    BOOST_TEST(content_of(folder / "a.txt.part") == "mine");
    BOOST_TEST(folder.file_count() == 2);
}

BOOST_AUTO_TEST_CASE(modes_are_kept_and_new_files_have_those_of_the_users_mask) {
    const TemporaryFolder folder("write");
    const ::mode_t mask = ::umask(027);
    talus::write_file(folder / "a.txt", "x");
    ::umask(mask);
    BOOST_TEST(mode_of(folder / "a.txt") == 0640);
    ::chmod((folder / "a.txt").c_str(), 0604);
    talus::write_file(folder / "a.txt", "y");
    BOOST_TEST(mode_of(folder / "a.txt") == 0604);
}

BOOST_AUTO_TEST_CASE(a_file_without_permission_to_write_stays) {
    if (::geteuid() == 0) return;  // root may
    const TemporaryFolder folder("write");
    talus::write_file(folder / "a.txt", "old");
    ::chmod((folder / "a.txt").c_str(), 0444);
    BOOST_CHECK_THROW(talus::require_writable(folder / "a.txt"), std::runtime_error);
    BOOST_CHECK_THROW(talus::write_file(folder / "a.txt", "x"), std::runtime_error);
    BOOST_TEST(content_of(folder / "a.txt") == "old");
}

BOOST_AUTO_TEST_CASE(a_symbolic_link_stays_one_and_what_it_leads_to_gets_the_text) {
    const TemporaryFolder folder("write");
    std::filesystem::create_directories(folder / "there");
    talus::write_file(folder / "there/a.txt", "old");
    std::filesystem::create_symlink("there/a.txt", folder / "link");
    std::filesystem::create_symlink("link", folder / "link to link");
    std::filesystem::create_symlink("there/new.txt", folder / "link to nothing");
    talus::write_file(folder / "link to link", "new");
    talus::write_file(folder / "link to nothing", "made");
    BOOST_TEST(std::filesystem::is_symlink(folder / "link"));
    BOOST_TEST(std::filesystem::is_symlink(folder / "link to link"));
    BOOST_TEST(std::filesystem::is_symlink(folder / "link to nothing"));
    BOOST_TEST(content_of(folder / "there/a.txt") == "new");
    BOOST_TEST(content_of(folder / "there/new.txt") == "made");
    std::filesystem::create_symlink("round", folder / "round");
    BOOST_CHECK_THROW(talus::write_file(folder / "round", "x"), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(a_pipe_gets_the_text_and_stays_a_pipe) {
    const TemporaryFolder folder("write");
    const auto path = folder / "pipe";
    BOOST_REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    talus::require_writable(path);  // does not wait for a reader
    BOOST_TEST(talus::is_stream(path));
    std::string read;
    std::thread reader([&] { read = content_of(path); });
    talus::write_file(path, "through");
    reader.join();
    BOOST_TEST(read == "through");
    BOOST_TEST(std::filesystem::is_fifo(path));
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(an_open_file_is_written_where_it_is) {
    if (!std::filesystem::exists("/dev/fd/0")) return;
    const TemporaryFolder folder("write");
    const int open = ::open((folder / "a.txt").c_str(), O_WRONLY | O_CREAT, 0600);
    BOOST_REQUIRE(open >= 0);
    BOOST_REQUIRE(::write(open, "before ", 7) == 7);
    const auto path = "/dev/fd/" + std::to_string(open);
    BOOST_TEST(talus::is_stream(path));
    talus::write_file(path, "text ");
    BOOST_REQUIRE(::write(open, "after", 5) == 5);
    ::close(open);
    BOOST_TEST(content_of(folder / "a.txt") == "before text after");
    BOOST_TEST(talus::is_standard_output("/dev/stdout"));
    BOOST_TEST(!talus::is_standard_output(folder / "a.txt"));
    BOOST_TEST(!talus::is_standard_output(folder / "b.txt"));
}

BOOST_AUTO_TEST_CASE(a_device_stays_one_and_its_error_names_the_path) {
    // Linux offers a device that is always full; elsewhere there is nothing to try.
    if (!std::filesystem::exists("/dev/full")) return;
    const TemporaryFolder folder("write");
    std::filesystem::create_symlink("/dev/full", folder / "a.txt");
    BOOST_CHECK_EXCEPTION(
        talus::write_file(folder / "a.txt", "x"), std::runtime_error,
        [](const auto& e) { return std::string(e.what()).find("a.txt") != std::string::npos; });
    BOOST_TEST(std::filesystem::is_symlink(folder / "a.txt"));
    BOOST_TEST(std::filesystem::is_character_file("/dev/full"));
}

BOOST_AUTO_TEST_CASE(trying_changes_nothing) {
    const TemporaryFolder folder("write");
    talus::require_writable(folder / "a.txt");
    BOOST_TEST(folder.file_count() == 0);
    talus::write_file(folder / "a.txt", "old");
    talus::require_writable(folder / "a.txt");
    BOOST_TEST(content_of(folder / "a.txt") == "old");
    BOOST_TEST(folder.file_count() == 1);
    BOOST_TEST(!talus::is_stream(folder / "a.txt"));
}

BOOST_AUTO_TEST_CASE(many_at_once_do_not_mix) {
    const TemporaryFolder folder("write");
    std::vector<std::thread> writers;
    for (char letter = 'a'; letter < 'e'; ++letter)
        writers.emplace_back([&folder, letter] {
            for (int k = 0; k < 50; ++k)
                talus::write_file(folder / "same.txt", std::string(10000, letter));
        });
    for (std::thread& writer : writers) writer.join();
    const std::string last = content_of(folder / "same.txt");
    BOOST_TEST(last == std::string(10000, last.at(0)));
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(names_in_errors_are_printable) {
    const TemporaryFolder folder("write");
    BOOST_CHECK_EXCEPTION(
        talus::write_file(folder / "mis\x1bsing/a\n", "x"), std::runtime_error, [](const auto& e) {
            return std::string(e.what()).find(R"(mis\x1bsing/a\n)") != std::string::npos;
        });
}

BOOST_AUTO_TEST_SUITE_END()
