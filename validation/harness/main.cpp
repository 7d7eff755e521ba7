// SPDX-License-Identifier: BSL-1.0
// Runs the validation cases: prints a table, writes report.json.
#include <talus/core/version.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <set>
#include <unistd.h>

#include "report.hpp"

namespace {

using namespace validation;
using nlohmann::ordered_json;

struct Options {
    int gate = 2;
    bool full = false;
    std::string filter;
    int dim = 0;
    int jobs = 1;
    std::uint64_t seed = 1;
    bool list = false;
    bool allow_none = false;  ///< where other programs have cases, no match is no mistake
    bool mutants = false, few_mutants = false;
    std::string solver, scheme;  ///< empty: each case's own
    double patience = 1.0;
    std::string output = "report.json";
    std::string commit, command;
};

std::vector<Job> chosen(const Options& options) {
    const std::regex pattern(options.filter, std::regex::icase);
    std::vector<Job> jobs;
    for (const Case& c : all_cases()) {
        if (c.text.gate > (options.full ? 3 : options.gate)) continue;
        if (options.scheme == "gap_anticipating" && !c.text.midpoint_because.empty()) continue;
        const std::string text = c.text.id + " " + c.text.name + " " + c.family;
        if (!options.filter.empty() && !std::regex_search(text, pattern)) continue;
        for (const int dim : c.dims())
            if (options.dim == 0 || options.dim == dim) jobs.push_back({&c, dim});
    }
    return jobs;
}

void list(const std::vector<Job>& jobs) {
    for (const Job& job : jobs)
        std::printf("%s  %dD  gate %d  class %-2s  %-34s %s\n", job.of->text.id.c_str(), job.dim,
                    job.of->text.gate, name_of(job.of->text.kind).c_str(),
                    job.of->text.name.c_str(), job.of->text.title.c_str());
    std::set<const Case*> cases;
    for (const Job& job : jobs) cases.insert(job.of);
    std::printf("%zu cases, %zu with their dimensions\n", cases.size(), jobs.size());
}

/// A line at the bottom of a terminal: how far, how long still. Nothing where it is no terminal.
class Progress {
  public:
    Progress() : on_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}
    void show(std::size_t done, std::size_t all, const std::string& what) const {
        if (!on_ || done == 0) return;
        const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
        const double left = spent / static_cast<double>(done) * static_cast<double>(all - done);
        std::fprintf(stderr, "\r\033[K%zu of %zu  %s  %.0f s left", done, all, what.c_str(), left);
        std::fflush(stderr);
    }
    void clear() const {
        if (on_) std::fprintf(stderr, "\r\033[K");
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool on_;
    Clock::time_point start_;
};

std::string orders_of(const Result& r) {
    std::string text;
    for (const OrderStudy& s : r.record.orders()) {
        char number[32];
        std::snprintf(number, sizeof number, "%s%.2f", text.empty() ? "" : " ", s.slope);
        text += number;
    }
    return text;
}

void print_result(const Result& r) {
    const auto& t = r.of->text;
    const double ratio = r.worst_ratio();
    char used[32] = "over";
    if (std::isfinite(ratio)) std::snprintf(used, sizeof used, "%.3f", ratio);
    std::printf(
        "%-6s %s %dD %-33s %-2s %4zu checks  worst %6s of bound  %-22s %6.1f s%s\n",
        r.verdict == Verdict::passed ? "ok" : (r.verdict == Verdict::failed ? "FAILED" : "ERROR"),
        t.id.c_str(), r.dim, t.name.c_str(), name_of(t.kind).c_str(), r.record.checks().size(),
        used, r.record.orders().empty() ? "" : ("order " + orders_of(r)).c_str(), r.seconds,
        r.seconds > r.budget() ? "  over its budget" : "");
    if (!r.error.empty()) std::printf("       %s\n", r.error.c_str());
    if (r.verdict == Verdict::passed) return;
    for (const Check& c : r.record.checks())
        if (!c.passed())
            std::printf("       %s%s: measured %.12g, expected %.12g, error %.3g, bound %.3g  %s\n",
                        c.label.c_str(),
                        c.h > 0 ? (" (h = " + std::to_string(c.h) + ")").c_str() : "", c.measured,
                        c.expected, c.error, c.bound, c.note.c_str());
    for (const OrderStudy& s : r.record.orders())
        if (!s.passed()) {
            std::printf("       order of %s: %.3f +- %.3f outside [%.2f, %.2f]\n", s.label.c_str(),
                        s.slope, s.slope_error, s.band.low, s.band.high);
            for (std::size_t k = 0; k < s.h.size(); ++k)
                std::printf("         h = %.3e  error = %.3e\n", s.h[k], s.error[k]);
        }
}

/// Rows are cases, columns faults: X caught as claimed, x caught, . survived, blank not run,
/// ! claimed and survived.
void print_matrix(const std::vector<Cell>& cells, const MatrixVerdict& verdict) {
    std::printf("\nFaults (columns)\n");
    for (std::size_t k = 0; k < fault_texts.size(); ++k) {
        std::size_t caught = 0, run = 0;
        for (const Cell& cell : cells)
            if (cell.fault == fault_texts[k].fault) {
                ++run;
                caught += cell.caught;
            }
        std::printf("  %c  %-28s caught %3zu times of %3zu  %s\n", static_cast<char>('a' + k),
                    std::string(fault_texts[k].name).c_str(), caught, run,
                    std::string(fault_texts[k].title).c_str());
    }
    std::printf(
        "\nX caught as claimed   x caught   . not noticed   ! claimed, not noticed   "
        "blank: not run\n        ");
    for (std::size_t k = 0; k < fault_texts.size(); ++k)
        std::printf(" %c", static_cast<char>('a' + k));
    const Case* last = nullptr;
    int last_dim = 0;
    std::string row;
    const auto flush = [&] {
        if (last) std::printf("\n%s %dD  %s", last->text.id.c_str(), last_dim, row.c_str());
    };
    for (const Cell& cell : cells) {
        if (cell.of != last || cell.dim != last_dim) {
            flush();
            last = cell.of;
            last_dim = cell.dim;
            row.assign(2 * fault_texts.size(), ' ');
        }
        for (std::size_t k = 0; k < fault_texts.size(); ++k)
            if (fault_texts[k].fault == cell.fault)
                row[2 * k + 1] =
                    cell.caught ? (cell.claimed ? 'X' : 'x') : (cell.claimed ? '!' : '.');
    }
    flush();
    std::printf("\n\n");
    const auto longest =
        std::max_element(cells.begin(), cells.end(),
                         [](const Cell& a, const Cell& b) { return a.seconds < b.seconds; });
    if (longest != cells.end())
        std::printf("longest: %s %dD under %s, %.1f s\n", longest->of->text.id.c_str(),
                    longest->dim, std::string(text_of(longest->fault).name).c_str(),
                    longest->seconds);
    for (const Fault fault : verdict.survivors)
        std::printf("SURVIVED  no case noticed: %s\n", std::string(text_of(fault).title).c_str());
    for (const Case* c : verdict.idle)
        std::printf("IDLE      %s %s noticed no fault\n", c->text.id.c_str(), c->text.name.c_str());
    for (const Cell* cell : verdict.unsound)
        std::printf("UNSOUND   %s %dD notices something (%s) where nothing is wrong\n",
                    cell->of->text.id.c_str(), cell->dim, cell->by.c_str());
    for (const Cell* cell : verdict.broken_claims)
        std::printf("BROKEN    %s %dD claims to notice %s and does not\n",
                    cell->of->text.id.c_str(), cell->dim,
                    std::string(text_of(cell->fault).name).c_str());
}

std::string version() {
    return std::to_string(TALUS_VERSION_MAJOR) + "." + std::to_string(TALUS_VERSION_MINOR) + "." +
           std::to_string(TALUS_VERSION_PATCH);
}

std::string now() {
    const std::time_t t = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&t));
    return text;
}

void write(const Options& options, const std::vector<Result>& results, ordered_json mutants,
           double seconds) {
    std::size_t passed = 0, checks = 0;
    std::set<const Case*> cases;
    for (const Result& r : results) {
        passed += r.verdict == Verdict::passed;
        checks += r.record.checks().size() + r.record.orders().size();
        cases.insert(r.of);
    }
    ordered_json env = environment();
    if (!options.commit.empty()) env["commit"] = options.commit;
    const ordered_json report{{"schema", 1},
                              {"talus", version()},
                              {"created", now()},
                              {"command", options.command},
                              {"environment", env},
                              {"options",
                               {{"gate", options.full ? 3 : options.gate},
                                {"full", options.full},
                                {"filter", options.filter},
                                {"dim", options.dim},
                                {"jobs", options.jobs},
                                {"solver", options.solver},
                                {"scheme", options.scheme},
                                {"seed", options.seed}}},
                              {"summary",
                               {{"cases", cases.size()},
                                {"results", results.size()},
                                {"passed", passed},
                                {"failed", results.size() - passed},
                                {"checks", checks},
                                {"seconds", seconds}}},
                              {"cases", report_of(results)},
                              {"mutants", std::move(mutants)}};
    const std::filesystem::path path(options.output);
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path);
    file << report.dump(1) << "\n";
    if (!file.flush()) throw std::runtime_error("cannot write " + options.output);
}

int run(const Options& options) {
    const std::vector<Job> jobs = chosen(options);
    if (options.list) {
        list(jobs);
        return 0;
    }
    if (jobs.empty() && !options.allow_none) {
        std::fprintf(stderr, "no case matches; --list shows them\n");
        return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    RunOptions run_options{options.jobs, options.full, options.seed, options.solver};
    if (!options.scheme.empty())
        run_options.scheme = options.scheme == "midpoint" ? talus::Scheme::midpoint
                                                          : talus::Scheme::gap_anticipating;
    const Progress progress;
    std::size_t done = 0;
    const std::vector<Result> results =
        run_all(jobs, run_options, [&](std::size_t, const Result& r) {
            progress.clear();
            print_result(r);
            std::fflush(stdout);
            progress.show(++done, jobs.size(), "trials");
        });
    progress.clear();
    std::size_t failed = 0;
    std::set<const Case*> cases;
    for (const Result& r : results) {
        failed += r.verdict != Verdict::passed;
        cases.insert(r.of);
    }
    ordered_json mutants = nullptr;
    bool matrix_good = true;
    if (options.mutants && failed == 0) {
        const Progress mutant_progress;
        const auto cells = run_mutants(
            jobs, results, {options.few_mutants, options.patience}, run_options,
            [&](std::size_t k, std::size_t all) { mutant_progress.show(k, all, "mutants"); });
        mutant_progress.clear();
        const MatrixVerdict verdict = judge(cells);
        print_matrix(cells, verdict);
        mutants = matrix_of(cells);
        matrix_good = verdict.good();
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write(options, results, std::move(mutants), seconds);
    std::printf("%zu cases, %zu with their dimensions: %zu passed, %zu failed, %.0f s\n",
                cases.size(), results.size(), results.size() - failed, failed, seconds);
    if (options.mutants && failed > 0)
        std::printf("mutants: not run, since cases fail without them\n");
    else if (options.mutants)
        std::printf("mutants: %s\n", matrix_good ? "every fault caught, no case idle" : "FAILED");
    return failed == 0 && matrix_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Tries talus against closed forms.");
    Options options;
    options.command = "validation/run";
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        // What validation/run adds by itself.
        if (word == "--output" || word == "--commit" || word == "--jobs")
            ++k;
        else if (word != "--allow-none")
            options.command += " " + word;
    }
    app.add_option("--gate", options.gate, "cases up to this gate: 1 seconds, 2 minutes, 3 hours")
        ->check(CLI::Range(1, 3))
        ->capture_default_str();
    app.add_flag("--full", options.full, "all gates, over the longer ranges of parameters");
    app.add_option("--filter", options.filter,
                   "only cases whose id, name or family matches this regular expression");
    app.add_option("--dim", options.dim, "only this dimension")->check(CLI::IsMember({2, 3}));
    app.add_option("--jobs", options.jobs, "trials at a time")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--seed", options.seed, "of all random realisations")->capture_default_str();
    app.add_flag("--list", options.list, "list the cases and stop");
    app.add_flag("--allow-none", options.allow_none, "a report of no case is one, too");
    app.add_option("--solver", options.solver, "in place of the one that each case chooses")
        ->check(CLI::IsMember(solver_names()));
    app.add_option("--scheme", options.scheme, "in place of the one that each case chooses")
        ->check(CLI::IsMember({"midpoint", "gap_anticipating"}));
    app.add_flag("--mutants", options.mutants,
                 "put each fault into the method and see who notices");
    app.add_flag("--few-mutants", options.few_mutants,
                 "put each fault into its quickest case and see whether it is noticed");
    app.add_option("--patience", options.patience,
                   "faults that a case does not claim are tried where it takes less than this [s]")
        ->capture_default_str();
    app.add_option("--output", options.output, "where report.json goes")->capture_default_str();
    app.add_option("--commit", options.commit, "what to call the state of the repository");
    CLI11_PARSE(app, argc, argv);
    options.mutants |= options.few_mutants;
    try {
        return run(options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "validation: %s\n", e.what());
        return 2;
    }
}
