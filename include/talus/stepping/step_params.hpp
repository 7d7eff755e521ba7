// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/forces.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace talus {

/// Which contacts a step treats as effective, and what their law is told.
enum class Scheme {
    midpoint,          ///< [Moreau] section 2.3: those that are closed at (t_mid, q_mid)
    gap_anticipating,  ///< also those that the step could close, with g/h + u_n in place of u_n
};

/// Choices within a step.
struct StepParams {
    Scheme scheme = Scheme::midpoint;  ///< the paper's
    /// Gap up to which a contact counts as closed [m], see `closed_gap`. The paper's is 0.
    std::optional<double> contact_tolerance = std::nullopt;
    /// Whether a contact that `closed_gap` counts as closed, with no contact tolerance given, may
    /// close what is left of its gap in the midpoint scheme. (The other one closes gaps anyway.)
    bool gaps_may_close = true;
    /// The paper's is explicit_term, with which a free top gains energy at every step.
    Gyroscopic gyroscopic = Gyroscopic::momentum_preserving;
    /// Widening of the boxes of the broad phase, as a fraction of the mean bounding radius of the
    /// bodies. Affects speed alone.
    double skin = 0.2;
};

/// Throws input_error for a setting out of range. (Not made part of its callers: GCC 12 would warn
/// there of a tolerance that is not given.)
[[gnu::noinline]] inline void require_valid(const StepParams& params) {
    if (params.contact_tolerance)
        require_non_negative("contact tolerance", *params.contact_tolerance);
    require_non_negative("skin", params.skin);
}

/// The gap up to which a contact counts as closed [m]: the contact tolerance, if there is one.
/// Otherwise it is 0.01 of `fall`, as far as that is between 1e-5 and 1e-3 of `half_thickness`
/// (System::half_thickness), that of the thinner free body. `fall` is h |u_free - u_begin|, how far
/// loads alone would take a body's points within the step, g h^2 for its weight: of two bodies the
/// larger. A tenth of 0.01 of it is what the default solver at its aim of 1e-4 lets bodies at rest
/// part in a step (ResidualMeasure), and all of it at its tolerance of 1e-3. With 0 such a contact
/// would be lost in the next one, and with it friction and the moments that hold a wall upright.
/// Rounding of "exactly" placed bodies is far below it. Where loads take a body farther than a
/// tenth of its half thickness within a step, the upper end does not leave that room: the step is
/// too large for such bodies. What counts as closed by this rule is told gap / h + u_n: it may
/// close, so that errors of the solver do not add up until it opens. In the midpoint scheme what
/// counts as closed by a contact tolerance is held as it is, the paper's way, and so is everything
/// without `gaps_may_close`. Pins (`holds_any_pull`) are always held as they are: what a law
/// without limit may close, it would. A body without a thickness (a half-space that is free to
/// move) sets no limits of its own.
inline double closed_gap(const StepParams& params, double half_thickness, double fall) {
    constexpr double of_fall = 0.01, least = 1e-5, most = 1e-3;
    if (!std::isfinite(half_thickness)) return params.contact_tolerance.value_or(of_fall * fall);
    return params.contact_tolerance.value_or(
        std::clamp(of_fall * fall, least * half_thickness, most * half_thickness));
}

}  // namespace talus
