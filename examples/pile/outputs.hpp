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
#include "made_folder.hpp"

namespace pile {

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
