// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <vector>

#include "bench_problem.hpp"

namespace bench {

/// The problems of all FCLib files (*.hdf5) below a folder, in the order of their names; each is
/// read when its turn comes. Throws input_error if this build cannot read them.
std::vector<ProblemEntry> read_problem_files(const std::filesystem::path& folder);

}  // namespace bench
