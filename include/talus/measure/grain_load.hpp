// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/contact_problem.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// Load of every body: the sum of the normal impulses at its contacts [N s], the grey level of
/// Moreau's drawings ([Moreau] section 3.2). Divide by h for the mean force. Throws input_error for
/// a contact of a body beyond the count.
template <int Dim>
void grain_load(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> r,
                std::size_t body_count, std::vector<double>& load) {
    jacobian.require_bodies(body_count);
    load.assign(body_count, 0.0);
    for (std::size_t c = 0; c < r.size(); ++c) {
        load[static_cast<std::size_t>(jacobian.a[c])] += r[c][0];
        load[static_cast<std::size_t>(jacobian.b[c])] += r[c][0];
    }
}

/// Total impulse, world axes, that the bodies i with `is_giver(i)` (the obstacles, say) gave to all
/// others over the step [N s].
template <int Dim, class IsGiver>
Vector<Dim> impulse_from(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> r,
                         IsGiver&& is_giver) {
    Vector<Dim> total = Vector<Dim>::Zero();
    for (std::size_t c = 0; c < r.size(); ++c) {
        const bool a = is_giver(static_cast<std::size_t>(jacobian.a[c]));
        const bool b = is_giver(static_cast<std::size_t>(jacobian.b[c]));
        if (a == b) continue;
        const Vector<Dim> on_a = jacobian.frame[c].transpose() * r[c];
        total += b ? on_a : Vector<Dim>(-on_a);
    }
    return total;
}

}  // namespace talus
