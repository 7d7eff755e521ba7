// SPDX-License-Identifier: BSL-1.0
//
// Every solver on every problem at every tolerance: the time of the solve alone, and what the
// impulses returned are worth by the one judge of bench_problem.hpp. README.md says what counts.
#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <variant>
#include <vector>

#include "problem_families.hpp"
#include "problem_files.hpp"
#include "solver_registry.hpp"

namespace bench {
namespace {

struct Options {
    std::string problems = ".*";
    std::string solvers = ".*";
    std::vector<double> tolerances = {1e-3, 1e-4, 1e-6, 1e-8, 1e-12};
    std::vector<std::size_t> sizes;
    std::uint64_t seed = 1;
    double limit = 10.0;
    bool peers = false;
    PeerUnits peer_units = PeerUnits::scaled;
    bool siconos_measure = false;
    std::string files;
    std::string json;
    bool list = false;
};

/// Short solves are repeated until they took this long in all; the median counts, as clocks of
/// virtual machines jump in both directions [s].
constexpr double enough = 0.02;

/// What a solver did in the end.
struct Run {
    Ending ending = Ending::finished;
    Outcome outcome;
    Judgement judgement;
    double own_tolerance = 0.0;  ///< asked of the solver, whose measure may be another [-]
    bool solved = false;
};

/// Solves in a child process, as often as is worth while.
template <int Dim>
Run run_once(const BenchProblem<Dim>& problem, const RegisteredSolver& solver, double tolerance,
             double limit) {
    using Vec = talus::Vector<Dim>;
    const SharedBlock<Vec> shared(problem.contact_count());
    const SharedBlock<Outcome> median(1);
    const std::span<Vec> r = shared.span();
    for (Vec& x : r) x.setZero();
    std::copy(problem.start.begin(), problem.start.end(), r.begin());
    const std::vector<Vec> start(r.begin(), r.end());
    Run run;
    run.own_tolerance = tolerance;
    run.ending = run_in_child([&] {
        double total = 0.0;
        std::vector<Outcome> outcomes;
        do {
            std::copy(start.begin(), start.end(), r.begin());
            LimitedClock clock(limit);
            const Outcome outcome = solver.function<Dim>()(problem, tolerance, clock, r);
            outcomes.push_back(outcome);
            total += std::max(outcome.seconds, 1e-7);
        } while (total < enough);
        const auto middle = outcomes.begin() + static_cast<std::ptrdiff_t>(outcomes.size() / 2);
        std::nth_element(outcomes.begin(), middle, outcomes.end(),
                         [](const Outcome& a, const Outcome& b) { return a.seconds < b.seconds; });
        median.span()[0] = *middle;
    });
    run.outcome = median.span()[0];
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    run.judgement = run.ending == Ending::finished || solver.in_place
                        ? judge<Dim>(problem, r)
                        : Judgement{unknown, unknown, unknown};
    return run;
}

/// Solves to a tolerance of *our* measure: a solver that thinks it has arrived, by a measure of its
/// own, and has not, is asked for more. Only the last run is timed.
template <int Dim>
Run run_until_judged(const BenchProblem<Dim>& problem, const RegisteredSolver& solver,
                     double tolerance, const Options& options) {
    constexpr int attempts = 8;
    double own = tolerance;
    for (int k = 1;; ++k) {
        Run run = run_once(problem, solver, own, options.limit);
        const double residual =
            options.siconos_measure ? run.judgement.residual_siconos : run.judgement.residual;
        const bool finished = run.ending == Ending::finished;
        run.solved = finished && residual <= tolerance;
        const bool thinks_so = finished && run.outcome.converged && std::isfinite(residual);
        if (run.solved || !thinks_so || k == attempts || own < 1e-18) return run;
        own *= std::clamp(0.5 * tolerance / residual, 1e-3, 0.5);
    }
}

/// Holds the problem in use, and no other.
class Workshop {
  public:
    const AnyProblem& problem(const ProblemEntry& entry) {
        if (name_ != entry.name) {
            problem_.reset();
            problem_.emplace(entry.make());
            name_ = entry.name;
        }
        return *problem_;
    }

  private:
    std::string name_;
    std::optional<AnyProblem> problem_;
};

/// One line per case on the standard error, with the time left if it goes on like this.
class Progress {
  public:
    void expect_one_more() { ++expected_; }
    void expect_one_less() { --expected_; }
    void done(const std::string& name, const Run& run, double seconds) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        ++done_;
        const double left = spent.count() / done_ * std::max(expected_ - done_, 0);
        std::fprintf(stderr, "[%d/%d] %s: %.4g ms, residual %.1e, %s; %.0f s left\n", done_,
                     expected_, name.c_str(), 1e3 * seconds, run.judgement.residual,
                     run.solved ? "solved" : "not solved", left);
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    int expected_ = 0, done_ = 0;
};

/// All that the cases share.
struct Session {
    Options options;
    std::vector<ProblemEntry> problems;
    std::vector<RegisteredSolver> solvers;
    Workshop workshop;
    Progress progress;
    /// Runs that the limit ended: tighter tolerances of the same pair are not tried.
    std::map<std::string, Run> out_of_time;
};

std::string text_of(double tolerance) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.0e", tolerance);
    return text.data();
}

void report(benchmark::State& state, const Run& run, double seconds) {
    state.SetIterationTime(seconds);
    state.counters["residual"] = run.judgement.residual;
    state.counters["residual_siconos"] = run.judgement.residual_siconos;
    state.counters["worst_share"] = run.judgement.worst_share;
    state.counters["iterations"] = run.outcome.iterations;
    state.counters["own_tolerance"] = run.own_tolerance;
    state.counters["solved"] = run.solved ? 1.0 : 0.0;
    const char* const word = run.outcome.word.data();
    state.SetLabel(run.ending == Ending::out_of_time ? "out_of_time"
                   : run.ending == Ending::crashed   ? "crashed"
                                                     : word);
}

template <int Dim>
void run_case(benchmark::State& state, Session& session, const std::string& problem_name,
              const RegisteredSolver& solver, const BenchProblem<Dim>& problem, double tolerance) {
    const std::string pair = problem_name + "/" + solver.name;
    state.counters["contacts"] = static_cast<double>(problem.contact_count());
    if (!solver.applies(Dim)) {
        session.progress.expect_one_less();
        state.SkipWithError("does not apply");
        return;
    }
    Run run;
    if (const auto earlier = session.out_of_time.find(pair); earlier != session.out_of_time.end()) {
        run = earlier->second;
    } else if (problem.contact_count() > solver.most_contacts) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        run.judgement = {unknown, unknown, unknown};
        run.outcome.seconds = session.options.limit;
        run.outcome.set_word("too_large");
    } else {
        // Here, so that no child has to.
        if (solver.assembles) problem.assembled();
        run = run_until_judged(problem, solver, tolerance, session.options);
        if (run.ending == Ending::out_of_time) session.out_of_time.emplace(pair, run);
    }
    const double seconds =
        run.ending == Ending::out_of_time ? session.options.limit : run.outcome.seconds;
    report(state, run, seconds);
    session.progress.done(pair + "/" + text_of(tolerance), run, seconds);
}

void register_cases(Session& session) {
    for (const ProblemEntry& entry : session.problems)
        for (const RegisteredSolver& solver : session.solvers)
            for (const double tolerance : session.options.tolerances) {
                if (!solver.applies(entry.dimension)) continue;
                session.progress.expect_one_more();
                const std::string name = entry.name + "/" + solver.name + "/" + text_of(tolerance);
                benchmark::RegisterBenchmark(
                    name.c_str(),
                    [&session, &entry, &solver, tolerance](benchmark::State& state) {
                        const AnyProblem& any = session.workshop.problem(entry);
                        for (auto _ : state)
                            std::visit(
                                [&](const auto& problem) {
                                    run_case(state, session, entry.name, solver, problem,
                                             tolerance);
                                },
                                any);
                    })
                    ->UseManualTime()
                    ->Iterations(1)
                    ->Unit(benchmark::kMillisecond);
            }
}

/// Removes the entries whose name the regular expression is not found in.
template <class Entry>
void keep_matching(std::vector<Entry>& entries, const std::string& expression) {
    const std::regex pattern(expression);
    std::erase_if(entries, [&](const Entry& e) { return !std::regex_search(e.name, pattern); });
}

/// Fills the options; what is left of the arguments is for Google Benchmark.
void read_options(int argc, char** argv, Options& o, std::vector<std::string>& left) {
    CLI::App app(
        "Solvers on contact problems: time and residual. Other options go to Google Benchmark.");
    app.allow_extras();
    app.add_option("--problems", o.problems, "regular expression of their names");
    app.add_option("--solvers", o.solvers, "regular expression of their names");
    app.add_option("--tolerances", o.tolerances, "on the residual")->delimiter(',');
    app.add_option("--sizes", o.sizes, "contacts of the generated problems")->delimiter(',');
    app.add_option("--seed", o.seed, "of the random piles");
    app.add_option("--limit", o.limit, "CPU time per solve [s]")->check(CLI::PositiveNumber);
    app.add_flag("--peers", o.peers, "solvers of other libraries too");
    app.add_option("--peer-units", o.peer_units, "units of the problems that peers get")
        ->transform(CLI::CheckedTransformer(std::map<std::string, PeerUnits>{
            {"given", PeerUnits::given}, {"scaled", PeerUnits::scaled}}));
    app.add_option_function<std::string>(
           "--measure", [&](const std::string& m) { o.siconos_measure = m == "siconos"; },
           "residual that decides: talus or siconos")
        ->check(CLI::IsMember({"talus", "siconos"}));
    app.add_option("--files", o.files, "folder of FCLib files, in place of generated problems")
        ->check(CLI::ExistingDirectory);
    app.add_option("--json", o.json, "where to write the results");
    app.add_flag("--list", o.list, "print the names of problems and solvers");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        std::exit(app.exit(e));
    }
    left = app.remaining();
    if (!o.json.empty()) {
        left.push_back("--benchmark_out=" + o.json);
        left.push_back("--benchmark_out_format=json");
    }
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

/// What a reader of the results needs to know.
void describe(const Options& o) {
    benchmark::AddCustomContext("processor", processor());
    benchmark::AddCustomContext("compiler", TALUS_BENCH_COMPILER);
    benchmark::AddCustomContext("limit_seconds", std::to_string(o.limit));
    benchmark::AddCustomContext("measure", o.siconos_measure ? "siconos" : "talus");
    benchmark::AddCustomContext("peer_units",
                                o.peer_units == PeerUnits::scaled ? "scaled" : "given");
    benchmark::AddCustomContext("seed", std::to_string(o.seed));
}

int run(int argc, char** argv) {
    Session session;
    Options& o = session.options;
    std::vector<std::string> left;
    read_options(argc, argv, o, left);
    session.problems =
        o.files.empty() ? generated_problems(o.sizes, o.seed) : read_problem_files(o.files);
    session.solvers = own_solvers();
    if (o.peers)
        for (auto& solver : peer_solvers(o.peer_units)) session.solvers.push_back(solver);
    keep_matching(session.problems, o.problems);
    keep_matching(session.solvers, o.solvers);
    // A failure at the limit is inherited by what is tighter.
    std::sort(o.tolerances.begin(), o.tolerances.end(), std::greater<>());
    if (o.list) {
        for (const auto& p : session.problems) std::printf("problem %s\n", p.name.c_str());
        for (const auto& s : session.solvers) std::printf("solver %s\n", s.name.c_str());
        return 0;
    }
    describe(o);
    std::vector<char*> arguments{argv[0]};
    for (std::string& text : left) arguments.push_back(text.data());
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
    register_cases(session);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    try {
        return bench::run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench_solvers: %s\n", e.what());
        return 1;
    }
}
