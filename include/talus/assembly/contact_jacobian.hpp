// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/spatial/local_frame.hpp>

#include <cmath>
#include <cstddef>
#include <span>

namespace talus {

/// Fills H for the contacts of a configuration: axes and lever arms. Two free bodies share the
/// point half-way between their surfaces, which keeps their angular momentum; against an obstacle,
/// which has none to keep, arms end on the surfaces, so that no gap or overlap lengthens or
/// shortens them. Of images in a periodic cell, the arm is about the image's centre; how fast the
/// cell deforms, and how walls go along, is told later. O(contacts).
template <int Dim>
void assemble_jacobian(const ContactSet<Dim>& contacts, const Bodies<Dim>& bodies,
                       ContactJacobian<Dim>& jacobian) {
    jacobian.resize(contacts.count());
    jacobian.held.clear();
    jacobian.offset = contacts.offset;
    jacobian.carried = contacts.offset;
    jacobian.cell_rate.setZero();
    jacobian.cell_lever.clear();
    for (std::size_t c = 0; c < contacts.count(); ++c) {
        const BodyIndex a = contacts.key[c].a, b = contacts.key[c].b;
        jacobian.a[c] = a;
        jacobian.b[c] = b;
        jacobian.frame[c] = local_frame<Dim>(contacts.normal[c]);
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        // Where bodies are foreseen to slide, ends are those of the place where they will touch.
        const bool meets_here = contacts.slide[c].isZero(0.0);
        const double half =
            meets_here && (bodies.is_obstacle(i) || bodies.is_obstacle(j)) ? 0.5 : 0.0;
        const Vector<Dim> to_surface =
            half * contacts.gap[c] * contacts.normal[c] - 0.5 * contacts.slide[c];
        jacobian.arm_a[c] = contacts.point[c] + to_surface - bodies.position[i];
        jacobian.arm_b[c] =
            contacts.point[c] - to_surface -
            (contacts.offset.empty() ? bodies.position[j]
                                     : Vector<Dim>(bodies.position[j] + contacts.offset[c]));
    }
}

/// Fills `held` of a Jacobian from what each body's shape moves otherwise than its surface, shape
/// less surface (world axes). O(contacts).
template <int Dim>
void hold_surfaces(std::span<const Twist<Dim>> excess, ContactJacobian<Dim>& jacobian) {
    jacobian.held.resize(jacobian.contact_count());
    for (std::size_t c = 0; c < jacobian.contact_count(); ++c) {
        const Twist<Dim>& a = excess[static_cast<std::size_t>(jacobian.a[c])];
        const Twist<Dim>& b = excess[static_cast<std::size_t>(jacobian.b[c])];
        const Vector<Dim> missing = a.at(jacobian.arm_a[c]) - b.at(jacobian.arm_b[c]);
        jacobian.held[c] = (jacobian.frame[c] * missing)[0];
    }
}

/// Lets walls, bodies without bounds, go along with what touches them: `from_home` of each body
/// [m]. O(contacts).
template <int Dim>
void carry_walls(std::span<const double> bounding_radius, const PerBody<Vector<Dim>>& from_home,
                 ContactJacobian<Dim>& jacobian) {
    const auto is_wall = [&](BodyIndex i) {
        return !std::isfinite(bounding_radius[static_cast<std::size_t>(i)]);
    };
    for (std::size_t c = 0; c < jacobian.contact_count(); ++c) {
        const BodyIndex a = jacobian.a[c], b = jacobian.b[c];
        if (is_wall(a) || is_wall(b)) jacobian.carried[c] = from_home[a] - from_home[b];
    }
}

/// Fills the levers of a cell that is driven by a stress: from the image of a that is at home to
/// where that of b would be, and back from there to the one that touches; none at walls, which
/// touch at home. `home`: in lattice vectors, from the image at home to each body. O(contacts).
template <int Dim>
void assemble_cell_levers(const PeriodicCell<Dim>& cell, std::span<const ContactKey> keys,
                          const PerBody<typename PeriodicCell<Dim>::Steps>& home,
                          std::span<const double> bounding_radius, ContactJacobian<Dim>& jacobian) {
    jacobian.cell_lever.assign(keys.size(), Vector<Dim>::Zero());
    for (std::size_t c = 0; c < keys.size(); ++c) {
        const auto a = static_cast<std::size_t>(keys[c].a);
        const auto b = static_cast<std::size_t>(keys[c].b);
        if (!std::isfinite(bounding_radius[a]) || !std::isfinite(bounding_radius[b])) continue;
        typename PeriodicCell<Dim>::Steps steps = home[b];
        for (std::size_t k = 0; k < steps.size(); ++k) steps[k] += keys[c].image.n[k] - home[a][k];
        jacobian.cell_lever[c] = cell.offset(steps);
    }
}

/// Fills M^-1 for a configuration, in world axes. O(bodies).
template <int Dim>
void assemble_inverse_mass(const Bodies<Dim>& bodies, InverseMass<Dim>& inverse_mass) {
    inverse_mass.free_axes.clear();
    inverse_mass.cell.setZero();
    inverse_mass.resize(bodies.count());
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        inverse_mass.linear[i] = bodies.inverse_mass[i];
        inverse_mass.angular[i] = inverse_inertia_world<Dim>(bodies, i);
        const LockedAxes<Dim>& locked = bodies.locked[i];
        if (!locked.any()) continue;
        inverse_mass.free_axes.resize(bodies.count(), Vector<Dim>::Ones());
        inverse_mass.free_axes[i] = locked.free_part(Vector<Dim>::Ones());
        inverse_mass.angular[i] = free_inverse_inertia_world(bodies, i);
    }
}

/// Fills the lengths of rolling rows: the effective radius of the two bodies, 1 / L = 1 / R_a + 1 /
/// R_b [AiChenRotterOoi2011], of a ball on a plane its radius. `radius`: of each body [m], infinite
/// for what counts as flat; between two flat bodies L is 1 m. O(contacts).
template <int Dim>
void assemble_rolling_lengths(std::span<const double> radius, ContactJacobian<Dim>& jacobian) {
    jacobian.rolling_length.resize(jacobian.contact_count());
    for (std::size_t c = 0; c < jacobian.contact_count(); ++c) {
        const double curvature = 1.0 / radius[static_cast<std::size_t>(jacobian.a[c])] +
                                 1.0 / radius[static_cast<std::size_t>(jacobian.b[c])];
        jacobian.rolling_length[c] = curvature > 0.0 ? 1.0 / curvature : 1.0;
    }
}

/// Relative velocity of contact c when the bodies have the given world-axis twists:
/// U_c = G_c u + W_c [m/s], local axes ([Moreau] equation (4)). Of a surface that moves on a shape
/// that does not, only what goes along the surface counts. What a periodic cell that deforms adds
/// to images, and to walls, is a part of W. With `Rows` more than those of space: the rolling ones
/// as well.
template <int Dim, int Rows = Dim>
Vector<Rows> relative_velocity(const ContactJacobian<Dim>& jacobian, std::size_t c,
                               std::span<const Twist<Dim>> twists) {
    const Twist<Dim>& a = twists[static_cast<std::size_t>(jacobian.a[c])];
    const Twist<Dim>& b = twists[static_cast<std::size_t>(jacobian.b[c])];
    Vector<Dim> u = jacobian.frame[c] * (a.at(jacobian.arm_a[c]) - b.at(jacobian.arm_b[c]));
    if (!jacobian.carried.empty()) u -= jacobian.frame[c] * jacobian.image_velocity(c);
    if (!jacobian.held.empty()) u[0] += jacobian.held[c];
    if constexpr (Rows == Dim) {
        return u;
    } else {
        Vector<Rows> all;
        all.template head<Dim>() = u;
        all.template tail<Dim - 1>() =
            jacobian.rolling_length[c] *
            (rolling_axes<Dim>(jacobian.frame[c]) * (a.angular - b.angular));
        return all;
    }
}

/// The same while the cell deforms at another rate than the jacobian's [1/s].
template <int Dim>
Vector<Dim> relative_velocity(const ContactJacobian<Dim>& jacobian, std::size_t c,
                              std::span<const Twist<Dim>> twists, const Matrix<Dim>& cell_rate) {
    Vector<Dim> u = relative_velocity<Dim>(jacobian, c, twists);
    if (!jacobian.carried.empty() && cell_rate != jacobian.cell_rate)
        u -= jacobian.frame[c] * ((cell_rate - jacobian.cell_rate) * jacobian.carried[c]);
    return u;
}

}  // namespace talus
