// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/ids.hpp>
#include <talus/core/number_record.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/dynamics/prescribed_motion.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace talus {

/// A body that moves as prescribed.
template <int Dim>
requires SpaceDimension<Dim>
struct Obstacle {
    BodyIndex body;
    PrescribedMotion<Dim> motion;
};

/// All that the next step of a simulation depends on, apart from what its program says again when
/// it goes on: laws, forces, settings, solver. A run that goes on from here makes the same bits as
/// one that never stopped.
template <int Dim, class ShapeType>
requires SpaceDimension<Dim>
struct RunState {
    Bodies<Dim> bodies;
    std::vector<ShapeType> shapes;  ///< in the bodies' frames, one for each
    std::vector<Obstacle<Dim>> obstacles;
    IgnoredPairs ignored;
    Vector<Dim> gravity = Vector<Dim>::Zero();  ///< [m/s^2]
    double time = 0.0;                          ///< of the obstacles' places [s]
    std::optional<PeriodicCell<Dim>> cell;      ///< at that time

    double h = 0.0;           ///< step size of the simulation [s]
    double time_start = 0.0;  ///< when it began [s]
    std::int64_t step_count = 0;
    /// Step size of the last step, 0 before the first [s].
    double last_h = 0.0;
    /// What the next step begins with: impulses by contact, ascending, in world axes [N s].
    std::vector<ContactKey> key;
    std::vector<Vector<Dim>> impulse;
    /// Their moments on the first body, world axes [N m s]; empty without rolling friction.
    std::vector<AngularVector<Dim>> moment;
    /// What the correction of positions remembers, if there is one.
    NumberRecord correction;
};

}  // namespace talus
