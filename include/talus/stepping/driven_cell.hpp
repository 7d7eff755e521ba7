// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/apply_impulses.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/dynamics/cell_drive.hpp>
#include <talus/stepping/step_data.hpp>

#include <cstddef>

namespace talus {

/// Makes a cell that a stress drives one more body of a step's problem.
template <int Dim, class Law, class SystemType>
void pose_cell(const SystemType& system, StepData<Dim, Law>& data) {
    const CellDrive<Dim>& drive = *system.cell_drive();
    data.cell_rate_free = drive.free_rate(*data.cell, data.t_mid(), data.h);
    home_offsets(*data.cell, system.bodies, system.bounding_radius(), data.from_home);
    assemble_cell_levers(data.from_home, data.problem.jacobian);
    data.problem.inverse_mass.cell = drive.mobility();
}

/// Adds to the free velocities of the contacts what the stress alone would do to the cell.
template <int Dim, class Law>
void add_cell_loads(StepData<Dim, Law>& data) {
    const ContactJacobian<Dim>& jacobian = data.problem.jacobian;
    const Matrix<Dim> change = data.cell_rate_free - jacobian.cell_rate;
    for (std::size_t c = 0; c < data.contact_count(); ++c)
        data.problem.free_velocity[c].template head<Dim>() -=
            jacobian.frame[c] * (change * jacobian.cell_lever[c]);
}

/// Gives the cell its rate at the end of the step, and bodies that have left it their part.
template <int Dim, class Law, class SystemType>
void apply_to_cell(SystemType& system, StepData<Dim, Law>& data) {
    data.cell_rate_end =
        data.cell_rate_free +
        cell_change<Dim>(data.problem.jacobian, data.problem.inverse_mass, data.impulse);
    const Matrix<Dim> change = data.cell_rate_end - data.cell->velocity_gradient();
    for (std::size_t i = 0; i < data.end.size(); ++i)
        if (!data.from_home[i].isZero(0.0)) data.end[i].linear += change * data.from_home[i];
    PeriodicCell<Dim> cell = *data.cell;
    cell.set_velocity_gradient(data.cell_rate_end);
    system.put_cell(cell);
}

/// How a step treats a driven cell: through pointers, so that programs without one have none of it
/// compiled.
template <class SystemType, class Data>
struct DriveRoutines {
    void (*pose)(const SystemType&, Data&);
    void (*add_loads)(Data&);
    void (*apply)(SystemType&, Data&);
};
template <int Dim, class Law, class SystemType>
inline constexpr DriveRoutines<SystemType, StepData<Dim, Law>> drive_routines{
    &pose_cell<Dim, Law, SystemType>, &add_cell_loads<Dim, Law>,
    &apply_to_cell<Dim, Law, SystemType>};

}  // namespace talus
