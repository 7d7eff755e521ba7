// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "sliding_block/block.hpp"

/// Floors whose surface moves in itself.
namespace validation {

/// The floor with a surface that moves along itself with `velocity(t)` [m/s].
template <int Dim, class Velocity>
talus::BodyIndex add_belt(World<Dim>& world, Velocity velocity) {
    return world.add_obstacle(talus::HalfSpace<Dim>(up<Dim>()),
                              talus::PrescribedMotion<Dim>().with_surface(
                                  [velocity](double t) { return talus::Twist<Dim>{velocity(t)}; }));
}

/// The floor as a table that turns about the last axis through the origin at `rate` [rad/s].
inline talus::BodyIndex add_turntable(World<3>& world, double rate) {
    return world.add_obstacle(
        talus::HalfSpace<3>(up<3>()),
        talus::PrescribedMotion<3>::belt({}, {V<3>::Zero(), V<3>(0, 0, rate)}));
}

/// A quarter turn about the last axis: J of the turntable's formulas.
inline V<3> quarter_turn(const V<3>& v) { return {-v[1], v[0], 0.0}; }

}  // namespace validation
