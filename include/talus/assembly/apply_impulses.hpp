// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/contact_problem.hpp>
#include <talus/spatial/twist.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// Adds M^-1 H r to world-axis twists: second line of [Moreau] (9), u_end = u_free + A^-1 sum G^T
/// r. Contacts are taken in their order, so the sum has the same bits whatever solver found r.
template <int Dim>
void apply_impulses(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass,
                    std::span<const Vector<Dim>> r, std::span<Twist<Dim>> twists) {
    const auto moved = [&](std::size_t k, const Vector<Dim>& impulse) -> Vector<Dim> {
        const Vector<Dim> change = inverse_mass.linear[k] * impulse;
        return inverse_mass.free_axes.empty() ? change
                                              : change.cwiseProduct(inverse_mass.free_axes[k]);
    };
    for (std::size_t c = 0; c < r.size(); ++c) {
        const auto a = static_cast<std::size_t>(jacobian.a[c]);
        const auto b = static_cast<std::size_t>(jacobian.b[c]);
        const Vector<Dim> impulse_world = jacobian.frame[c].transpose() * r[c];
        twists[a].linear += moved(a, impulse_world);
        twists[a].angular +=
            inverse_mass.angular[a] * moment<Dim>(jacobian.arm_a[c], impulse_world);
        twists[b].linear -= moved(b, impulse_world);
        twists[b].angular -=
            inverse_mass.angular[b] * moment<Dim>(jacobian.arm_b[c], impulse_world);
    }
}

/// Adds M^-1 of the moment impulses that contacts transmit beside them, on body a of each, world
/// axes [N m s], to world-axis twists: the part of rolling friction in u_end.
template <int Dim>
void apply_moments(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass,
                   std::span<const AngularVector<Dim>> moments, std::span<Twist<Dim>> twists) {
    for (std::size_t c = 0; c < moments.size(); ++c) {
        const auto a = static_cast<std::size_t>(jacobian.a[c]);
        const auto b = static_cast<std::size_t>(jacobian.b[c]);
        twists[a].angular += inverse_mass.angular[a] * moments[c];
        twists[b].angular -= inverse_mass.angular[b] * moments[c];
    }
}

/// As apply_impulses for the velocity gradient of a cell that a stress drives [1/s].
template <int Dim>
Matrix<Dim> cell_change(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass,
                        std::span<const Vector<Dim>> r) {
    Matrix<Dim> moment = Matrix<Dim>::Zero();
    for (std::size_t c = 0; c < jacobian.cell_lever.size(); ++c)
        moment -=
            Vector<Dim>(jacobian.frame[c].transpose() * r[c]) * jacobian.cell_lever[c].transpose();
    return Matrix<Dim>(inverse_mass.cell.cwiseProduct(moment));
}

}  // namespace talus
