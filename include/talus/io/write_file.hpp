// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/printable.hpp>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace talus {
namespace detail {

[[noreturn]] inline void fail_to_write(const std::filesystem::path& path, int error) {
    throw std::runtime_error("cannot write " + printable(path.string()) + ": " +
                             std::generic_category().message(error));
}

/// An open file, closed when its owner goes.
class FileDescriptor {
  public:
    explicit FileDescriptor(int id) : id_(id) {}
    FileDescriptor(FileDescriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    FileDescriptor& operator=(FileDescriptor&&) = delete;
    ~FileDescriptor() {
        if (id_ >= 0) ::close(id_);
    }
    int id() const { return id_; }
    /// 0, or the error that only closing tells.
    int close() { return ::close(std::exchange(id_, -1)) == 0 ? 0 : errno; }

  private:
    int id_;
};

/// Writes all; returns 0 or the error.
inline int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ::ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

/// Where a path leads.
struct Output {
    std::filesystem::path path;  ///< as it was given
    std::filesystem::path file;  ///< symbolic links followed
    bool exists = false;         ///< as a file
    bool stream = false;         ///< a device, a pipe, or a file this program was given open
    int descriptor = -1;         ///< the latter's
    struct ::stat status = {};   ///< if it exists
};

/// The number of an open file of this program, for what /dev/stdout and /dev/fd/3 lead to; -1 else.
inline int open_descriptor(const std::filesystem::path& folder, const std::string& name) {
    int number = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool whole = error == std::errc{} && end == name.data() + name.size();
    const bool ours = folder == "/proc/" + std::to_string(::getpid()) + "/fd";
    return whole && ours ? number : -1;
}

/// Throws std::runtime_error naming the path if nothing can be written there.
inline Output output_of(const std::filesystem::path& path) {
    constexpr int most_links = 40;  // as many as Linux follows
    Output output{path, path};
    std::error_code error;
    for (int links = 0;; ++links) {
        const auto folder = std::filesystem::canonical(
            output.file.has_parent_path() ? output.file.parent_path() : ".", error);
        if (error || links == most_links) fail_to_write(path, error ? error.value() : ELOOP);
        output.file = folder / output.file.filename();
        output.descriptor = open_descriptor(folder, output.file.filename().string());
        if (output.descriptor >= 0) break;
        if (!std::filesystem::is_symlink(output.file, error)) break;
        const auto target = std::filesystem::read_symlink(output.file, error);
        if (error) fail_to_write(path, error.value());
        output.file = target.is_absolute() ? target : folder / target;
    }
    const bool found = output.descriptor >= 0 ? ::fstat(output.descriptor, &output.status) == 0
                                              : ::stat(output.file.c_str(), &output.status) == 0;
    if (!found) {
        if (errno != ENOENT || output.descriptor >= 0) fail_to_write(path, errno);
        if (!output.file.has_filename()) fail_to_write(path, EISDIR);
        return output;
    }
    output.exists = true;
    if (S_ISDIR(output.status.st_mode)) fail_to_write(path, EISDIR);
    output.stream = output.descriptor >= 0 || !S_ISREG(output.status.st_mode);
    // What is there and may not be written stays, though its folder would allow to replace it.
    if (output.descriptor < 0 && ::access(output.file.c_str(), W_OK) != 0)
        fail_to_write(path, errno);
    return output;
}

/// A new file beside the one it is to replace, under a name that no other file has, gone with its
/// owner unless it took its place.
class NeighbourFile {
  public:
    explicit NeighbourFile(const Output& output) : output_(output), file_(create()) {}
    NeighbourFile(const NeighbourFile&) = delete;
    NeighbourFile& operator=(const NeighbourFile&) = delete;
    ~NeighbourFile() {
        if (!name_.empty()) ::unlink(name_.c_str());
    }

    void replace_with(std::string_view text) {
        int error = write_all(file_.id(), text);
        if (error == 0 && output_.exists) error = keep_owner_and_mode();
        // Some file systems have no such thing as on disk.
        if (error == 0 && ::fsync(file_.id()) != 0 && errno != EINVAL) error = errno;
        const int closing = file_.close();
        if (error == 0) error = closing;
        if (error == 0 && ::rename(name_.c_str(), output_.file.c_str()) != 0) error = errno;
        if (error != 0) fail_to_write(output_.path, error);
        name_.clear();
    }

  private:
    /// Its mode is what the user's mask allows, as for any new file.
    FileDescriptor create() {
        static std::atomic<unsigned> last{0};
        for (;;) {
            name_ = output_.file.parent_path() / (".talus-" + std::to_string(::getpid()) + "-" +
                                                  std::to_string(++last) + ".part");
            FileDescriptor file(
                ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
            if (file.id() >= 0) return file;
            const int error = errno;
            if (error == EEXIST || error == EINTR) continue;
            name_.clear();
            fail_to_write(output_.path, error);
        }
    }
    int keep_owner_and_mode() const {
        // Only root may give files away: for others the new file is theirs, and none of its bits
        // may lend the rights of an owner.
        ::mode_t kept = 07777;
        if (::fchown(file_.id(), output_.status.st_uid, output_.status.st_gid) != 0) {
            if (errno != EPERM) return errno;
            kept = 0777;
        }
        return ::fchmod(file_.id(), output_.status.st_mode & kept) == 0 ? 0 : errno;
    }

    const Output& output_;
    std::filesystem::path name_;
    FileDescriptor file_;
};

}  // namespace detail

/// Whether what is written to `path` goes on to somewhere else (a device, a pipe, /dev/stdout) and
/// so cannot be replaced later. Throws std::runtime_error naming the path if it cannot be written.
inline bool is_stream(const std::filesystem::path& path) { return detail::output_of(path).stream; }

/// Whether what is written to `path` comes out of this program's standard output.
inline bool is_standard_output(const std::filesystem::path& path) {
    const detail::Output output = detail::output_of(path);
    struct ::stat standard = {};
    return output.exists && ::fstat(STDOUT_FILENO, &standard) == 0 &&
           standard.st_dev == output.status.st_dev && standard.st_ino == output.status.st_ino;
}

/// Throws std::runtime_error, as write_file would, if `path` cannot be written now. Changes
/// nothing.
inline void require_writable(const std::filesystem::path& path) {
    const detail::Output output = detail::output_of(path);
    if (!output.stream) const detail::NeighbourFile tried(output);
}

/// Writes `text` to `path`, whole or not at all: to a new file beside it first, which takes its
/// place when everything is on disk. A symbolic link stays one, and what it leads to is replaced;
/// the mode of a file that was there is kept, and its owner if it may be. (Its other names, by hard
/// links, keep the old content.) Devices, pipes and files that the program was given open, as by
/// /dev/stdout, are written as they are. Throws std::runtime_error naming the path; nothing is left
/// behind then, and what stood at `path` before stands there still.
inline void write_file(const std::filesystem::path& path, std::string_view text) {
    const detail::Output output = detail::output_of(path);
    if (!output.stream) return detail::NeighbourFile(output).replace_with(text);
    const bool given = output.descriptor >= 0;
    const detail::FileDescriptor opened(
        given ? -1 : ::open(output.file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (!given && opened.id() < 0) detail::fail_to_write(path, errno);
    const int error = detail::write_all(given ? output.descriptor : opened.id(), text);
    if (error != 0) detail::fail_to_write(path, error);
}

}  // namespace talus
