// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <cmath>
#include <cstdint>

namespace talus {

/// When an observer of a run has something to do: every so many steps, or once in every period of
/// time, at the first step that reaches it. The last one told is remembered, so that steps of any
/// size are served once.
class Schedule {
  public:
    /// At steps `steps`, 2 `steps`... Throws input_error unless there is at least one.
    static Schedule every_steps(std::int64_t steps) {
        require_in("steps of a schedule", static_cast<double>(steps), 1.0, 9e15);
        return Schedule(steps, 0.0, 0.0);
    }
    /// At times `period`, 2 `period`... [s]; those up to `begin`, where a run goes on, are past.
    /// Throws input_error unless the period is positive.
    static Schedule every(double period, double begin = 0.0) {
        require_positive("period of a schedule", period);
        return Schedule(0, period, begin);
    }

    /// Whether it is time; `step_count` and `time` [s] are those of the simulation.
    bool due(std::int64_t step_count, double time) {
        if (steps_ > 0) return step_count % steps_ == 0;
        const double reached = periods(time);
        if (!(reached > last_)) return false;
        last_ = reached;
        return true;
    }
    /// Of a simulation.
    template <class Simulation>
    bool due(const Simulation& sim) {
        return due(sim.step_count(), sim.time());
    }

  private:
    Schedule(std::int64_t steps, double period, double begin) : steps_(steps), period_(period) {
        if (steps_ == 0) last_ = periods(begin);
    }
    /// Clocks are sums of steps: what is rounded below a multiple has reached it.
    double periods(double time) const {
        constexpr double rounding = 1e-9;
        return std::floor(time / period_ * (1.0 + 1e-13) + rounding);
    }

    std::int64_t steps_;
    double period_, last_ = 0.0;
};

}  // namespace talus
