// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/acceleration_problem.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <vector>

namespace talus {

/// The contacts that are closed between two events, and what they do.
struct SmoothPhase {
    std::vector<std::size_t> closed;  ///< places in the system's list, ascending
    ContactModes modes;               ///< of these
    double determinant = 1.0;         ///< ModeSystem::determinant when it began
    bool singular = false;            ///< ModeSystem::singular, then

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// Where a contact is among those that are closed; `none` if it is open.
    std::size_t index_of(std::size_t place) const {
        for (std::size_t c = 0; c < closed.size(); ++c)
            if (closed[c] == place) return c;
        return none;
    }
    ContactMode mode_at(std::size_t place) const {
        const std::size_t c = index_of(place);
        return c == none ? ContactMode::open : modes.mode[c];
    }
    /// Direction of the slip of a contact; zero unless it slides with one.
    Eigen::VectorXd slip_at(std::size_t place) const {
        const std::size_t c = index_of(place);
        if (c == none || modes.mode[c] != ContactMode::sliding) return Eigen::VectorXd::Zero(1);
        return modes.slip.col(static_cast<Eigen::Index>(c));
    }
};

/// What ends a smooth phase where it goes below zero.
enum class WatchKind {
    gap,              ///< of an open contact [m]
    normal_force,     ///< of a closed one [N]
    friction_margin,  ///< mu r_n - |r_t| of one that sticks [N]
    slip,             ///< velocity along its slip, of one that slides with friction [m/s]
    forces            ///< of redundant contacts: 1 as long as some obey the laws, otherwise -1
};

/// Something to be watched.
struct Watch {
    WatchKind kind;
    std::size_t contact;  ///< its place
};

/// What is watched, at one instant.
struct WatchSample {
    double t = 0.0;
    std::vector<double> value;
    std::vector<double> rate;  ///< of gaps: by time [m/s]; otherwise 0
    /// How far below zero a value may be from the beginning of a phase on: what is zero there.
    std::vector<double> band;
};

}  // namespace talus
