// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/apply_impulses.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/cell_drive.hpp>
#include <talus/dynamics/kinetic_moment.hpp>
#include <talus/stepping/step_data.hpp>

#include <cmath>
#include <cstddef>

namespace talus {

/// Makes a cell that a stress drives one more body of a step's problem. Throws input_error where
/// there is no cell, and if the drive damps too much for the step.
template <int Dim, class Law, class SystemType>
void pose_cell(const SystemType& system, StepData<Dim, Law>& data) {
    const CellDrive<Dim>& drive = *system.cell_drive();
    if (!data.cell)
        throw input_error(
            "stress drives no cell, but must drive one: call set_cell, or drive_cell(std::nullopt) "
            "to take it away");
    drive.require_damping_within(data.h);
    data.cell_is_driven = true;
    data.cell_rate_free = drive.free_rate(*data.cell, kinetic_moment(system.bodies, *data.cell),
                                          data.t_mid(), data.h);
    assemble_cell_levers<Dim>(*data.cell, data.contacts.key, data.home, system.bounding_radius(),
                              data.problem.jacobian);
    data.problem.inverse_mass.cell = drive.mobility();
}

/// Whether an impulse along the normal of a contact changes the rate of the cell, whatever its
/// bodies do.
template <int Dim, class Law, class SystemType>
bool pushes_cell(const SystemType& system, const StepData<Dim, Law>& data, std::size_t c) {
    if (!data.cell || data.contacts.key[c].image.is_zero()) return false;
    const CellDrive<Dim>& drive = *system.cell_drive();
    const Vector<Dim>& normal = data.contacts.normal[c];
    const Vector<Dim>& offset = data.contacts.offset[c];
    constexpr double rounding = 1e-12;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
            if (drive.drives(i, j) && std::abs(normal[i] * offset[j]) > rounding * offset.norm())
                return true;
    return false;
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
template <int Dim, class SystemType, class Data>
struct DriveRoutines {
    /// Throws input_error where drive and cell do not go together.
    void (*meet)(const CellDrive<Dim>&, const PeriodicCell<Dim>&);
    void (*pose)(const SystemType&, Data&);
    bool (*pushes)(const SystemType&, const Data&, std::size_t contact);
    void (*add_loads)(Data&);
    void (*apply)(SystemType&, Data&);
};
template <int Dim, class Law, class SystemType>
inline constexpr DriveRoutines<Dim, SystemType, StepData<Dim, Law>> drive_routines{
    [](const CellDrive<Dim>& drive, const PeriodicCell<Dim>& cell) { drive.require_along(cell); },
    &pose_cell<Dim, Law, SystemType>, &pushes_cell<Dim, Law, SystemType>, &add_cell_loads<Dim, Law>,
    &apply_to_cell<Dim, Law, SystemType>};

}  // namespace talus
