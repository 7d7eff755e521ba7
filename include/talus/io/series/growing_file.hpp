// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/write_file.hpp>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace talus::detail {

/// A file that text is added to: each text is handed to the system when it is written, so that a
/// run that is killed leaves all but, at worst, a part of the last. A device or pipe is written as
/// it is.
class GrowingFile {
  public:
    /// In place of any that stands there. Throws std::runtime_error naming the path if it cannot be
    /// written; so do all members.
    static GrowingFile begun(std::filesystem::path path) { return {std::move(path), O_TRUNC}; }
    /// After what stands there.
    static GrowingFile continued(std::filesystem::path path) { return {std::move(path), 0}; }

    void write(std::string_view text) {
        const int error = write_all(file_.id(), text);
        if (error != 0) fail_to_write(path_, error);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    GrowingFile(std::filesystem::path path, int how)
        : path_(std::move(path)), file_(opened(path_, how)) {}

    static int opened(const std::filesystem::path& path, int how) {
        const Output output = output_of(path);
        const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY;
        const int id =
            output.descriptor >= 0
                ? ::dup(output.descriptor)
                : ::open(output.file.c_str(), mode | (output.stream ? 0 : how | O_APPEND), 0666);
        if (id < 0) fail_to_write(path, errno);
        return id;
    }

    std::filesystem::path path_;
    FileDescriptor file_;
};

}  // namespace talus::detail
