// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

namespace talus {

/// At which velocity a step takes F(t_mid, q_mid, u).
enum class VelocityForces {
    /// u_begin: the paper's, section 2.3. Order 1 where F depends on u, as Coriolis terms and
    /// dampers do; a system that moves freely slowly gains or loses energy.
    explicit_begin,
    /// The mean of u_begin and of the velocity that the step would end with without contacts. Such
    /// a free step is its own mirror in time, so it is of order 2 for any A(t, q) and F(t, q, u).
    /// Costs n + 3 or so more calls of `force`. It is found to the rounding of F, also as the
    /// system comes to rest; where it is not found, LagrangianStepData::free_report says so, and
    /// the run is not certified.
    implicit_midpoint,
};

/// When a simulation compares the Jacobians that its system gives with its gaps (JacobianCheck).
enum class CheckJacobians {
    never,
    at_start,   ///< at the first state, and at each that is set
    each_step,  ///< also at the midpoint of every step
};

/// Settings of a LagrangianSimulation.
struct LagrangianParams {
    double h = 1e-3;  ///< step size [s]
    /// Gap up to which a contact counts as closed at the midpoint [m]. The paper's is 0. Such a
    /// contact is held as it is.
    double contact_tolerance = 0.0;
    VelocityForces velocity_forces = VelocityForces::explicit_begin;
    CheckJacobians check_jacobians = CheckJacobians::at_start;
    /// By what coordinates change as the system moves: what the widths of differences are taken of,
    /// where Jacobians are checked by them. Need not be known well.
    double coordinate_scale = 1.0;

    /// Throws input_error unless h is and the scale are positive and the tolerance not negative.
    void require_valid() const {
        require_positive("step size h", h);
        require_non_negative("contact tolerance", contact_tolerance);
        require_positive("coordinate scale", coordinate_scale);
    }
};

}  // namespace talus
