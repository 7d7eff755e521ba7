// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/cross.hpp>
#include <talus/dynamics/bodies.hpp>

#include <cstddef>

namespace talus {

/// Whether an impulse along the normal of contact c moves one of its bodies along it. Where axes
/// are locked it may not, as with a piston at the wall of its cylinder: such a contact determines
/// nothing, as between two obstacles, and is none.
template <int Dim>
bool can_part(const ContactSet<Dim>& contacts, std::size_t c, const Bodies<Dim>& bodies) {
    const auto a = static_cast<std::size_t>(contacts.key[c].a);
    const auto b = static_cast<std::size_t>(contacts.key[c].b);
    if (!bodies.locked[a].any() && !bodies.locked[b].any()) return true;
    const Vector<Dim>& n = contacts.normal[c];
    // Of what may move: a light body that is held fast says nothing of a heavy one.
    double scale = 0.0;
    const auto mobility = [&](std::size_t i, const Vector<Dim>& centre) {
        const LockedAxes<Dim>& locked = bodies.locked[i];
        const AngularVector<Dim> lever = moment<Dim>(Vector<Dim>(contacts.point[c] - centre), n);
        const AngularMatrix<Dim> inverse = inverse_inertia_world(bodies, i);
        if (!locked.all_translations()) scale += bodies.inverse_mass[i];
        if (!locked.all_rotations()) scale += lever.dot(inverse * lever);
        const AngularVector<Dim> turn = free_inverse_inertia_world(bodies, i) * lever;
        return bodies.inverse_mass[i] * n.dot(locked.free_part(n)) + lever.dot(turn);
    };
    constexpr double rounding = 1e-12;
    Vector<Dim> centre_b = bodies.position[b];
    if (!contacts.offset.empty()) centre_b += contacts.offset[c];
    const double both = mobility(a, bodies.position[a]) + mobility(b, centre_b);
    return both > rounding * scale;
}

}  // namespace talus
