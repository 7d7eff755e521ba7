// SPDX-License-Identifier: BSL-1.0
#include "runner.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

namespace validation {

namespace {

template <int Dim>
void run_in(Result& result, const TrialParams& params) {
    Trial<Dim> trial(params);
    try {
        if constexpr (Dim == 2)
            result.of->plane(trial);
        else
            result.of->space(trial);
        trial.close();
        result.verdict = trial.passed() ? Verdict::passed : Verdict::failed;
    } catch (const Caught& caught) {
        result.verdict = Verdict::failed;
        result.error = caught.by;
    } catch (const std::exception& e) {
        result.verdict = Verdict::error;
        result.error = e.what();
    }
    result.record = std::move(static_cast<TrialRecord&>(trial));
}

Result run_one(const Job& job, const TrialParams& params) {
    Result result;
    result.of = job.of;
    result.dim = job.dim;
    const auto start = std::chrono::steady_clock::now();
    if (job.dim == 2)
        run_in<2>(result, params);
    else
        run_in<3>(result, params);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// Calls work(k) for k < n from several threads.
template <class Work>
void in_parallel(std::size_t n, int jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto loop = [&] {
        for (std::size_t k = next++; k < n; k = next++) work(k);
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back(loop);
    loop();
    for (std::thread& t : threads) t.join();
}

}  // namespace

std::string name_of(Verdict v) {
    switch (v) {
        case Verdict::passed:
            return "passed";
        case Verdict::failed:
            return "failed";
        case Verdict::error:
            return "error";
    }
    return "?";
}

double Result::budget() const {
    switch (of->text.gate) {
        case 1:
            return 10.0;
        case 2:
            return 60.0;
        default:
            return 3600.0;
    }
}

double Result::worst_ratio() const {
    double worst = 0.0;
    for (const Check& c : record.checks()) worst = std::max(worst, c.ratio());
    return worst;
}

std::vector<Result> run_all(const std::vector<Job>& jobs, const RunOptions& options,
                            const std::function<void(std::size_t, const Result&)>& done) {
    std::vector<Result> results(jobs.size());
    std::mutex mutex;
    in_parallel(jobs.size(), options.jobs, [&](std::size_t k) {
        Result result = run_one(jobs[k], {Fault::none, options.full, false, options.seed,
                                          options.solver, options.scheme});
        const std::lock_guard lock(mutex);
        results[k] = std::move(result);
        done(k, results[k]);
    });
    return results;
}

namespace {

bool claims(const Case& of, Fault fault) {
    return std::find(of.text.catches.begin(), of.text.catches.end(), fault) !=
           of.text.catches.end();
}

/// Of each case the claims that MutantChoice::few asks for.
std::set<std::pair<const Case*, Fault>> few_claims(const std::vector<Job>& jobs,
                                                   const std::vector<Result>& sound) {
    // Of a case's dimensions the one that catches may be any: they count together.
    std::map<const Case*, double> seconds;
    for (std::size_t k = 0; k < jobs.size(); ++k) seconds[jobs[k].of] += sound[k].seconds;
    std::set<std::pair<const Case*, Fault>> chosen;
    std::set<const Case*> busy;
    for (const FaultText& text : fault_texts) {
        const Case* quickest = nullptr;
        for (const Job& job : jobs)
            if (claims(*job.of, text.fault) &&
                (quickest == nullptr || seconds[job.of] < seconds[quickest]))
                quickest = job.of;
        if (quickest == nullptr) continue;
        chosen.insert({quickest, text.fault});
        busy.insert(quickest);
    }
    for (const Job& job : jobs)
        if (!busy.contains(job.of) && !job.of->text.catches.empty())
            chosen.insert({job.of, job.of->text.catches.front()});
    return chosen;
}

}  // namespace

std::vector<Cell> run_mutants(const std::vector<Job>& jobs, const std::vector<Result>& sound,
                              const MutantChoice& choice, const RunOptions& options,
                              const std::function<void(std::size_t, std::size_t)>& done) {
    std::vector<Cell> cells;
    const auto few = choice.few ? few_claims(jobs, sound) : decltype(few_claims(jobs, sound)){};
    for (std::size_t k = 0; k < jobs.size(); ++k) {
        cells.push_back({jobs[k].of, jobs[k].dim, Fault::control, false, false, {}, 0.0});
        for (const FaultText& text : fault_texts) {
            const bool claimed = claims(*jobs[k].of, text.fault);
            if (choice.few ? few.contains({jobs[k].of, text.fault})
                           : claimed || sound[k].seconds <= choice.patience)
                cells.push_back({jobs[k].of, jobs[k].dim, text.fault, claimed, false, {}, 0.0});
        }
    }
    std::mutex mutex;
    std::size_t finished = 0;
    in_parallel(cells.size(), options.jobs, [&](std::size_t k) {
        Cell cell = cells[k];
        const Result result =
            run_one({cell.of, cell.dim},
                    {cell.fault, options.full, true, options.seed, options.solver, options.scheme});
        cell.caught = result.verdict != Verdict::passed;
        cell.by = result.verdict == Verdict::error ? "exception: " + result.error : result.error;
        // The residual is added on closing, without a throw from within the case.
        if (cell.caught && cell.by.empty())
            for (const Check& c : result.record.checks())
                if (!c.passed()) cell.by = c.label;
        cell.seconds = result.seconds;
        const std::lock_guard lock(mutex);
        cells[k] = std::move(cell);
        done(++finished, cells.size());
    });
    std::set<std::pair<const Case*, Fault>> kept;
    for (const Cell& cell : cells)
        if (cell.claimed && cell.caught) kept.insert({cell.of, cell.fault});
    for (Cell& cell : cells)
        if (cell.claimed && !cell.caught && kept.contains({cell.of, cell.fault}))
            cell.claimed = false;
    return cells;
}

MatrixVerdict judge(const std::vector<Cell>& cells) {
    MatrixVerdict verdict;
    std::set<Fault> caught;
    std::set<const Case*> all, busy;
    for (const Cell& cell : cells) {
        all.insert(cell.of);
        if (!cell.caught) continue;
        if (cell.fault == Fault::control) {
            verdict.unsound.push_back(&cell);
            continue;
        }
        caught.insert(cell.fault);
        busy.insert(cell.of);
    }
    for (const FaultText& text : fault_texts)
        if (!caught.contains(text.fault)) verdict.survivors.push_back(text.fault);
    for (const Case* c : all)
        if (!busy.contains(c)) verdict.idle.push_back(c);
    for (const Cell& cell : cells)
        if (cell.claimed && !cell.caught) verdict.broken_claims.push_back(&cell);
    return verdict;
}

}  // namespace validation
