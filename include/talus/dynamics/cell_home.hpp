// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace talus {

/// In lattice vectors, from where each free body has an image at home, in the cell of the shortest
/// lattice vectors, to the body. Zero for those that are not carried by the cell: obstacles, bodies
/// with a locked translation and those without bounds. Throws input_error for bodies 2^31 cells
/// away. O(bodies).
template <int Dim>
void home_steps(const PeriodicCell<Dim>& cell, const Bodies<Dim>& bodies,
                std::span<const double> bounding_radius,
                PerBody<typename PeriodicCell<Dim>::Steps>& steps) {
    constexpr double most = 2147483648.0;
    const ReducedLattice<Dim> lattice = cell.reduced();
    const Matrix<Dim> inverse = inverted(lattice.vectors).inverse;
    steps.assign(bodies.count(), {});
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        const auto& locked = bodies.locked[i].translation;
        if (bodies.is_obstacle(i) || !std::isfinite(bounding_radius[i]) ||
            std::any_of(locked.begin(), locked.end(), [](bool l) { return l; }))
            continue;
        const Vector<Dim> s = inverse * bodies.position[i];
        for (int k = 0; k < Dim; ++k) {
            if (!lattice.periodic[static_cast<std::size_t>(k)]) continue;
            const double cells = std::floor(s[k]);
            if (!(std::abs(cells) <= most))
                detail::reject(
                    detail::numbered("distance from the origin of body", i, ", in cells,"), cells,
                    "within 2^31");
            steps[i][static_cast<std::size_t>(k)] = static_cast<std::int64_t>(cells);
        }
        steps[i] = lattice.in_lattice(steps[i]);
    }
}

/// The same as vectors [m].
template <int Dim>
void home_offsets(const PeriodicCell<Dim>& cell,
                  const PerBody<typename PeriodicCell<Dim>::Steps>& steps,
                  PerBody<Vector<Dim>>& offsets) {
    offsets.assign(steps.size(), Vector<Dim>::Zero());
    for (std::size_t i = 0; i < steps.size(); ++i) offsets[i] = cell.offset(steps[i]);
}

/// What bodies away from home by s need after a drift while a cell deforms for a time at the rate
/// L, so that their images at home drift on straight lines. With E = exp(L t) - 1, the way of s is
/// E s:
///
///   x += (E - L t) s,   v += L E s
///
/// of which the sum over time is L^2 s. Both are exactly zero in simple shear.
template <int Dim>
requires SpaceDimension<Dim>
struct CellCarriage {
    Matrix<Dim> way;   ///< E - L t [-]
    Matrix<Dim> gain;  ///< L E [1/s]

    CellCarriage(const Matrix<Dim>& rate, double duration) {
        const Matrix<Dim> strain = duration * rate;
        const Matrix<Dim> moved = exponential_less_one(strain);
        way = moved - strain;
        gain = rate * moved;
    }
    /// `from_home`: the offsets s before the drift [m].
    void apply(const PerBody<Vector<Dim>>& from_home, Bodies<Dim>& bodies) const {
        for (std::size_t i = 0; i < from_home.size(); ++i) {
            if (from_home[i].isZero(0.0)) continue;
            bodies.position[i] += way * from_home[i];
            bodies.velocity[i] += gain * from_home[i];
        }
    }
};

/// What a step, whose parts are before and after its midpoint, makes of bodies away from home by s
/// at the midpoint, beyond what they have of u_begin and u_end there.
template <int Dim>
requires SpaceDimension<Dim>
struct CellGains {
    Matrix<Dim> begin = Matrix<Dim>::Zero();  ///< times s: velocity gained before [1/s]
    Matrix<Dim> end = Matrix<Dim>::Zero();    ///< and after [1/s]
    Matrix<Dim> way =
        Matrix<Dim>::Zero();  ///< times s: the way beyond that of the mean velocity [-]

    CellGains() = default;
    /// Of rates L in the two parts, of that duration each [s].
    CellGains(const Matrix<Dim>& rate_begin, const Matrix<Dim>& rate_end, double duration) {
        const Matrix<Dim> back = exponential_less_one(Matrix<Dim>(-duration * rate_begin));
        const Matrix<Dim> there = exponential_less_one(Matrix<Dim>(duration * rate_end));
        begin = -1.0 * (rate_begin * back);
        end = rate_end * there;
        way = (there - back) - duration * (rate_begin + rate_end);
    }
};

/// What bodies gain when a cell takes the place of another between two steps, of which the rate L
/// [1/s] may differ: those away from home by s in the new lattice (L_after - L_before) s, so that
/// their images at home keep their velocities. Changes nothing where it throws.
template <int Dim>
void replace_cell(const PeriodicCell<Dim>& before, const PeriodicCell<Dim>& after,
                  Bodies<Dim>& bodies, std::span<const double> bounding_radius) {
    const Matrix<Dim> change = after.velocity_gradient() - before.velocity_gradient();
    if (change == Matrix<Dim>::Zero()) return;
    PerBody<typename PeriodicCell<Dim>::Steps> home;
    home_steps(after, bodies, bounding_radius, home);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        const Vector<Dim> from_home = after.offset(home[i]);
        if (!from_home.isZero(0.0)) bodies.velocity[i] += change * from_home;
    }
}

/// Changes the velocity gradient of a cell between two steps [1/s], and the velocities of bodies as
/// replace_cell says. Throws input_error, and changes nothing, if it is not finite or there is no
/// cell.
template <int Dim>
void change_rate(std::optional<PeriodicCell<Dim>>& cell, Bodies<Dim>& bodies,
                 std::span<const double> bounding_radius, const Matrix<Dim>& rate) {
    if (!cell)
        throw input_error("velocity gradient is of no cell, but must be of one: call set_cell");
    PeriodicCell<Dim> after = *cell;
    after.set_velocity_gradient(rate);
    replace_cell(*cell, after, bodies, bounding_radius);
    cell = after;
}

}  // namespace talus
