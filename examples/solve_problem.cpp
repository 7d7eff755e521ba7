// SPDX-License-Identifier: BSL-1.0
//
// Contact problems from files of other codes (FCLib's format): each is solved from zero impulses,
// and judged twice: by the residual of problem/residual.hpp, which does not depend on units, and by
// the absolute natural map of the exact law in the file's units, as Siconos does.
//
// Sample run:  solve_problem KaplasTower-i1061-4.hdf5 --tolerance 1e-6 --json verdict.json
// Exit code: 0 if all converged, 1 if some did not, 2 on wrong options or files.
#include <talus/io/problem_file.hpp>
#include <talus/io/write_file.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/any_solver.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "number_option.hpp"
#include "solve_problem/file_units.hpp"

namespace {

template <int Dim>
using Law = talus::Coulomb<Dim>;

struct Options {
    std::vector<std::string> files;
    std::string solver = "automatic";
    talus::SolverSettings settings;
    std::string json;  ///< file; empty: none
};

template <int Dim>
nlohmann::json solve(const std::string& file, const Options& o) {
    const auto content = talus::read_problem<Dim>(file);
    auto problem = talus::assembled(content);
    std::vector<talus::Vector<Dim>> r(problem.contact_count(), talus::Vector<Dim>::Zero());
    auto solver = talus::make_solver<Dim, Law<Dim>>(o.solver, o.settings);
    const auto start = std::chrono::steady_clock::now();
    const auto report = solver.solve(problem, r);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    return {{"name", std::filesystem::path(file).stem().string()},
            {"dimension", Dim},
            {"contacts", problem.contact_count()},
            {"solver", o.solver},
            {"status", std::string(to_string(report.status))},
            {"iterations", report.iterations},
            {"seconds", time.count()},
            {"residual", report.residual},
            {"residual_in_file_units", solve_problem::residual_in_file_units<Dim>(problem, r)}};
}

/// A line of the table.
void print(std::FILE* words, const nlohmann::json& j) {
    std::fprintf(words, "%-40s %dD %5zu  %s %-15s %6d iterations %10.3f ms  %.1e  %.1e\n",
                 talus::detail::printable(j["name"].get<std::string>()).c_str(),
                 j["dimension"].get<int>(), j["contacts"].get<std::size_t>(),
                 j["solver"].get<std::string>().c_str(), j["status"].get<std::string>().c_str(),
                 j["iterations"].get<int>(), 1e3 * j["seconds"].get<double>(),
                 j["residual"].get<double>(), j["residual_in_file_units"].get<double>());
}

/// Solves all that can be; returns the exit code.
int run(const Options& o) {
    // A wrong name or setting is said once, not for every file; and whether the figures can be
    // kept, before there are any.
    talus::make_solver<3, Law<3>>(o.solver, o.settings);
    if (!o.json.empty()) talus::require_writable(o.json);
    std::FILE* const words = !o.json.empty() && talus::is_standard_output(o.json) ? stderr : stdout;
    nlohmann::json all = nlohmann::json::array();
    bool converged = true, refused = false;
    std::fprintf(
        words,
        "problem, dimension, contacts, solver, status, iterations, time, residual, residual in "
        "file units\n");
    for (const auto& file : o.files) try {
            all.push_back(talus::problem_dimension(file) == 2 ? solve<2>(file, o)
                                                              : solve<3>(file, o));
            print(words, all.back());
            converged = converged && all.back()["status"] == "converged";
        } catch (const talus::input_error& error) {
            std::fprintf(stderr, "solve_problem: %s\n", error.what());
            refused = true;
        }
    if (!o.json.empty())
        talus::write_file(o.json,
                          all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return refused ? 2 : converged ? 0 : 1;
}

/// What --help says of solvers.
std::string known_solvers() {
    std::string text = "one of:";
    for (const auto& [name, description] : talus::solver_names<3, Law<3>>())
        text += "\n" + std::string(name) + ": " + std::string(description);
    return text;
}

/// Reads the command line; nothing if it asked for help, which was then printed. Throws
/// input_error, one sentence, on anything wrong.
std::optional<Options> read_options(int argc, char** argv) {
    Options o;
    double iterations = -1.0;  // not given
    CLI::App app(
        "Solves contact problems with Coulomb friction from files in FCLib's HDF5 format, from "
        "zero\n"
        "impulses, and prints one line for each.\n",
        "solve_problem");
    app.footer("Exit code: 0 if all converged, 1 if some did not, 2 on wrong options or files.\n");
    app.add_option("FILE", o.files, "problem files")->required();
    app.add_option("--solver", o.solver, known_solvers());
    add_number(app, "--tolerance", o.settings.tolerance, 0, 1, "on the residual (1e-8)");
    add_number(app, "--iterations", iterations, 0, 1e9,
               "allowed per problem (the solver's own limit)");
    app.add_option(
        "--json", o.json,
        "file for the same figures; - or /dev/stdout: standard output, the table then goes to "
        "standard error");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success&) {
        std::fputs(app.help().c_str(), stdout);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw talus::input_error(std::string(error.what()) +
                                 " (solve_problem --help lists the options)");
    }
    if (iterations >= 0.0) o.settings.max_iterations = static_cast<int>(iterations);
    if (o.json == "-") o.json = "/dev/stdout";
    return o;
}

}  // namespace

int main(int argc, char** argv) {
    talus::silence_hdf5();
    try {
        const auto options = read_options(argc, argv);
        return options ? run(*options) : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "solve_problem: %s\n", talus::detail::printable(error.what()).c_str());
        return 2;
    }
}
