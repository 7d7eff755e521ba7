// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "figures.hpp"
#include "options.hpp"

namespace pile {

/// One pile to settle, in the plane or in space: what the main program knows of either. Its input
/// was read and found right when it was made.
class Job {
  public:
    virtual ~Job() = default;
    virtual std::string title() const = 0;
    /// Steps until the time is over or a signal asks to stop. What is thrown on the way ends the
    /// run with `Figures::failure`, unless it was the first step.
    virtual Figures run() = 0;
    /// Draws what `run` left into picture_files; returns their names. Throws std::exception where
    /// that fails.
    virtual std::vector<std::string> write_pictures(double mean_grain_weight) const = 0;

    Job() = default;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;
};

// Compiled apart: together they would take the compiler more memory than a small machine has.
std::unique_ptr<Job> plane_job(const Options& options);  ///< plane.cpp
std::unique_ptr<Job> space_job(const Options& options);  ///< space.cpp

/// Files with pictures of a pile of a dimension, in the order they are written.
inline std::vector<std::filesystem::path> picture_files(const std::string& folder, int dim) {
    const std::string base = "pile-" + std::to_string(dim) + "d";
    std::vector<std::filesystem::path> files;
    for (const char* ending : {".svg", "-grains.vtp", "-contacts.vtp"})
        files.push_back(std::filesystem::path(folder) / (base + ending));
    return files;
}

}  // namespace pile
