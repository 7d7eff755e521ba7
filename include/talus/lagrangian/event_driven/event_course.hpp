// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/dense_step.hpp>
#include <talus/lagrangian/event_driven/smooth_phase.hpp>

#include <cstddef>
#include <vector>

namespace talus {

/// How the impacts of one contact follow one another.
struct ImpactSeries {
    int count = 0;  ///< in a row that were close to the one before
    int total = 0;
    double last = 0.0;      ///< time of the last one [s]
    double interval = 0.0;  ///< between the last two [s]
    double before = 0.0;    ///< between the two before [s]

    /// Notes an impact; `close` is EventDrivenParams::accumulation_time.
    void note(double t, double close) {
        before = interval;
        interval = total > 0 ? t - last : 0.0;
        count = total > 0 && interval < close ? count + 1 : 0;
        last = t;
        ++total;
    }
    /// The limit of a geometric series of intervals; the last impact where they do not shrink.
    double limit() const {
        if (!(interval > 0.0 && interval < before)) return last;
        const double ratio = interval / before;
        return last + interval * ratio / (1.0 - ratio);
    }
};

/// Where a run is: all that what follows depends on.
struct EventCourse {
    double t = 0.0;
    DenseStep::State x;  ///< q, then u
    SmoothPhase phase;
    bool settled = false;               ///< the phase is that of now
    double length = 0.0;                ///< of the next step to be tried; 0: not known
    std::vector<ImpactSeries> impacts;  ///< by contact
};

}  // namespace talus
