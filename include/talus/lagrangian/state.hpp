// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace talus {

/// All that the next step of a LagrangianSimulation depends on, apart from what its program says
/// again when it goes on: system, settings, solver. A run that goes on from here makes the same
/// bits as one that never stopped. As a record (`record_of`) it can be carried along in a
/// checkpoint.
struct LagrangianState {
    std::vector<double> q, u;       ///< as many as coordinates
    double h = 0.0;                 ///< step size of the simulation [s]
    double time_start = 0.0;        ///< when it began [s]
    std::int64_t step_count = 0;    ///< since then
    std::int64_t rows = 0;          ///< of a contact
    std::vector<double> impulse;    ///< of the last step, by place in the system's list [N s]
    double largest_velocity = 0.0;  ///< FreeVelocity::largest [sqrt(J)]

    /// Throws input_error naming the item unless the numbers are finite and fit together.
    void require_valid() const {
        require_count("velocities of the state", u.size(), "coordinates", q.size());
        require_finite("q of the state", q);
        require_finite("u of the state", u);
        require_finite("impulses of the state", impulse);
        require_positive("step size h of the state", h);
        if (!std::isfinite(time_start)) detail::reject("begin of the state", time_start, "finite");
        require_non_negative("steps of the state", static_cast<double>(step_count));
        require_in("rows of the state", static_cast<double>(rows), 2.0, 3.0);
        if (impulse.size() % static_cast<std::size_t>(rows) != 0)
            detail::reject("number of impulses of the state", static_cast<double>(impulse.size()),
                           "a multiple of " + std::to_string(rows));
        require_non_negative("largest velocity of the state", largest_velocity);
    }

    void write(NumberRecord& out) const {
        for (const std::vector<double>* list : {&q, &u, &impulse}) {
            out.integer(list->size());
            for (const double x : *list) out.real(x);
        }
        for (const double x : {h, time_start, largest_velocity}) out.real(x);
        for (const std::int64_t k : {step_count, rows}) out.integer(k);
    }
    /// Throws input_error where the record is not of a valid state.
    static LagrangianState read(NumberRecordReader& in) {
        LagrangianState state;
        for (std::vector<double>* list : {&state.q, &state.u, &state.impulse}) {
            list->resize(in.count(1, 0));
            for (double& x : *list) x = in.real();
        }
        for (double* x : {&state.h, &state.time_start, &state.largest_velocity}) *x = in.real();
        for (std::int64_t* k : {&state.step_count, &state.rows}) *k = in.integer();
        state.require_valid();
        return state;
    }
    friend bool operator==(const LagrangianState&, const LagrangianState&) = default;
};
static_assert(Recordable<LagrangianState>);

}  // namespace talus
