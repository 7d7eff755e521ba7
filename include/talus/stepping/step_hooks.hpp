// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace talus {

/// Places between the stages of a step where a user's code may look at, or change, what the step is
/// about to go on with: to study a variant of the method, or to break it on purpose and see which
/// check notices. Each is given the system (a System) and the step's data (a StepData). Derive from
/// this and hide the ones you want; what is not hidden costs nothing. (A name that is misspelt
/// hides nothing, and is not called.)
struct NoHooks {
    /// Free bodies at q_mid with u_begin, obstacles at t_mid; `data.begin` filled. Before forces
    /// and gaps.
    template <class SystemType, class Data>
    void at_midpoint(SystemType&, Data&) {}
    /// `data.contacts`, jacobian and inverse masses filled. What is changed here of bodies or loads
    /// comes too late for the forces of this step.
    template <class SystemType, class Data>
    void matrices_known(SystemType&, Data&) {}
    /// `data.applied` and `data.free` filled, and free to be changed. Before the contacts'
    /// velocities.
    template <class SystemType, class Data>
    void forces_known(SystemType&, Data&) {}
    /// `data.problem` and the warm start in `data.impulse` are as the solver will see them.
    template <class SystemType, class Data>
    void problem_known(SystemType&, Data&) {}
    /// Impulses found. Before they are applied.
    template <class SystemType, class Data>
    void solved(SystemType&, Data&) {}
    /// `data.end` filled. Before the bodies receive it and drift to q_end.
    template <class SystemType, class Data>
    void velocities_known(SystemType&, Data&) {}
    /// The bodies are at q_end.
    template <class SystemType, class Data>
    void finished(SystemType&, Data&) {}
};

/// What a step calls between its stages. (One requirement each, so that a refusal names the first
/// that is not met.)
template <class H, class SystemType, class Data>
concept StepHooks = requires(H& h, SystemType& system, Data& data) {
    h.at_midpoint(system, data);
}
&&requires(H& h, SystemType& system, Data& data) { h.matrices_known(system, data); }
&&requires(H& h, SystemType& system, Data& data) { h.forces_known(system, data); }
&&requires(H& h, SystemType& system, Data& data) { h.problem_known(system, data); }
&&requires(H& h, SystemType& system, Data& data) { h.solved(system, data); }
&&requires(H& h, SystemType& system, Data& data) { h.velocities_known(system, data); }
&&requires(H& h, SystemType& system, Data& data) { h.finished(system, data); };

}  // namespace talus
