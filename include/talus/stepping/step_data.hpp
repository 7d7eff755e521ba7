// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/column.hpp>
#include <talus/core/types.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/solver/report.hpp>
#include <talus/spatial/twist.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace talus {

/// Everything one step computed, in the order of its stages: what observers read. Memory is reused
/// from step to step.
template <int Dim, class Law>
struct StepData {
    double t_begin = 0.0;  ///< [s]
    double h = 0.0;        ///< step size [s]
    double t_mid() const { return t_begin + 0.5 * h; }
    double t_end() const { return t_begin + h; }

    PerBody<Wrench<Dim>> applied;            ///< user forces; empty if there are none
    PerBody<AngularVector<Dim>> gyroscopic;  ///< change of body-axis spin; empty if all zero
    /// Bodies that turn too far within the step, by 1.5 rad or more, for their angular momentum to
    /// be kept (Gyroscopic::momentum_preserving).
    std::size_t turned_too_far = 0;
    PerBody<Twist<Dim>> begin;  ///< u_begin, world axes
    PerBody<Twist<Dim>> free;   ///< u_free, world axes
    PerBody<Twist<Dim>> end;    ///< u_end, world axes

    ContactSet<Dim> contacts;               ///< at the midpoint configuration
    std::optional<PeriodicCell<Dim>> cell;  ///< the same, if there is one
    /// Velocity gradient of the cell that the loads alone would lead to, and that at the end [1/s].
    Matrix<Dim> cell_rate_free = Matrix<Dim>::Zero(), cell_rate_end = Matrix<Dim>::Zero();
    /// Of each body from its image at home [m]; empty unless a stress drives the cell.
    PerBody<Vector<Dim>> from_home;
    ContactProblem<Dim, Law> problem;  ///< what the solver was given
    Column<Vector<Dim>> impulse;       ///< r, local axes [N s]
    std::size_t recalled = 0;          ///< contacts that began with a remembered impulse
    SolveReport report;

    /// Mechanical energy that a gap correction gave to gravity in this step [J].
    double correction_work = 0.0;

    std::size_t contact_count() const { return contacts.count(); }
};

}  // namespace talus
