// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/problem/contact_problem.hpp>

#include <cstddef>
#include <span>

namespace talus {

// With rolling friction a solver sees the impulse of a contact as one vector of Rows components,
// (r_n, r_t, r_m); everyone else sees an impulse in the axes of the contact [N s], as without, and
// a moment impulse on body a in world axes [N m s].

/// Fills r from impulses and moments.
template <int Dim, int Rows>
void join_rolling_rows(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> impulses,
                       std::span<const AngularVector<Dim>> moments, Column<Vector<Rows>>& r) {
    r.resize(impulses.size());
    for (std::size_t c = 0; c < r.size(); ++c) {
        r[c].template head<Dim>() = impulses[c];
        r[c].template tail<Dim - 1>() =
            rolling_axes<Dim>(jacobian.frame[c]) * moments[c] / jacobian.rolling_length[c];
    }
}

/// Fills impulses and moments from r.
template <int Dim, int Rows>
void part_rolling_rows(const ContactJacobian<Dim>& jacobian, const Column<Vector<Rows>>& r,
                       std::span<Vector<Dim>> impulses, std::span<AngularVector<Dim>> moments) {
    for (std::size_t c = 0; c < r.size(); ++c) {
        impulses[c] = r[c].template head<Dim>();
        const Vector<Dim - 1> rolling = jacobian.rolling_length[c] * r[c].template tail<Dim - 1>();
        moments[c] = rolling_axes<Dim>(jacobian.frame[c]).transpose() * rolling;
    }
}

}  // namespace talus
