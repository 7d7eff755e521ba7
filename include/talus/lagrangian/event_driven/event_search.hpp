// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/smooth_phase.hpp>
#include <talus/law/bracketed_root.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace talus {

/// When something that is watched goes below zero.
struct Crossing {
    double t;
    std::size_t watch;  ///< which
};

/// Finds the first crossing within a step: signs by dense output at eight instants, times to
/// rounding by steps of their own. Gaps are also looked at where they are least between two
/// instants.
class EventSearch {
  public:
    /// Samples at a time within the step: by dense output, or exactly.
    using Sampler = std::function<void(double t, bool exact, WatchSample& sample)>;

    /// `resting` and `touching` are those of EventDrivenParams.
    EventSearch(double resting, double touching) : resting_(resting), touching_(touching) {}

    std::optional<Crossing> first(double t_begin, double t_end, const std::vector<Watch>& watches,
                                  const Sampler& sampler) {
        constexpr int instants = 8;
        if (watches.empty()) return std::nullopt;
        sampler_ = &sampler;
        origin_ = t_begin - (t_end - t_begin);
        sampler(t_begin, false, before_);
        for (int i = 1; i <= instants; ++i) {
            const double t =
                i == instants ? t_end : t_begin + (t_end - t_begin) * (i / double{instants});
            sampler(t, false, after_);
            std::optional<Crossing> first;
            for (std::size_t w = 0; w < watches.size(); ++w) {
                const std::optional<double> at =
                    watches[w].kind == WatchKind::gap ? gap_crossing(w) : value_crossing(w);
                if (at && (!first || *at < first->t)) first = Crossing{*at, w};
            }
            if (first) return first;
            std::swap(before_, after_);
        }
        return std::nullopt;
    }

  private:
    std::optional<double> value_crossing(std::size_t w) {
        if (!(after_.value[w] < -after_.band[w])) return std::nullopt;
        if (!(before_.value[w] > 0.0)) return before_.t;
        return root(w, false, before_.t, after_.t, Side::negative);
    }
    /// Of a gap: a contact that has just opened may have a gap of less than zero by rounding.
    std::optional<double> gap_crossing(std::size_t w) {
        const double a = before_.value[w], b = after_.value[w];
        const double speed_a = before_.rate[w], speed_b = after_.rate[w];
        if (b < 0.0 && (speed_b < -resting_ || b < -touching_)) {
            if (a > 0.0) return root(w, false, before_.t, after_.t, Side::positive);
            if (!(speed_a >= 0.0 && speed_b < 0.0)) return before_.t;
            const double top = root(w, true, before_.t, after_.t, Side::nearest);
            return value(w, false, top) > 0.0 ? root(w, false, top, after_.t, Side::positive) : top;
        }
        if (a > 0.0 && b >= 0.0 && speed_a < 0.0 && speed_b > 0.0) {
            const double bottom = root(w, true, before_.t, after_.t, Side::nearest);
            if (value(w, false, bottom) < 0.0)
                return root(w, false, before_.t, bottom, Side::positive);
        }
        return std::nullopt;
    }
    double value(std::size_t w, bool rate, double t) {
        (*sampler_)(t, true, exact_);
        return rate ? exact_.rate[w] : exact_.value[w];
    }
    /// Which side of a crossing is taken.
    enum class Side { positive, negative, nearest };
    /// The time, between two, at which a value (or rate) is zero. Where dense output and exact
    /// steps differ in the sign at an end it is that end.
    double root(std::size_t w, bool rate, double from, double to, Side side) {
        const double f = value(w, rate, from), g = value(w, rate, to);
        if (f == 0.0) return from;
        if (g == 0.0) return to;
        if ((f > 0.0) == (g > 0.0)) return std::abs(f) < std::abs(g) ? from : to;
        // Times from an origin one step away: no finer than rounding of the step.
        const Bracket found = bracketed_root([&](double x) { return value(w, rate, origin_ + x); },
                                             {from - origin_, f}, {to - origin_, g});
        const Sample& end = side == Side::positive   ? found.positive()
                            : side == Side::negative ? found.negative()
                                                     : found.best();
        return std::clamp(origin_ + end.x, from, to);
    }

    double resting_, touching_, origin_ = 0.0;
    const Sampler* sampler_ = nullptr;
    WatchSample before_, after_, exact_;
};

}  // namespace talus
