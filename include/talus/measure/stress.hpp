// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/kinetic_moment.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/problem/contact_problem.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// Mean forces over the step, world axes, on body a of each contact (body b receives the opposite)
/// [N]: impulses r [N s], local axes, over the duration of the step [s].
template <int Dim>
void contact_forces(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> r,
                    double duration, std::vector<Vector<Dim>>& forces) {
    require_positive("duration of the step", duration);
    forces.resize(r.size());
    for (std::size_t c = 0; c < r.size(); ++c)
        forces[c] = jacobian.frame[c].transpose() * r[c] / duration;
}

/// Internal moment of every body about its centre, M = sum_c (x_c - x_G) f_c^T over its contacts
/// [N m] ([Moreau1997]; Love-Weber). For a body in equilibrium under its contact forces alone it is
/// symmetric and the same about any point; for one that moves, x_G takes the inertia force out and
/// M - M^T is the torque of the forces. (Couples of rolling friction are no part of M: at rest M -
/// M^T then balances theirs.) The mean stress of a set of bodies is the sum of their moments over
/// the volume of the set; compression is negative. Throws input_error for a contact of a body
/// beyond the count.
template <int Dim>
void internal_moments(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> forces,
                      std::size_t body_count, std::vector<Matrix<Dim>>& moments) {
    jacobian.require_bodies(body_count);
    moments.assign(body_count, Matrix<Dim>::Zero());
    for (std::size_t c = 0; c < forces.size(); ++c) {
        moments[static_cast<std::size_t>(jacobian.a[c])] +=
            jacobian.arm_a[c] * forces[c].transpose();
        moments[static_cast<std::size_t>(jacobian.b[c])] -=
            jacobian.arm_b[c] * forces[c].transpose();
    }
}

/// The sum of the internal moments of a set of bodies taken contact by contact: branch vector from
/// centre a to centre b, times the force on a; where only one of the bodies is of the set
/// (`in_set(i)`; the other is a wall, say), from its centre to the contact point [N m].
template <int Dim, class InSet>
Matrix<Dim> branch_moment(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> forces,
                          InSet&& in_set) {
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    for (std::size_t c = 0; c < forces.size(); ++c) {
        const bool a = in_set(static_cast<std::size_t>(jacobian.a[c]));
        const bool b = in_set(static_cast<std::size_t>(jacobian.b[c]));
        Vector<Dim> branch = Vector<Dim>::Zero();
        if (a) branch += jacobian.arm_a[c];
        if (b) branch -= jacobian.arm_b[c];
        sum += branch * forces[c].transpose();
    }
    return sum;
}

/// Mean stress of the free bodies of a periodic cell by their contacts, branch_moment over the
/// volume of the cell [Pa; N/m in the plane]: [Christoffersen1981], compression negative. `forces`
/// are those of `contact_forces`. Throws input_error for a contact of a body beyond the count.
template <int Dim>
Matrix<Dim> cell_stress(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> forces,
                        const Bodies<Dim>& bodies, const PeriodicCell<Dim>& cell) {
    jacobian.require_bodies(bodies.count());
    const auto is_free = [&](std::size_t i) { return !bodies.is_obstacle(i); };
    return branch_moment(jacobian, forces, is_free) / cell.volume();
}

/// What the bodies' motion adds to that, of the moment as it is: - sum m c c^T over the volume,
/// with c the velocity of a body against that of the cell where it is, less the mean of all [Pa].
template <int Dim>
Matrix<Dim> kinetic_stress(const Bodies<Dim>& bodies, const PeriodicCell<Dim>& cell) {
    return (-1.0 / cell.volume()) * kinetic_moment(bodies, cell);
}

}  // namespace talus
