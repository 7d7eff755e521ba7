// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/global_form.hpp>
#include <talus/io/hdf5_writer.hpp>
#include <talus/io/problem_content.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// How a matrix is stored in a problem file. Readers of the format take all three.
enum class MatrixStorage { triplets, compressed_columns, compressed_rows };

namespace detail {

inline void require_size(const std::filesystem::path& path, const std::string& item,
                         std::size_t size, std::size_t wanted) {
    if (size != wanted)
        throw input_error(path.string() + ": " + item + " is " + std::to_string(size) +
                          ", but must be " + std::to_string(wanted));
}

template <class Matrix>
void write_compressed(Hdf5Writer& out, const std::string& name, const Matrix& m) {
    out.integers(name + "/p", {m.outerIndexPtr(), static_cast<std::size_t>(m.outerSize()) + 1});
    out.integers(name + "/i", {m.innerIndexPtr(), static_cast<std::size_t>(m.nonZeros())});
    out.numbers(name + "/x", {m.valuePtr(), static_cast<std::size_t>(m.nonZeros())});
}

inline void write_triplets(Hdf5Writer& out, const std::string& name,
                           const Eigen::SparseMatrix<double>& m) {
    std::vector<int> columns;
    for (int j = 0; j < static_cast<int>(m.outerSize()); ++j)
        columns.insert(columns.end(),
                       static_cast<std::size_t>(m.outerIndexPtr()[j + 1] - m.outerIndexPtr()[j]),
                       j);
    out.integers(name + "/p", columns);
    out.integers(name + "/i", {m.innerIndexPtr(), columns.size()});
    out.numbers(name + "/x", {m.valuePtr(), columns.size()});
}

inline void write_matrix(Hdf5Writer& out, const std::string& name, Eigen::SparseMatrix<double> m,
                         MatrixStorage storage) {
    m.makeCompressed();
    const int count = static_cast<int>(m.nonZeros());
    out.integer(name + "/nzmax", count);
    out.integer(name + "/m", static_cast<int>(m.rows()));
    out.integer(name + "/n", static_cast<int>(m.cols()));
    switch (storage) {
        case MatrixStorage::triplets:
            out.integer(name + "/nz", count);
            write_triplets(out, name, m);
            break;
        case MatrixStorage::compressed_columns:
            out.integer(name + "/nz", -1);
            write_compressed(out, name, m);
            break;
        case MatrixStorage::compressed_rows:
            out.integer(name + "/nz", -2);
            write_compressed(out, name, Eigen::SparseMatrix<double, Eigen::RowMajor>(m));
            break;
    }
}

template <int Dim>
void write_vectors(Hdf5Writer& out, const std::string& name,
                   const std::vector<Vector<Dim>>& vectors) {
    std::vector<double> numbers;
    numbers.reserve(Dim * vectors.size());
    for (const auto& v : vectors) numbers.insert(numbers.end(), v.begin(), v.end());
    out.numbers(name, numbers);
}

template <int Dim>
void write_laws(Hdf5Writer& out, const std::filesystem::path& path, const std::string& name,
                const std::vector<Coulomb<Dim>>& laws) {
    std::vector<double> mu;
    for (const auto& law : laws)
        mu.push_back(require_non_negative(
            path.string() + ": " + name + "[" + std::to_string(mu.size()) + "]", law.mu));
    out.numbers(name, mu);
}

/// W as one sparse matrix, all entries of its blocks stored.
template <int Dim>
Eigen::SparseMatrix<double> sparse_matrix(const DelassusSparse<Dim>& w) {
    const std::size_t count = Dim * Dim * w.block_count();
    require_in("number of entries of W", static_cast<double>(count), 0.0,
               std::numeric_limits<int>::max());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(count);
    for (std::size_t i = 0; i < w.contact_count(); ++i)
        for (std::size_t k = 0; k < w.blocks(i).size(); ++k)
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b)
                    entries.emplace_back(static_cast<int>(Dim * i) + a,
                                         static_cast<int>(Dim * w.columns(i)[k]) + b,
                                         w.blocks(i)[k](a, b));
    const auto size = static_cast<Eigen::Index>(Dim * w.contact_count());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

template <int Dim>
void write_solution(Hdf5Writer& out, const std::filesystem::path& path, const std::string& group,
                    const ProblemSolution<Dim>& s, std::size_t contacts, Eigen::Index velocities) {
    require_size(path, "length of " + group + "/u", s.relative_velocity.size(), contacts);
    require_size(path, "length of " + group + "/r", s.impulse.size(), contacts);
    require_size(path, "length of " + group + "/v", static_cast<std::size_t>(s.velocity.size()),
                 static_cast<std::size_t>(velocities));
    if (velocities > 0)
        out.numbers(group + "/v", {s.velocity.data(), static_cast<std::size_t>(velocities)});
    write_vectors<Dim>(out, group + "/u", s.relative_velocity);
    write_vectors<Dim>(out, group + "/r", s.impulse);
}

template <int Dim>
void write_local(Hdf5Writer& out, const std::filesystem::path& path,
                 const AssembledProblem<Dim, Coulomb<Dim>>& p, MatrixStorage storage) {
    const std::string g = "fclib_local";
    require_size(path, "number of rows of blocks of " + g + "/W", p.delassus.contact_count(),
                 p.contact_count());
    require_size(path, "length of " + g + "/vectors/mu", p.laws.size(), p.contact_count());
    out.integer(g + "/spacedim", Dim);
    write_matrix(out, g + "/W", sparse_matrix(p.delassus), storage);
    write_vectors<Dim>(out, g + "/vectors/q", p.free_velocity);
    write_laws(out, path, g + "/vectors/mu", p.laws);
}

template <int Dim>
void write_global(Hdf5Writer& out, const std::filesystem::path& path,
                  const GlobalProblem<Dim, Coulomb<Dim>>& p, MatrixStorage storage) {
    const std::string g = "fclib_global";
    const auto size = static_cast<std::size_t>(p.force.size());
    require_size(path, g + "/M/m", static_cast<std::size_t>(p.mass.rows()), size);
    require_size(path, g + "/M/n", static_cast<std::size_t>(p.mass.cols()), size);
    require_size(path, g + "/H/m", static_cast<std::size_t>(p.contact_map.rows()), size);
    require_size(path, g + "/H/n", static_cast<std::size_t>(p.contact_map.cols()),
                 Dim * p.contact_count());
    require_size(path, "length of " + g + "/vectors/mu", p.laws.size(), p.contact_count());
    out.integer(g + "/spacedim", Dim);
    write_matrix(out, g + "/M", p.mass, storage);
    write_matrix(out, g + "/H", p.contact_map, storage);
    out.numbers(g + "/vectors/f", {p.force.data(), size});
    write_vectors<Dim>(out, g + "/vectors/w", p.velocity_offset);
    write_laws(out, path, g + "/vectors/mu", p.laws);
}

}  // namespace detail

/// Writes a problem file that FCLib, and through it Siconos, reads: whole or not at all. Throws
/// input_error, one sentence, when sizes disagree or a number is not finite; std::runtime_error
/// when the file cannot be written.
template <int Dim>
void write_problem(const std::filesystem::path& path, const ProblemContent<Dim>& content,
                   MatrixStorage storage = MatrixStorage::compressed_columns) {
    if (!content.local && !content.global)
        throw input_error(path.string() + ": number of problems is 0, but must be at least 1");
    detail::Hdf5Writer out(path);
    const auto write_info = [&](const std::string& group) {
        out.text(group + "title", content.info.title);
        out.text(group + "description", content.info.description);
        out.text(group + "math_info", content.info.math_info);
    };
    if (content.local) {
        detail::write_local(out, path, *content.local, storage);
        write_info("fclib_local/info/");
    }
    if (content.global) {
        detail::write_global(out, path, *content.global, storage);
        write_info("fclib_global/info/");
    }
    const std::size_t contacts =
        content.local ? content.local->contact_count() : content.global->contact_count();
    const Eigen::Index velocities = content.global ? content.global->force.size() : 0;
    if (content.solution)
        detail::write_solution(out, path, "solution", *content.solution, contacts, velocities);
    if (!content.guesses.empty())
        out.integer("guesses/number_of_guesses", static_cast<int>(content.guesses.size()));
    for (std::size_t k = 0; k < content.guesses.size(); ++k)
        detail::write_solution(out, path, "guesses/" + std::to_string(k + 1), content.guesses[k],
                               contacts, velocities);
    out.finish();
}

/// The same for a problem without solution. Throws input_error also on a law that is not Coulomb's
/// (those of WeightedMean are: restitution is in the free velocity).
template <int Dim, class Law>
void write_problem(const std::filesystem::path& path, const AssembledProblem<Dim, Law>& p,
                   const ProblemInfo& info = {}) {
    ProblemContent<Dim> content;
    content.local = {p.delassus, p.free_velocity, coulomb_laws<Dim>(p.laws)};
    content.info = info;
    write_problem(path, content);
}
template <int Dim, class Law>
void write_problem(const std::filesystem::path& path, const GlobalProblem<Dim, Law>& p,
                   const ProblemInfo& info = {}) {
    ProblemContent<Dim> content;
    content.global = {p.mass, p.contact_map, p.force, p.velocity_offset, coulomb_laws<Dim>(p.laws)};
    content.info = info;
    write_problem(path, content);
}
/// Of rigid bodies, as a global problem; see global_form.
template <int Dim, class Law>
void write_problem(const std::filesystem::path& path, const ContactProblem<Dim, Law>& p,
                   const ProblemInfo& info = {}) {
    write_problem(path, global_form(p), info);
}

}  // namespace talus
