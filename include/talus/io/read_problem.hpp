// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/hdf5_reader.hpp>
#include <talus/io/problem_content.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus {
namespace detail {

inline const std::string local_group = "fclib_local";
inline const std::string global_group = "fclib_global";

/// The groups of problems in a file; throws input_error if there is none.
inline std::vector<std::string> problem_groups(const Hdf5Reader& in) {
    std::vector<std::string> groups;
    for (const auto& group : {local_group, global_group})
        if (in.has(group)) groups.push_back(group);
    if (groups.empty())
        in.fail(local_group + " and " + global_group, "are missing, but one must be there");
    return groups;
}

inline int read_dimension(const Hdf5Reader& in, const std::string& group) {
    return static_cast<int>(in.integer(group + "/spacedim", 2, 3));
}

/// The entries of a matrix of the given size, whichever of the three forms it is stored in.
inline std::vector<Eigen::Triplet<double>> read_entries(const Hdf5Reader& in,
                                                        const std::string& name, std::size_t rows,
                                                        std::size_t columns) {
    const auto require_size = [&](const char* item, std::size_t size) {
        const auto found = in.integer(name + item, 0);
        if (found != static_cast<std::int64_t>(size))
            in.fail(name + item, found, std::to_string(size) + " here");
    };
    require_size("/m", rows);
    require_size("/n", columns);
    const auto nz = in.integer(name + "/nz", -2);
    const bool triplets = nz >= 0, by_rows = nz == -2;
    std::vector<std::int64_t> p;
    std::size_t count = static_cast<std::size_t>(nz);
    if (!triplets) {
        p = in.integers(name + "/p", (by_rows ? rows : columns) + 1);
        for (std::size_t k = 0; k < p.size(); ++k)
            if (p[k] < (k == 0 ? 0 : p[k - 1]) || (k == 0 && p[k] > 0))
                in.fail(name + "/p[" + std::to_string(k) + "]", p[k],
                        k == 0 ? "0" : "at least " + std::to_string(p[k - 1]));
        count = static_cast<std::size_t>(p.back());
    }
    // nzmax is the room that readers take for the entries; some writers store all of it.
    const auto room = static_cast<std::size_t>(in.integer(name + "/nzmax", 0));
    if (room < count)
        in.fail(name + "/nzmax", static_cast<std::int64_t>(room),
                "at least the number of entries, " + std::to_string(count));
    const std::size_t length = in.length(name + "/x") == room ? room : count;
    const auto x = in.numbers(name + "/x", length);
    const auto i = in.integers(name + "/i", length);
    if (triplets) p = in.integers(name + "/p", length);

    const auto index = [&](const char* item, const std::vector<std::int64_t>& from, std::size_t k,
                           std::size_t end) {
        if (from[k] < 0 || from[k] >= static_cast<std::int64_t>(end))
            in.fail(name + item + "[" + std::to_string(k) + "]", from[k],
                    "in [0, " + std::to_string(end) + ")");
        return static_cast<int>(from[k]);
    };
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(count);
    int line = 0;  // row or column of the compressed forms
    for (std::size_t k = 0; k < count; ++k) {
        if (triplets) {
            entries.emplace_back(index("/i", i, k, rows), index("/p", p, k, columns), x[k]);
            continue;
        }
        while (p[static_cast<std::size_t>(line) + 1] <= static_cast<std::int64_t>(k)) ++line;
        const int across = index("/i", i, k, by_rows ? columns : rows);
        entries.emplace_back(by_rows ? line : across, by_rows ? across : line, x[k]);
    }
    return entries;
}

inline Eigen::SparseMatrix<double> read_sparse(const Hdf5Reader& in, const std::string& name,
                                               std::size_t rows, std::size_t columns) {
    const auto entries = read_entries(in, name, rows, columns);
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(rows),
                                       static_cast<Eigen::Index>(columns));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

template <int Dim>
std::vector<Vector<Dim>> read_vectors(const Hdf5Reader& in, const std::string& name,
                                      std::size_t count) {
    const auto numbers = in.numbers(name, Dim * count);
    std::vector<Vector<Dim>> vectors(count);
    for (std::size_t c = 0; c < count; ++c)
        vectors[c] = Eigen::Map<const Vector<Dim>>(numbers.data() + Dim * c);
    return vectors;
}

template <int Dim>
std::vector<Coulomb<Dim>> read_laws(const Hdf5Reader& in, const std::string& name) {
    std::vector<Coulomb<Dim>> laws;
    for (const double mu : in.numbers(name, in.length(name))) {
        if (mu < 0.0)
            in.fail(name + "[" + std::to_string(laws.size()) + "]",
                    "is " + text_of(mu) + ", but must be finite and not negative");
        laws.push_back({mu});
    }
    return laws;
}

inline void refuse_bilateral(const Hdf5Reader& in, std::initializer_list<std::string> names) {
    for (const auto& name : names)
        if (in.has(name))
            in.fail(name, "is there, but must not be, since bilateral constraints are not read");
}

template <int Dim>
AssembledProblem<Dim, Coulomb<Dim>> read_local(const Hdf5Reader& in) {
    const auto& g = local_group;
    refuse_bilateral(in, {g + "/V", g + "/R", g + "/vectors/s"});
    AssembledProblem<Dim, Coulomb<Dim>> p;
    p.laws = read_laws<Dim>(in, g + "/vectors/mu");
    const std::size_t contacts = p.laws.size();
    p.free_velocity = read_vectors<Dim>(in, g + "/vectors/q", contacts);
    std::vector<DelassusBlock<Dim>> blocks;
    for (const auto& entry : read_entries(in, g + "/W", Dim * contacts, Dim * contacts)) {
        DelassusBlock<Dim> block{static_cast<std::size_t>(entry.row() / Dim),
                                 static_cast<std::size_t>(entry.col() / Dim)};
        block.value(entry.row() % Dim, entry.col() % Dim) = entry.value();
        blocks.push_back(block);
    }
    p.delassus = DelassusSparse<Dim>(contacts, std::move(blocks));
    return p;
}

template <int Dim>
GlobalProblem<Dim, Coulomb<Dim>> read_global(const Hdf5Reader& in) {
    const auto& g = global_group;
    refuse_bilateral(in, {g + "/G", g + "/vectors/b"});
    GlobalProblem<Dim, Coulomb<Dim>> p;
    p.laws = read_laws<Dim>(in, g + "/vectors/mu");
    const std::size_t contacts = p.laws.size();
    p.velocity_offset = read_vectors<Dim>(in, g + "/vectors/w", contacts);
    const std::size_t size = in.length(g + "/vectors/f");
    const auto f = in.numbers(g + "/vectors/f", size);
    p.force = Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Eigen::Index>(size));
    p.mass = read_sparse(in, g + "/M", size, size);
    p.contact_map = read_sparse(in, g + "/H", size, Dim * contacts);
    return p;
}

template <int Dim>
ProblemSolution<Dim> read_solution(const Hdf5Reader& in, const std::string& group,
                                   std::size_t contacts, Eigen::Index velocities) {
    ProblemSolution<Dim> s;
    if (velocities > 0) {
        const auto v = in.numbers(group + "/v", static_cast<std::size_t>(velocities));
        s.velocity = Eigen::Map<const Eigen::VectorXd>(v.data(), velocities);
    }
    s.relative_velocity = read_vectors<Dim>(in, group + "/u", contacts);
    s.impulse = read_vectors<Dim>(in, group + "/r", contacts);
    return s;
}

}  // namespace detail

/// The dimension of the problem in a file, to choose between read_problem<2> and read_problem<3>.
/// Looks at nothing else. Throws input_error.
inline int problem_dimension(const std::filesystem::path& path) {
    const detail::Hdf5Reader in(path);
    return detail::read_dimension(in, detail::problem_groups(in).front());
}

/// Reads a problem file; the format is described in the README of this folder. Throws input_error,
/// one sentence that names file, dataset, value and what is accepted, when anything is not as it
/// should be: a file that is missing or cut off, sizes that disagree, indices out of range, numbers
/// that are not finite, another dimension, bilateral constraints.
template <int Dim>
ProblemContent<Dim> read_problem(const std::filesystem::path& path) {
    const detail::Hdf5Reader in(path);
    ProblemContent<Dim> content;
    const auto groups = detail::problem_groups(in);
    for (const auto& group : groups) {
        const int dimension = detail::read_dimension(in, group);
        if (dimension != Dim)
            in.fail(group + "/spacedim", dimension, std::to_string(Dim) + " here");
        if (group == detail::local_group)
            content.local = detail::read_local<Dim>(in);
        else
            content.global = detail::read_global<Dim>(in);
    }
    const std::string words = groups.front() + "/info/";
    content.info = {in.text(words + "title"), in.text(words + "description"),
                    in.text(words + "math_info")};

    const std::size_t contacts =
        content.local ? content.local->contact_count() : content.global->contact_count();
    if (content.local && content.global && content.global->contact_count() != contacts)
        in.fail("fclib_global/vectors/mu",
                "has length " + std::to_string(content.global->contact_count()) +
                    ", but must have length " + std::to_string(contacts));
    const Eigen::Index velocities = content.global ? content.global->force.size() : 0;
    const auto solution = [&](const std::string& group) {
        return detail::read_solution<Dim>(in, group, contacts, velocities);
    };
    if (in.has("solution")) content.solution = solution("solution");
    if (in.has("guesses")) {
        const auto count = in.integer("guesses/number_of_guesses", 0);
        for (std::int64_t k = 1; k <= count; ++k)
            content.guesses.push_back(solution("guesses/" + std::to_string(k)));
    }
    return content;
}

}  // namespace talus
