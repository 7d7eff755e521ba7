// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

namespace talus {

/// How a solve ended.
enum class SolveStatus {
    converged,    ///< the residual of the returned impulses is at or below the tolerance
    sweep_limit,  ///< it is not: allow more sweeps, accept a larger tolerance or change the solver
    stopped,      ///< an observer asked to stop before either
    not_finite,  ///< input or arithmetic produced NaN or infinity: the impulses are the last finite
};

/// A point of a solve's history.
struct ResidualSample {
    int sweep;
    double residual;
};

/// What a solver says of its answer. `residual` is always that of `problem/residual.hpp`, evaluated
/// at the impulses returned.
struct SolveReport {
    SolveStatus status = SolveStatus::sweep_limit;
    int sweeps = 0;
    double residual = 0.0;                ///< relative natural-map residual of the exact law [-]
    std::vector<ResidualSample> history;  ///< residuals evaluated on the way, in order
};

}  // namespace talus
