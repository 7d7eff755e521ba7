// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/problem/residual.hpp>

#include <cstddef>
#include <string_view>

namespace talus {

/// How a solve ended.
enum class SolveStatus {
    converged,  ///< the residual of the returned impulses, as a whole and at the worst contact, is
                ///< at or below the tolerance
    iteration_limit,  ///< it is not: allow more iterations, accept a larger tolerance or change the
                      ///< solver
    stalled,          ///< it is not, and more iterations of this solver would not help
    no_solution,      ///< a certificate was found that no impulses obey all laws, however small
                      ///< the residual of very large ones may be: change the data
    stopped,          ///< an observer asked to stop
    not_finite,  ///< input or arithmetic produced NaN or infinity: the impulses are the last finite
};

/// A point of a solve's history.
struct ResidualSample {
    int iteration;
    double residual;
};

/// The part of one engine in a solve that is made of several.
struct SolveStage {
    std::string_view engine;  ///< its name, a literal
    int iterations;           ///< its own
    double residual;          ///< when it ended [-]
};

/// What a solver says of its answer. `residual` is always that of `problem/residual.hpp`, evaluated
/// at the impulses returned.
struct SolveReport {
    SolveStatus status = SolveStatus::iteration_limit;
    int iterations = 0;     ///< sweeps, factorisations...: what the solver counts
    double residual = 0.0;  ///< what the tolerance is set on: Residual::relative [-]
    double whole = 0.0;     ///< relative natural-map residual of all contacts together [-]
    /// The same of the worst contact, in the scale of its island [-].
    double contact_error = 0.0;
    /// What rounding beside impulses that large may hide of that [-].
    double rounding = 0.0;
    double velocity_error = 0.0;  ///< largest velocity by which a contact violates its law [m/s]
    std::size_t fastest_contact = 0;  ///< of that velocity
    std::size_t worst_contact = 0;    ///< the contact that is worst in the scale of its island
    /// Whether the residual is above what the solver aims at beyond its tolerance, if it does
    /// (AcceleratedGaussSeidel).
    bool short_of_aim = false;
    Column<ResidualSample> history;  ///< residuals evaluated on the way, in order
    Column<SolveStage> stages;       ///< who did what, where several engines took part

    /// Adds to a history of at most `limit` samples; from then on the last one is replaced.
    [[gnu::noinline]] void note(int iteration, double residual_then, std::size_t limit) {
        if (history.size() == limit) history.pop_back();
        history.push_back({iteration, residual_then});
    }
    void take(const Residual& r) {
        residual = r.relative;
        whole = r.whole;
        contact_error = r.contact;
        rounding = r.rounding;
        velocity_error = r.velocity;
        fastest_contact = r.fastest_contact;
        worst_contact = r.worst_contact;
    }
    /// Adds what an engine did that ended at `end`: its iterations, history and a stage.
    void add_stage(std::string_view engine, const SolveReport& part, double end) {
        for (const ResidualSample& s : part.history)
            history.push_back({iterations + s.iteration, s.residual});
        iterations += part.iterations;
        stages.push_back({engine, part.iterations, end});
    }
};

/// The word for a status, as its enumerator is written.
constexpr std::string_view to_string(SolveStatus status) {
    switch (status) {
        case SolveStatus::converged:
            return "converged";
        case SolveStatus::iteration_limit:
            return "iteration_limit";
        case SolveStatus::stalled:
            return "stalled";
        case SolveStatus::no_solution:
            return "no_solution";
        case SolveStatus::stopped:
            return "stopped";
        case SolveStatus::not_finite:
            return "not_finite";
    }
    return "unknown";
}

}  // namespace talus
