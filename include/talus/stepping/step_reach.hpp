// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/types.hpp>
#include <talus/spatial/twist.hpp>
#include <talus/stepping/gap_anticipating.hpp>
#include <talus/stepping/step_params.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace talus {

/// How far around each body a step looks for contacts, and where it foresees bodies to go.
template <int Dim>
requires SpaceDimension<Dim>
struct StepReach {
    Column<double> fall;        ///< what loads add to the way of a body in the step [m]
    Column<double> reach;       ///< share of a body in the gaps that count [m]
    Column<Twist<Dim>> motion;  ///< over one step [m, rad]; empty where nothing is anticipated

    /// By which it is told whether a contact of the body is closed: an obstacle does not tell [m].
    template <class System>
    static double thickness(const System& system, std::size_t i) {
        return system.bodies.is_obstacle(i) ? std::numeric_limits<double>::infinity()
                                            : system.half_thickness()[i];
    }

    /// Of a step whose midpoint, begin and free velocities are known.
    template <class System, class Data>
    void measure(const System& system, const StepParams& params, const Data& data) {
        const std::size_t n = system.bodies.count();
        fall.resize(n);
        reach.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double turn = (data.free[i].angular - data.begin[i].angular).norm();
            fall[i] = data.h * ((data.free[i].linear - data.begin[i].linear).norm() +
                                by_turn(turn, system.bounding_radius()[i]));
            // No gap of a pair that counts as closed is larger than this one of one of its free
            // bodies.
            reach[i] = system.bodies.is_obstacle(i)
                           ? 0.0
                           : closed_gap(params, thickness(system, i), fall[i]);
        }
        motion.clear();
        if (params.scheme == Scheme::gap_anticipating) anticipate(system, params, data);
    }

  private:
    /// What a turn moves the surface by; of what has no end, or does not turn, nothing.
    static double by_turn(double turn, double radius) {
        return turn > 0.0 && std::isfinite(radius) ? turn * radius : 0.0;
    }

    template <class System, class Data>
    void anticipate(const System& system, const StepParams& params, const Data& data) {
        // What is anticipated needs no more: it is held before it opens.
        const double touching = params.contact_tolerance.value_or(0.0);
        const bool walls = data.cell && has_walls(system.bounding_radius());
        for (std::size_t i = 0; i < system.bodies.count(); ++i) {
            const Vector<Dim> from_home =
                data.from_home.empty() ? Vector<Dim>::Zero() : data.from_home[i];
            const double way =
                anticipation_reach<Dim>(system.bodies, i, system.bounding_radius()[i],
                                        fall[i] / data.h, data.h, data.cell, walls, from_home);
            reach[i] = std::max(reach[i], 0.5 * touching + way);
            motion.push_back({data.h * data.begin[i].linear, data.h * data.begin[i].angular});
        }
        // Shapes whose surfaces move otherwise: the shape of a belt stands still.
        for (const auto& [body, way] : system.obstacles) {
            if (!way.surface_moves()) continue;
            const auto i = static_cast<std::size_t>(body);
            motion[i] = way.displacement(data.t_begin, data.t_end());
            reach[i] = 0.5 * touching + motion[i].linear.norm() +
                       by_turn(motion[i].angular.norm(), system.bounding_radius()[i]);
        }
    }
};

}  // namespace talus
