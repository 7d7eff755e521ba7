// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pile {

/// Figures of one step. Energies given by contacts are sums from the start of the run.
struct StepFigures {
    double time;  ///< at its end [s]
    std::size_t contacts;
    int sweeps;
    double residual;
    double kinetic, potential;                 ///< [J]
    double friction, impacts;                  ///< given to the grains so far [J]
    double max_penetration, mean_penetration;  ///< [m]
    double reaction_over_weight;
    double momentum_up;  ///< of the grains [N s]
};

/// A number that was the worst of a run.
struct WorstFigure {
    double value = 0.0;
    double time = 0.0;         ///< end of the step [s]
    std::int64_t step = 0;     ///< counted from 1; 0: never
    std::string one, another;  ///< what touched there; empty where nothing did
};

/// Energy given to the grains by the way it came [J]. Losses are negative.
struct GivenEnergy {
    double friction = 0.0, impacts = 0.0, walls = 0.0, gyroscopic = 0.0, correction = 0.0;
};

/// All that is known of a run, of either dimension: what a certificate is written from.
struct Figures {
    int dim = 0;
    std::size_t grains = 0;
    std::string scene, solver;  ///< empty: generated; the simulation's own
    double tolerance = 0.0, h = 0.0, mean_radius = 0.0;
    double mass = 0.0, weight = 0.0;
    double seconds = 0.0;  ///< of wall time
    std::vector<StepFigures> steps;
    std::int64_t missed = 0;
    WorstFigure residual, velocity_error, overlap;
    double drift = 0.0;  ///< RunSummary::drift [m]
    double kinetic_start = 0.0, potential_start = 0.0, momentum_up_start = 0.0;
    GivenEnergy given;
    double energy_missing = 0.0, energy_closure = 0.0;
    bool stopped = false;  ///< by a signal
    std::string failure;   ///< what ended the run early; empty if nothing did

    const StepFigures& last() const { return steps.back(); }
    double mean_grain_weight() const { return weight / static_cast<double>(grains); }
    /// Of the mass, root mean square, at the end [m/s].
    double speed() const { return mass > 0.0 ? std::sqrt(2 * last().kinetic / mass) : 0.0; }

    /// The last tenth of the run begins with this step.
    std::size_t late() const { return steps.size() - std::max<std::size_t>(1, steps.size() / 10); }
    template <class Figure>
    double late_mean(Figure&& figure) const {
        double sum = 0.0;
        for (std::size_t k = late(); k < steps.size(); ++k) sum += figure(steps[k]);
        return sum / static_cast<double>(steps.size() - late());
    }
    double reaction_over_weight() const {
        return late_mean([](const StepFigures& s) { return s.reaction_over_weight; });
    }
    /// What the momentum of the grains says that it must be: 1 when they are at rest.
    double reaction_over_weight_due() const {
        if (!(weight > 0.0)) return 0.0;
        const double before = late() == 0 ? momentum_up_start : steps[late() - 1].momentum_up;
        const double time = h * static_cast<double>(steps.size() - late());
        return 1.0 + (last().momentum_up - before) / (weight * time);
    }
    /// Of loaded contacts [m].
    double mean_penetration() const {
        return late_mean([](const StepFigures& s) { return s.mean_penetration; });
    }

    double sweeps_per_step() const {
        double sum = 0.0;
        for (const StepFigures& s : steps) sum += s.sweeps;
        return sum / static_cast<double>(steps.size());
    }
    double updates_per_second() const {
        double sum = 0.0;
        for (const StepFigures& s : steps) sum += s.sweeps * static_cast<double>(s.contacts);
        return seconds > 0.0 ? sum / seconds : 0.0;
    }
    /// The largest energy that was around or went through, so far at each step [J].
    double largest_energy() const {
        double largest = kinetic_start;
        for (const StepFigures& s : steps)
            largest = std::max({largest, s.kinetic + std::abs(s.potential - potential_start),
                                std::abs(s.friction) + std::abs(s.impacts)});
        return largest;
    }
};

}  // namespace pile
