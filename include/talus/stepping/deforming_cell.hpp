// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/cell_images.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/cell_home.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/geometry/shape_view.hpp>
#include <talus/stepping/step_data.hpp>

#include <cmath>
#include <cstddef>
#include <span>

namespace talus {

namespace detail {

/// Throws input_error unless a wall without bounds is its own image.
template <int Dim>
void require_wall_along(const PeriodicCell<Dim>& cell, const Bodies<Dim>& bodies, std::size_t body,
                        const ShapeView<Dim>& wall) {
    constexpr double rounding = 1e-9;
    for (int k = 0; k < Dim; ++k) {
        if (!cell.periodic()[static_cast<std::size_t>(k)]) continue;
        const Vector<Dim> along =
            bodies.rotation[body].transpose_times(Vector<Dim>(cell.lattice().col(k)));
        double across = 0.0;
        if (wall.kind() == ShapeKind::half_space) {
            across = std::abs(wall.template as<HalfSpace<Dim>>().normal().dot(along));
        } else {
            const Vector<Dim>& axis = wall.template as<RoundHole<Dim>>().axis();
            across = (along - axis.dot(along) * axis).norm();
        }
        if (!(across <= rounding * along.norm()))
            reject(numbered("part of lattice vector", static_cast<std::size_t>(k),
                            numbered(" across the wall, body", body, ",")),
                   across, "0, as walls have no images");
    }
}

}  // namespace detail

/// Throws input_error for a free body as wide (as the ball about its centre that holds it) as the
/// shortest lattice vector of the cell is long, which would meet its own image, and for a
/// half-space or a hole that lattice vectors do not shift into itself. O(bodies).
template <int Dim, class ShapeType>
void require_room(const PeriodicCell<Dim>& cell, const Bodies<Dim>& bodies,
                  std::span<const ShapeType> shapes, std::span<const double> bounding_radius) {
    const double shortest = cell.reduced().shortest();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (2.0 * bounding_radius[i] < shortest) continue;
        const ShapeView<Dim> view = view_of<Dim>(shapes[i]);
        if (view.is_wall()) {
            detail::require_wall_along(cell, bodies, i, view);
            continue;
        }
        const double width = 2.0 * farthest_point(view);
        if (bodies.is_obstacle(i) || !std::isfinite(width) || width < shortest) continue;
        detail::reject(
            "shortest lattice vector of the cell", shortest,
            detail::numbered("above the width of body", i,
                             ", " + detail::text_of(width) + ", which would meet its own image"));
    }
}

/// Deforms a cell for a part of a step [s]. Throws input_error for a strain beyond 0.25 in it, and
/// where nothing is left of the cell.
template <int Dim>
void deform(PeriodicCell<Dim>& cell, double duration) {
    constexpr double most_strain = 0.25;
    require_in("strain of the cell in half a step",
               std::abs(duration) * cell.velocity_gradient().norm(), 0.0, most_strain);
    cell.advance(duration);
}

/// Notes who is away from home, before bodies move: for the whole step.
template <int Dim, class Law, class SystemType>
void note_homes(const SystemType& system, StepData<Dim, Law>& data) {
    const PeriodicCell<Dim>& cell = *system.cell();
    if (!system.cell_drive() && cell.velocity_gradient() == Matrix<Dim>::Zero()) return;
    home_steps(cell, system.bodies, system.bounding_radius(), data.home);
    home_offsets(cell, data.home, data.from_home);
}

/// Deforms the cell for half a step, after bodies have drifted, and carries along those that are
/// away from home by `from_home`.
template <int Dim, class ShapeType, class Law, class SystemType>
void deform_half(SystemType& system, const StepData<Dim, Law>& data) {
    PeriodicCell<Dim> cell = *system.cell();
    deform(cell, 0.5 * data.h);
    require_room<Dim, ShapeType>(cell, system.bodies, system.shapes(), system.bounding_radius());
    system.put_cell(cell);
    if (data.from_home.empty()) return;
    CellCarriage<Dim>(cell.velocity_gradient(), 0.5 * data.h).apply(data.from_home, system.bodies);
}

/// To the midpoint, where offsets from home stay until the end.
template <int Dim, class ShapeType, class Law, class SystemType>
void deform_to_midpoint(SystemType& system, StepData<Dim, Law>& data) {
    deform_half<Dim, ShapeType>(system, data);
    if (!data.from_home.empty()) home_offsets(*system.cell(), data.home, data.from_home);
}

/// On to the end.
template <int Dim, class ShapeType, class Law, class SystemType>
void deform_to_end(SystemType& system, StepData<Dim, Law>& data) {
    deform_half<Dim, ShapeType>(system, data);
    if (!data.from_home.empty())
        data.cell_gains =
            CellGains<Dim>(data.cell->velocity_gradient(), data.cell_rate_end, 0.5 * data.h);
}

/// How a system and its step treat a periodic cell: through pointers, so that programs without one
/// have none of it compiled.
template <int Dim, class SystemType, class Data>
struct CellRoutines {
    StepCell<Dim> (*images)(const PeriodicCell<Dim>&, double h);
    void (*begin)(const SystemType&, Data&);
    void (*to_midpoint)(SystemType&, Data&);
    void (*carry_walls)(const SystemType&, Data&);
    void (*to_end)(SystemType&, Data&);
    void (*replace)(const PeriodicCell<Dim>&, const PeriodicCell<Dim>&, Bodies<Dim>&,
                    std::span<const double>);
};
template <int Dim, class Law, class ShapeType, class SystemType>
inline constexpr CellRoutines<Dim, SystemType, StepData<Dim, Law>> cell_routines{
    [](const PeriodicCell<Dim>& cell, double h) {
        return StepCell<Dim>::of(cell, Matrix<Dim>(h * cell.velocity_gradient()));
    },
    &note_homes<Dim, Law, SystemType>,
    &deform_to_midpoint<Dim, ShapeType, Law, SystemType>,
    [](const SystemType& system, StepData<Dim, Law>& data) {
        carry_walls(system.bounding_radius(), data.from_home, data.problem.jacobian);
    },
    &deform_to_end<Dim, ShapeType, Law, SystemType>,
    &replace_cell<Dim>};

}  // namespace talus
