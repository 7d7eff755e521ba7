// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/cross.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/law/concepts.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace talus {

/// The linear map H^T from body velocities to relative velocities at the contacts, and its
/// transpose from impulses to wrench impulses, for contacts that join two rigid bodies:
///
///   u_c = F_c ( v_a + w_a x arm_a  -  v_b - w_b x arm_b )
///
/// with the rows of F_c the contact's axes; less F_c L lever_c where a stress drives a periodic
/// cell, whose velocity gradient L then is one more unknown. Body velocities are world-axis twists
/// at the configuration of the step's midpoint. One array per field; contacts in the order of their
/// keys.
template <int Dim>
requires SpaceDimension<Dim>
struct ContactJacobian {
    Column<BodyIndex> a;               ///< body that the normal points to
    Column<BodyIndex> b;               ///< the other one
    Column<Matrix<Dim>> frame;         ///< rows (n, t...)
    Column<Vector<Dim>> arm_a, arm_b;  ///< from the centres (of b its image's) to the point [m]
    /// Where a surface moves otherwise than its shape (PrescribedMotion::belt): the normal velocity
    /// of a relative to b by the shapes, less that by the surfaces [m/s]. Empty where none does.
    Column<double> held;
    /// Of contacts that know rolling: the length by which their rolling rows have the unit of the
    /// others, u_m = L (axes . (w_a - w_b)) [m/s] and moment = L (axes^T r_m) [N m], with the
    /// `rolling_axes` of the frame, positive [m]. Empty where none does.
    Column<double> rolling_length;
    /// In a periodic cell: from b to the image of it that touches [m]. Empty where there is no
    /// cell.
    Column<Vector<Dim>> offset;
    /// The rate at which the cell deforms [1/s], and on which way [m]: what touches on the side of
    /// b moves by `cell_rate carried` faster than b. Of images that is their offset. A wall without
    /// bounds is carried along with the body that it touches, as far as that is from home, and
    /// touches the image at home as it is. Empty where there is no cell.
    Matrix<Dim> cell_rate = Matrix<Dim>::Zero();
    Column<Vector<Dim>> carried;
    /// Levers by which impulses r change the rate of a cell that is driven by a stress, by
    /// - InverseMass::cell o (F^T r) lever^T: offsets between the images at home [m]. Empty of a
    /// cell whose rate is imposed.
    Column<Vector<Dim>> cell_lever;

    /// Throws input_error where a stress drives the cell, which is none of that kind of problem.
    void require_imposed_cell(const char* kind) const {
        if (!cell_lever.empty())
            throw input_error(
                std::string("periodic cell is driven by a stress, but must be imposed: ") + kind +
                " has no room for it");
    }
    /// Velocity that the cell adds to the side of b, world axes [m/s].
    Vector<Dim> image_velocity(std::size_t c) const {
        return carried.empty() ? Vector<Dim>::Zero() : Vector<Dim>(cell_rate * carried[c]);
    }
    std::size_t contact_count() const { return a.size(); }
    /// Throws input_error unless all contacts are of bodies with an index below `count`.
    void require_bodies(std::size_t count) const {
        for (std::size_t c = 0; c < contact_count(); ++c)
            if (const BodyIndex last = std::max(a[c], b[c]);
                static_cast<std::size_t>(last) >= count)
                detail::reject("body of a contact", last,
                               detail::numbered("an index below", count, ", the number of bodies"));
    }
    /// For n contacts, with some to spare.
    void make_room(std::size_t n) {
        detail::make_room(a, n);
        detail::make_room(b, n);
        detail::make_room(frame, n);
        detail::make_room(arm_a, n);
        detail::make_room(arm_b, n);
        if (!held.empty()) detail::make_room(held, n);
        if (!rolling_length.empty()) detail::make_room(rolling_length, n);
        if (!offset.empty()) detail::make_room(offset, n);
        if (!carried.empty()) detail::make_room(carried, n);
        if (!cell_lever.empty()) detail::make_room(cell_lever, n);
    }
    void resize(std::size_t n) {
        a.resize(n);
        b.resize(n);
        frame.resize(n);
        arm_a.resize(n);
        arm_b.resize(n);
        if (!held.empty()) held.resize(n);
        if (!rolling_length.empty()) rolling_length.resize(n);
        if (!offset.empty()) offset.resize(n);
        if (!carried.empty()) carried.resize(n);
        if (!cell_lever.empty()) cell_lever.resize(n);
    }
};

/// Inverse of the block-diagonal mass matrix in world axes. Obstacles have zeros: impulses do not
/// move them.
template <int Dim>
requires SpaceDimension<Dim>
struct InverseMass {
    Column<double> linear;               ///< 1/m [1/kg]
    Column<AngularMatrix<Dim>> angular;  ///< inverse inertia tensor, world [1/(kg m^2)]
    /// Of each body 1 along the axes of the world along which it moves, 0 along those that are
    /// locked. Empty where none has locked ones.
    Column<Vector<Dim>> free_axes;
    /// Of each component of the velocity gradient of a periodic cell; zero where it is imposed
    /// [1/(kg m^2)].
    Matrix<Dim> cell = Matrix<Dim>::Zero();

    std::size_t body_count() const { return linear.size(); }
    /// M^-1 of body k for translations, axis by axis [1/kg].
    Vector<Dim> translation(std::size_t k) const {
        return linear[k] * (free_axes.empty() ? Vector<Dim>::Ones() : free_axes[k]);
    }
    void resize(std::size_t n) {
        linear.resize(n);
        angular.resize(n);
        if (!free_axes.empty()) free_axes.resize(n);
    }
};

/// The whole input of a contact solver:  u = W r + free_velocity,  W = H^T M^-1 H,  and for every
/// contact its law between u and r. Knows nothing of shapes, time or step size. With a law that
/// knows rolling, u and r have the rolling rows as well (law_rows).
template <int Dim, BodyLaw<Dim> Law>
requires SpaceDimension<Dim>
struct ContactProblem {
    InverseMass<Dim> inverse_mass;
    ContactJacobian<Dim> jacobian;
    /// u_free: the relative velocity that the step would end with if all impulses were zero, the
    /// prescribed motion of obstacles (the term W of the paper) and restitution shifts included
    /// [m/s].
    Column<Vector<law_rows<Law, Dim>>> free_velocity;
    Column<Law> laws;

    std::size_t contact_count() const { return free_velocity.size(); }
};

}  // namespace talus
