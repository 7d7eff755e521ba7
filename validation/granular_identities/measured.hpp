// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/stress.hpp>

#include <vector>

#include "harness/case.hpp"

namespace validation {

/// Forces on body a of each contact, as the library measures them, world axes (or, as a fault,
/// left in the contact's own) [N].
template <int Dim>
std::vector<V<Dim>> measured_forces(const TrialRecord& trial,
                                    const talus::ContactJacobian<Dim>& jacobian,
                                    std::span<const V<Dim>> impulses, double duration) {
    std::vector<V<Dim>> forces;
    talus::contact_forces<Dim>(jacobian, impulses, duration, forces);
    if (trial.faulty(Fault::forces_in_local_axes))
        for (std::size_t c = 0; c < forces.size(); ++c) forces[c] = impulses[c] / duration;
    return forces;
}
template <int Dim>
std::vector<V<Dim>> measured_forces(const TrialRecord& trial, const StepData<Dim>& data) {
    return measured_forces<Dim>(trial, data.problem.jacobian, data.impulse, data.h);
}

template <int Dim>
std::vector<talus::Matrix<Dim>> internal_moments(const talus::ContactJacobian<Dim>& jacobian,
                                                 const std::vector<V<Dim>>& forces,
                                                 std::size_t body_count) {
    std::vector<talus::Matrix<Dim>> moments;
    talus::internal_moments<Dim>(jacobian, forces, body_count, moments);
    return moments;
}

}  // namespace validation
