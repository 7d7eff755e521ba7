// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>

namespace talus {

/// A stress that drives a periodic cell, component by component of its velocity gradient L: where
/// `driven(i, j)` is set, L_ij obeys
///
///   mass dL_ij/dt = V (stress_ij - sigma_ij) - mass damping L_ij
///
/// with sigma what the contacts with images exert (cell_stress, where bodies do not accelerate);
/// other components stay as they were set. The cell has a mass as the piston of a press has one
/// ([ParrinelloRahman1981]), and what pushes back comes out of the contacts of the same step: any
/// stress is stable on anything, rigid packings too. Bodies keep the velocity of the image that is
/// at home in the cell; those that have left it change theirs as the cell does.
template <int Dim>
requires SpaceDimension<Dim>
struct CellDrive {
    using Components =
        std::array<std::array<bool, static_cast<std::size_t>(Dim)>, static_cast<std::size_t>(Dim)>;

    Components driven = {};
    /// Of time [s]: what the cell is to be under, compression negative [Pa; N/m in the plane].
    std::function<Matrix<Dim>(double t)> stress;
    /// Of each component [kg m^2]: that of the bodies times the square of the cell's side makes
    /// the cell as slow as they are; less makes it follow the quicker.
    double mass = 0.0;
    double damping = 0.0;  ///< times the step size below 1 [1/s]
    /// The stress makes |L_ij| no larger than this [1/s].
    double top_rate = std::numeric_limits<double>::infinity();

    bool drives(int i, int j) const {
        return driven[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    /// A constant pressure on all normal components; the cell keeps its angles.
    static CellDrive pressure(double pressure_, double mass_) {
        require_finite("pressure on the cell", Vector<1>::Constant(pressure_));
        CellDrive drive{
            .driven = {},
            .stress =
                [pressure_](double) { return Matrix<Dim>(-pressure_ * Matrix<Dim>::Identity()); },
            .mass = mass_};
        for (std::size_t k = 0; k < drive.driven.size(); ++k) drive.driven[k][k] = true;
        return drive;
    }

    /// Throws input_error for numbers out of range, and without a stress.
    void require_valid() const {
        require_positive("mass of the cell", mass);
        require_non_negative("damping of the cell", damping);
        if (!(top_rate > 0.0)) detail::reject("top rate of the cell", top_rate, "positive");
        if (!stress) throw input_error("stress on the cell is empty, but must be callable");
    }
    /// One over the mass of each component that is driven, 0 of others [1/(kg m^2)].
    Matrix<Dim> mobility() const {
        Matrix<Dim> inverse = Matrix<Dim>::Zero();
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                if (drives(i, j)) inverse(i, j) = 1.0 / mass;
        return inverse;
    }
    /// The velocity gradient at the end of a step of that duration [s] if no contact pushed back.
    /// Throws input_error where the stress at time t [s] is not finite.
    Matrix<Dim> free_rate(const PeriodicCell<Dim>& cell, double t, double duration) const {
        const Matrix<Dim> target = require_finite("stress on the cell", stress(t));
        const double volume = cell.volume();
        Matrix<Dim> rate = cell.velocity_gradient();
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j) {
                if (!drives(i, j)) continue;
                const double change = volume * target(i, j) / mass - damping * rate(i, j);
                rate(i, j) = std::clamp(rate(i, j) + duration * change, -top_rate, top_rate);
            }
        return rate;
    }
};

/// From where each free body has an image at home, in the cell of the shortest lattice vectors, to
/// the body [m]; zero for obstacles, bodies with locked axes and those without bounds. When the
/// velocity gradient changes, a body changes its velocity by as much of that: its image at home
/// does not. O(bodies).
template <int Dim>
void home_offsets(const PeriodicCell<Dim>& cell, const Bodies<Dim>& bodies,
                  std::span<const double> bounding_radius, PerBody<Vector<Dim>>& offsets) {
    const ReducedLattice<Dim> lattice = cell.reduced();
    const Matrix<Dim> inverse = inverted(lattice.vectors).inverse;
    offsets.assign(bodies.count(), Vector<Dim>::Zero());
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i) || bodies.locked[i].any() || !std::isfinite(bounding_radius[i]))
            continue;
        const Vector<Dim> s = inverse * bodies.position[i];
        for (int k = 0; k < Dim; ++k)
            if (lattice.periodic[static_cast<std::size_t>(k)])
                offsets[i] += std::floor(s[k]) * Vector<Dim>(lattice.vectors.col(k));
    }
}

/// Changes the velocity gradient of a cell between two steps [1/s], and the velocities of bodies as
/// home_offsets says. Throws input_error, and changes nothing, if it is not finite or there is no
/// cell.
template <int Dim>
void change_rate(std::optional<PeriodicCell<Dim>>& cell, Bodies<Dim>& bodies,
                 std::span<const double> bounding_radius, const Matrix<Dim>& rate) {
    if (!cell)
        throw input_error("velocity gradient is of no cell, but must be of one: call set_cell");
    const Matrix<Dim> before = cell->velocity_gradient();
    PerBody<Vector<Dim>> from_home;
    home_offsets(*cell, bodies, bounding_radius, from_home);
    cell->set_velocity_gradient(rate);
    for (std::size_t i = 0; i < bodies.count(); ++i)
        if (!from_home[i].isZero(0.0)) bodies.velocity[i] += (rate - before) * from_home[i];
}

}  // namespace talus
