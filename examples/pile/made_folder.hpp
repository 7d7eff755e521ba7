// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/printable.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace pile {

/// Makes a folder and those above it; takes those that it made away again unless told to keep them.
class MadeFolder {
  public:
    /// Throws std::runtime_error naming the folder.
    explicit MadeFolder(const std::filesystem::path& folder) {
        std::error_code error;
        for (auto f = folder; !f.empty() && !std::filesystem::exists(f, error); f = f.parent_path())
            if (f.has_filename()) made_.push_back(f);  // "a/" is "a" again
        std::filesystem::create_directories(folder, error);
        if (!error && std::filesystem::is_directory(folder, error)) return;
        const std::string why = error ? error.message() : "it is no folder";
        take_away();
        throw std::runtime_error("cannot make the folder " +
                                 talus::detail::printable(folder.string()) + ": " + why);
    }
    ~MadeFolder() { take_away(); }
    MadeFolder(const MadeFolder&) = delete;
    MadeFolder& operator=(const MadeFolder&) = delete;
    void keep() { made_.clear(); }

  private:
    void take_away() {
        std::error_code ignored;  // also: what others put in meanwhile stays
        for (const auto& folder : made_) std::filesystem::remove(folder, ignored);
        made_.clear();
    }
    std::vector<std::filesystem::path> made_;  // the innermost first
};

}  // namespace pile
