// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace talus {

/// Writes `text` to `path`, whole or not at all: to a neighbouring temporary name first, renamed
/// when everything is on disk. Throws std::runtime_error naming the path; nothing is left behind
/// then, and what stood at `path` before stands there still.
inline void write_file(const std::filesystem::path& path, std::string_view text) {
    std::filesystem::path part = path;
    part += ".part";
    std::error_code error;
    try {
        std::ofstream file(part, std::ios::binary | std::ios::trunc);
        if (!file) throw std::runtime_error("cannot create " + part.string());
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
        file.close();
        if (!file) throw std::runtime_error("cannot write all of " + path.string());
        std::filesystem::rename(part, path, error);
        if (error)
            throw std::runtime_error("cannot write " + path.string() + ": " + error.message());
    } catch (...) {
        std::filesystem::remove(part, error);
        throw;
    }
}

}  // namespace talus
