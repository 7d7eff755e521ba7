// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/io/write_file.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "job.hpp"

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

/// Finds out whether the results of a run can be written, before time is spent on it. Makes the
/// folder for pictures; all else stays as it is. Throws input_error, one sentence, and leaves no
/// folder behind then.
inline void try_outputs(const Options& o, const std::vector<int>& dimensions) {
    std::error_code ignored;
    if (!o.json.empty() && !o.scene.empty() &&
        std::filesystem::equivalent(o.json, o.scene, ignored))
        throw talus::input_error("--json is '" + o.json +
                                 "', but must be another file than --scene");
    const char* option = "--out";
    try {
        MadeFolder folder(o.out);
        for (const int dim : dimensions)
            for (const auto& file : picture_files(o.out, dim)) talus::require_writable(file);
        option = "--json";
        if (!o.json.empty()) talus::require_writable(o.json);
        folder.keep();
    } catch (const std::runtime_error& error) {
        throw talus::input_error(std::string(option) + ": " + error.what());
    }
}

}  // namespace pile
