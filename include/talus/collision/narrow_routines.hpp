// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/core_contacts.hpp>
#include <talus/collision/own_pairs.hpp>
#include <talus/collision/support_contacts.hpp>
#include <talus/core/column.hpp>

#include <span>

namespace talus {

/// append_core_contacts.
template <int Dim>
using CoreRoutine = void (*)(const CoreView<Dim>& a, const Pose<Dim>& pose_a,
                             const CoreView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                             Column<ContactPoint<Dim>>& out);
/// append_support_contact.
template <int Dim>
using SupportRoutine = void (*)(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                                const ShapeView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                                Column<ContactPoint<Dim>>& out);

/// What the narrow phase has for the shapes that can come, beyond balls and walls. The routines of
/// faces and edges, and that of support mappings, are the larger part of it, and most programs need
/// one of them or none: called through pointers that are null where no shape needs them, they are
/// compiled for those who do alone.
template <int Dim>
requires SpaceDimension<Dim>
struct NarrowRoutines {
    CoreRoutine<Dim> core = nullptr;        ///< for shapes with core() that are no balls
    SupportRoutine<Dim> support = nullptr;  ///< for shapes with support() and nothing better
    std::span<const OwnPair<Dim>> own;      ///< of one's own: these go first

    /// With those of `other` for core and support.
    void add(const NarrowRoutines& other) {
        if (other.core) core = other.core;
        if (other.support) support = other.support;
    }
};

namespace detail {

template <int Dim, class A, class B>
constexpr NarrowRoutines<Dim> make_narrow_routines() {
    NarrowRoutines<Dim> routines;
    if constexpr (may_hold<Dim, A, B>(ShapeKind::core)) routines.core = &append_core_contacts<Dim>;
    if constexpr (may_hold<Dim, A, B>(ShapeKind::convex))
        routines.support = &append_support_contact<Dim>;
    routines.own = own_pairs<Dim, A, B>;
    return routines;
}

}  // namespace detail

/// Those for all that an A, a B and the shapes in them may meet in each other.
template <int Dim, class A, class B = A>
inline constexpr NarrowRoutines<Dim> narrow_routines = detail::make_narrow_routines<Dim, A, B>();

}  // namespace talus
