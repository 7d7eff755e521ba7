// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

namespace talus {

/// A stress that drives a periodic cell, component by component of its velocity gradient L: where
/// `driven(i, j)` is set, L_ij obeys
///
///   mass dL_ij/dt = V (stress_ij - sigma_ij) - mass damping L_ij
///
/// with sigma the whole stress of the bodies ([ParrinelloRahman1981]): what contacts with images
/// exert at the end of the step (cell_stress, where bodies do not accelerate) and what their motion
/// carries at its midpoint, - kinetic_moment / V (kinetic_stress); other components stay as they
/// were set. Without the second part each body that leaves the home of a cell that shrinks would
/// take energy from nowhere, and a gas would be pressed beyond its target. The cell has a mass as
/// the piston of a press has one, and what pushes back comes out of the contacts of the same step:
/// any stress is stable on anything, rigid packings too. Motion pushes back explicitly: of a gas,
/// h^2 times kinetic_moment should be well below the mass. The image of a body at home keeps its
/// velocity when L changes; bodies that have left the home change theirs as the cell does.
///
///     sim.system().set_cell(PeriodicCell<3>::box({0.1, 0.1, 0.1}));
///     sim.system().drive_cell(CellDrive<3>::pressure(1e5, 0.01));
template <int Dim>
requires SpaceDimension<Dim>
struct CellDrive {
    using Components =
        std::array<std::array<bool, static_cast<std::size_t>(Dim)>, static_cast<std::size_t>(Dim)>;
    using Directions = typename PeriodicCell<Dim>::Directions;

    Components driven = {};
    /// Of time [s]: what the cell is to be under, compression negative [Pa; N/m in the plane].
    std::function<Matrix<Dim>(double t)> stress;
    /// Of each component [kg m^2]: that of the bodies times the square of the cell's side makes
    /// the cell as slow as they are; less makes it follow the quicker.
    double mass = 0.0;
    double damping = 0.0;  ///< times the step size below 1, which steps ask for [1/s]
    /// The stress makes |L_ij| no larger than this [1/s].
    double top_rate = std::numeric_limits<double>::infinity();

    bool drives(int i, int j) const {
        return driven[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    /// A constant pressure on the normal components along some axes, unless told all; the cell
    /// keeps its angles.
    static CellDrive pressure(double pressure_, double mass_,
                              const Directions& along = PeriodicCell<Dim>::all_directions()) {
        require_finite("pressure on the cell", Vector<1>::Constant(pressure_));
        CellDrive drive{
            .driven = {},
            .stress =
                [pressure_](double) { return Matrix<Dim>(-pressure_ * Matrix<Dim>::Identity()); },
            .mass = mass_};
        for (std::size_t k = 0; k < drive.driven.size(); ++k) drive.driven[k][k] = along[k];
        return drive;
    }

    /// Throws input_error for numbers out of range, without a stress and if no component is driven.
    void require_valid() const {
        require_positive("mass of the cell", mass);
        require_non_negative("damping of the cell", damping);
        if (!(top_rate > 0.0)) detail::reject("top rate of the cell", top_rate, "positive");
        if (!stress) throw input_error("stress on the cell is empty, but must be callable");
        if (driven == Components{})
            detail::reject("number of components of the cell that are driven", 0, "at least 1");
    }
    /// Throws input_error where nothing could push back: for a component (i, j) along whose axis j
    /// the cell is not periodic (the axis must be one along periodic lattice vectors).
    void require_along(const PeriodicCell<Dim>& cell) const {
        constexpr double rounding = 1e-9;
        const Matrix<Dim> inverse = inverted(cell.lattice()).inverse;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                for (int k = 0; drives(i, j) && k < Dim; ++k) {
                    const double part = std::abs(inverse(k, j)) * cell.lattice().col(k).norm();
                    if (cell.periodic()[static_cast<std::size_t>(k)] || part <= rounding) continue;
                    detail::reject(
                        detail::numbered(
                            "driven component (" + std::to_string(i) + ",",
                            static_cast<std::size_t>(j),
                            detail::numbered("): part of its second axis along lattice vector",
                                             static_cast<std::size_t>(k), ", not periodic,")),
                        part, "0, as nothing pushes back there");
                }
    }
    /// Throws input_error where damping takes more speed from the cell than it has, within that
    /// time [s].
    void require_damping_within(double duration) const {
        if (!(damping * duration < 1.0))
            detail::reject("damping of the cell times the step size", damping * duration,
                           "below 1");
    }
    /// One over the mass of each component that is driven, 0 of others [1/(kg m^2)].
    Matrix<Dim> mobility() const {
        Matrix<Dim> inverse = Matrix<Dim>::Zero();
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                if (drives(i, j)) inverse(i, j) = 1.0 / mass;
        return inverse;
    }
    /// The velocity gradient at the end of a step of that duration [s] if no contact pushed back,
    /// of bodies that carry this `kinetic_moment` [J]. Throws input_error where the stress at time
    /// t [s] is not finite.
    Matrix<Dim> free_rate(const PeriodicCell<Dim>& cell, const Matrix<Dim>& kinetic, double t,
                          double duration) const {
        const Matrix<Dim> target = require_finite("stress on the cell", stress(t));
        const double volume = cell.volume();
        Matrix<Dim> rate = cell.velocity_gradient();
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j) {
                if (!drives(i, j)) continue;
                const double change =
                    (volume * target(i, j) + kinetic(i, j)) / mass - damping * rate(i, j);
                rate(i, j) = std::clamp(rate(i, j) + duration * change, -top_rate, top_rate);
            }
        return rate;
    }
};

}  // namespace talus
