// SPDX-License-Identifier: BSL-1.0
#include <talus/core/input.hpp>
#ifdef TALUS_BENCH_HDF5
#include <talus/io/problem_file.hpp>
#endif

#include <algorithm>

#include "problem_files.hpp"

namespace bench {

#ifdef TALUS_BENCH_HDF5

namespace {

template <int Dim>
AnyProblem read(const std::filesystem::path& path) {
    const auto content = talus::read_problem<Dim>(path);
    if (content.global) return BenchProblem<Dim>(*content.global);
    return BenchProblem<Dim>(talus::assembled(content));
}

}  // namespace

std::vector<ProblemEntry> read_problem_files(const std::filesystem::path& folder) {
    talus::silence_hdf5();
    std::vector<std::filesystem::path> paths;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
        if (file.path().extension() == ".hdf5") paths.push_back(file.path());
    std::sort(paths.begin(), paths.end());
    std::vector<ProblemEntry> entries;
    for (const auto& path : paths) {
        const int dimension = talus::problem_dimension(path);
        entries.push_back({path.stem().string(),
                           [=] { return dimension == 2 ? read<2>(path) : read<3>(path); },
                           dimension});
    }
    return entries;
}

#else

std::vector<ProblemEntry> read_problem_files(const std::filesystem::path& folder) {
    throw talus::input_error("this build reads no problem files, asked for in " + folder.string());
}

#endif

}  // namespace bench
