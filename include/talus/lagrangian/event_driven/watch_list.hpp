// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/acceleration_lcp.hpp>
#include <talus/lagrangian/event_driven/contact_motion.hpp>
#include <talus/lagrangian/event_driven/smooth_phase.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace talus {

/// What may end a phase of a system with that many contacts.
inline std::vector<Watch> watches_of(const SmoothPhase& phase, const AccelerationProblem& problem,
                                     std::size_t contact_count) {
    std::vector<Watch> watches;
    for (std::size_t place = 0; place < contact_count; ++place) {
        const std::size_t c = phase.index_of(place);
        if (c == SmoothPhase::none) {
            watches.push_back({WatchKind::gap, place});
            continue;
        }
        if (!phase.singular) watches.push_back({WatchKind::normal_force, place});
        if (phase.modes.mode[c] == ContactMode::sticking) {
            if (!phase.singular) watches.push_back({WatchKind::friction_margin, place});
        } else if (problem.mu[c] > 0.0) {
            watches.push_back({WatchKind::slip, place});
        }
    }
    if (phase.singular) watches.push_back({WatchKind::forces, phase.closed.front()});
    return watches;
}

/// Whether any forces of redundant contacts hold a phase as it is: the least ones, or those of a
/// solution by Lemke's algorithm that has the same accelerations.
inline bool forces_exist(const AccelerationProblem& problem, const ModeSystem& forces,
                         const ContactModes& modes) {
    if (forces.admissible(problem, modes)) return true;
    constexpr double same = 1e-3;  // of accelerations that are zero but for rounding
    const std::optional<AccelerationSolution> other = solve_by_lemke(problem);
    return other && (other->acceleration - forces.acceleration).lpNorm<Eigen::Infinity>() <=
                        same * forces.acceleration_rounding(problem);
}

/// Fills a sample from a motion that was solved at its time.
template <class System>
void take_sample(const ContactMotion<System>& motion, const SmoothPhase& phase,
                 const std::vector<Watch>& watches, double resting_speed, WatchSample& sample) {
    const AccelerationProblem& p = motion.problem;
    const std::size_t n = watches.size();
    sample.value.assign(n, 0.0);
    sample.rate.assign(n, 0.0);
    sample.band.assign(n, 0.0);
    for (std::size_t w = 0; w < n; ++w) {
        const std::size_t place = watches[w].contact;
        double& value = sample.value[w];
        if (watches[w].kind == WatchKind::gap) {
            value = motion.contacts[place].gap;
            sample.rate[w] = motion.normal_velocity(place);
            continue;
        }
        const std::size_t c = phase.index_of(place);
        const Eigen::Index row = p.row(c);
        switch (watches[w].kind) {
            case WatchKind::normal_force:
                value = motion.forces.force[row];
                sample.band[w] = motion.forces.force_rounding(p);
                break;
            case WatchKind::friction_margin:
                value = p.mu[c] * motion.forces.force[row] -
                        motion.forces.force.segment(row + 1, p.rows - 1).norm();
                sample.band[w] = motion.forces.force_rounding(p);
                break;
            case WatchKind::slip:
                // In space a speed has no sign: it is at rest before it turns round.
                if (p.rows > 2) {
                    value = motion.slip_velocity(place).norm() - 0.5 * resting_speed;
                } else {
                    value = motion.slip_velocity(place).dot(phase.modes.slip.col(p.column(c)));
                    sample.band[w] = resting_speed;
                }
                break;
            default:
                value = forces_exist(p, motion.forces, motion.modes()) ? 1.0 : -1.0;
        }
    }
}

}  // namespace talus
