// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/contact_jacobian.hpp>
#include <talus/core/column.hpp>
#include <talus/law/concepts.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// Fills b, what each law is told its contact's velocity would be without impulses [m/s]: the
/// relative velocity of the free twists, and for laws that look at a mean with the velocity at the
/// beginning the shift by which that comes to the same ([Moreau] section 2.2).
template <int Dim, class Law>
void assemble_velocities(const ContactJacobian<Dim>& jacobian, std::span<const Twist<Dim>> begin,
                         std::span<const Twist<Dim>> free, std::span<const Law> laws,
                         Column<Vector<law_rows<Law, Dim>>>& free_velocity) {
    constexpr int rows = law_rows<Law, Dim>;
    free_velocity.resize(laws.size());
    for (std::size_t c = 0; c < laws.size(); ++c) {
        Vector<rows>& u_free = free_velocity[c];
        u_free = relative_velocity<Dim, rows>(jacobian, c, free);
        if constexpr (RestitutionLaw<Law, rows>)
            u_free += laws[c].restitution_shift(relative_velocity<Dim, rows>(jacobian, c, begin));
    }
}

}  // namespace talus
