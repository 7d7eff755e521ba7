// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>

#include <functional>
#include <span>

namespace talus {

/// Applied forces other than gravity: adds, for any bodies it likes, force and moment about the
/// centre in world axes to `wrenches` (one per body). Called once per step with the time and
/// configuration of the midpoint and the velocities of the beginning: F(t_mid, q_mid, u_begin) of
/// [Moreau] equation (9).
template <int Dim>
using ForceField =
    std::function<void(double t, const Bodies<Dim>& bodies, std::span<Wrench<Dim>> wrenches)>;

/// How the gyroscopic term of Euler's equations enters the step.
enum class Gyroscopic {
    explicit_term,        ///< taken at the begin velocity, as in the paper: order 1, gains energy
    momentum_preserving,  ///< implicit: keeps angular momentum to rounding, order 2
};

}  // namespace talus
