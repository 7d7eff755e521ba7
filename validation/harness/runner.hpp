// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case.hpp"

namespace validation {

enum class Verdict { passed, failed, error };
std::string name_of(Verdict v);

/// What became of a case in one dimension.
struct Result {
    const Case* of = nullptr;
    int dim = 2;
    Verdict verdict = Verdict::error;
    std::string error;  ///< what an exception said
    double seconds = 0.0;
    TrialRecord record{TrialParams{}};

    /// Seconds that a case of its gate should not exceed.
    double budget() const;
    /// The check that uses most of its bound.
    double worst_ratio() const;
};

/// A case met by a fault.
struct Cell {
    const Case* of = nullptr;
    int dim = 2;
    Fault fault = Fault::none;
    /// The case says that it catches this fault, and does so in this dimension or in none: some
    /// faults show in one dimension only.
    bool claimed = false;
    bool caught = false;
    std::string by;  ///< the check that failed
    double seconds = 0.0;
};

struct RunOptions {
    int jobs = 1;
    bool full = false;
    std::uint64_t seed = 1;
    std::string solver = {};                   ///< empty: each case's own
    std::optional<talus::Scheme> scheme = {};  ///< in place of the one that each case chooses
};

/// One thing to run.
struct Job {
    const Case* of = nullptr;
    int dim = 2;
};

/// Runs the jobs, several at a time; the results are in the order of the jobs and do not depend on
/// how many ran at a time. `done(k)` is called, one at a time, when job k is.
std::vector<Result> run_all(const std::vector<Job>& jobs, const RunOptions& options,
                            const std::function<void(std::size_t, const Result&)>& done);

/// Which faults are tried in which cases, besides the control in all.
struct MutantChoice {
    /// Each fault in the quickest case that claims it, each case under one of its claims, and no
    /// more: what a change is held to. Otherwise every claim.
    bool few = false;
    /// Faults that a case does not claim are tried where it took less than this without a fault
    /// [s].
    double patience = 0.0;
};

/// Runs the jobs under the control and under faults.
std::vector<Cell> run_mutants(const std::vector<Job>& jobs, const std::vector<Result>& sound,
                              const MutantChoice& choice, const RunOptions& options,
                              const std::function<void(std::size_t, std::size_t)>& done);

/// Faults that no case caught, and cases (id and dimension are one line of the matrix) that caught
/// none of their claims.
struct MatrixVerdict {
    std::vector<Fault> survivors;
    std::vector<const Case*> idle;
    std::vector<const Cell*> broken_claims;
    std::vector<const Cell*> unsound;  ///< noticed the control, in which nothing is wrong
    bool good() const {
        return survivors.empty() && idle.empty() && broken_claims.empty() && unsound.empty();
    }
};
MatrixVerdict judge(const std::vector<Cell>& cells);

}  // namespace validation
