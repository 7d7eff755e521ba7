// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/column.hpp>
#include <talus/core/types.hpp>
#include <talus/dynamics/cell_home.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/solver/report.hpp>
#include <talus/spatial/twist.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace talus {

namespace detail {

/// The impulses of all contacts as a solver sees them, where these are no longer those of StepData:
/// with rolling rows.
template <int Dim, int Rows>
struct SolverImpulses {
    Column<Vector<Rows>> r;
};
template <int Dim>
struct SolverImpulses<Dim, Dim> {};

}  // namespace detail

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
    /// World axes. Of bodies away from the home of a periodic cell, s at the midpoint, what
    /// stands here is that of the image at home, which does not change on the way to the midpoint
    /// and from there, and L s (`cell_gains` is the rest).
    PerBody<Twist<Dim>> begin;  ///< u_begin
    PerBody<Twist<Dim>> free;   ///< u_free
    PerBody<Twist<Dim>> end;    ///< u_end

    ContactSet<Dim> contacts;               ///< at the midpoint configuration
    std::optional<PeriodicCell<Dim>> cell;  ///< the same, if there is one
    /// Velocity gradient of the cell that the loads alone would lead to, and that at the end [1/s].
    Matrix<Dim> cell_rate_free = Matrix<Dim>::Zero(), cell_rate_end = Matrix<Dim>::Zero();
    bool cell_is_driven = false;  ///< by a stress
    /// Of each body from its image at home, s, at the midpoint: in lattice vectors, and as a vector
    /// [m]. Empty where the cell neither deforms nor is driven.
    PerBody<typename PeriodicCell<Dim>::Steps> home;
    PerBody<Vector<Dim>> from_home;
    CellGains<Dim> cell_gains;         ///< of bodies away from home
    ContactProblem<Dim, Law> problem;  ///< what the solver was given
    Column<Vector<Dim>> impulse;       ///< r, local axes [N s]
    /// Moment impulses of rolling friction on the first body of each contact, world axes [N m s];
    /// empty for laws without.
    Column<AngularVector<Dim>> moment;
    std::size_t recalled = 0;  ///< contacts that began with a remembered impulse
    SolveReport report;

    /// Mechanical energy that a gap correction gave to gravity in this step [J].
    double correction_work = 0.0;

    std::size_t contact_count() const { return contacts.count(); }

    /// r with all rows of the problem, as a solver takes and leaves it: `impulse` itself or, with
    /// rolling friction, an array beside it, which steps fill from `impulse` and `moment` before a
    /// solve and read into them after it.
    std::span<Vector<law_rows<Law, Dim>>> solution() { return solver_rows(*this); }
    std::span<const Vector<law_rows<Law, Dim>>> solution() const { return solver_rows(*this); }

    [[no_unique_address]] detail::SolverImpulses<Dim, law_rows<Law, Dim>> solver_impulses;

  private:
    template <class Data>
    static auto& solver_rows(Data& data) {
        if constexpr (has_rolling_rows<Law>)
            return data.solver_impulses.r;
        else
            return data.impulse;
    }
};

}  // namespace talus
