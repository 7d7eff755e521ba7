// SPDX-License-Identifier: BSL-1.0
//
// usage: fclib_reader FILE    writes a small problem to FILE and reads it with FCLib's own code
#include <talus/io/problem_file.hpp>

#include <Eigen/Core>

#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "common/random_problem.hpp"

extern "C" {
#include <fclib.h>
}

namespace {

int faults = 0;

void expect(bool fine, const char* what) {
    if (fine) return;
    std::printf("FCLib finds otherwise: %s\n", what);
    ++faults;
}

template <class Stored>
void expect_same(const double* found, const Stored& written, const char* what) {
    for (const auto& v : written)
        for (Eigen::Index d = 0; d < v.size(); ++d) expect(*found++ == v[d], what);
}

/// Entry (row, column) of a matrix of any storage.
double entry(const fclib_matrix& m, int row, int column) {
    double sum = 0.0;
    const int lines = m.nz == -1 ? m.n : m.nz == -2 ? m.m : 0;
    for (int k = 0; k < m.nz; ++k)
        if (m.i[k] == row && m.p[k] == column) sum += m.x[k];
    for (int line = 0; line < lines; ++line)
        for (int k = m.p[line]; k < m.p[line + 1]; ++k)
            if (m.nz == -1 ? line == column && m.i[k] == row : line == row && m.i[k] == column)
                sum += m.x[k];
    return sum;
}

template <class Written>
void expect_same(const fclib_matrix& found, const Written& written, const char* what) {
    expect(found.m == written.rows() && found.n == written.cols(), what);
    for (int i = 0; i < found.m; ++i)
        for (int j = 0; j < found.n; ++j) expect(entry(found, i, j) == written.coeff(i, j), what);
}

template <int Dim>
void check(const char* path, talus::MatrixStorage storage) {
    RandomBlocks random(5);
    talus::ProblemContent<Dim> content;
    content.global = talus::global_form(
        RandomProblem<Dim, talus::Coulomb<Dim>>{}.make(random, talus::Coulomb<Dim>{0.4}));
    content.local = talus::assembled(*content.global);
    content.info = {"a title", "some words", ""};
    const std::vector<talus::Vector<Dim>> r(content.global->contact_count(),
                                            talus::Vector<Dim>::Ones());
    content.solution = talus::solution_of<Dim>(*content.global, r);
    content.guesses = {*content.solution, *content.solution};
    talus::write_problem(path, content, storage);

    fclib_local* local = fclib_read_local(path);
    fclib_global* global = fclib_read_global(path);
    fclib_solution* solution = fclib_read_solution(path);
    int guess_count = 0;
    fclib_solution* guesses = fclib_read_guesses(path, &guess_count);
    expect(local->spacedim == Dim && global->spacedim == Dim, "spacedim");
    expect_same(*local->W, talus::detail::sparse_matrix(content.local->delassus), "W");
    expect_same(local->q, content.local->free_velocity, "q");
    expect_same(*global->M, content.global->mass, "M");
    expect_same(*global->H, content.global->contact_map, "H");
    expect_same(global->w, content.global->velocity_offset, "w");
    expect(global->f[0] == content.global->force[0], "f");
    expect(global->mu[1] == 0.4 && local->mu[1] == 0.4, "mu");
    expect(std::string(global->info->title) == "a title", "title");
    expect(std::string(local->info->math_info).empty(), "math_info");
    expect_same(solution->r, content.solution->impulse, "r");
    expect_same(solution->u, content.solution->relative_velocity, "u");
    expect(solution->v[0] == content.solution->velocity[0], "v");
    expect(guess_count == 2, "number of guesses");
    expect_same(guesses[1].r, content.solution->impulse, "r of a guess");
    fclib_delete_solutions(guesses, guess_count);
    fclib_delete_solutions(solution, 1);
    fclib_delete_global(global);
    fclib_delete_local(local);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    using enum talus::MatrixStorage;
    for (const auto storage : {triplets, compressed_columns, compressed_rows}) {
        check<2>(argv[1], storage);
        check<3>(argv[1], storage);
    }
    std::remove(argv[1]);
    if (faults == 0) std::printf("FCLib reads what was written\n");
    return faults == 0 ? 0 : 1;
}
