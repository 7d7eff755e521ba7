// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/forces.hpp>
#include <talus/dynamics/place.hpp>
#include <talus/dynamics/prescribed_motion.hpp>
#include <talus/dynamics/run_state.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/geometry/principal_shape.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/material_table.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/stepping/body_shapes.hpp>
#include <talus/stepping/deforming_cell.hpp>
#include <talus/stepping/driven_cell.hpp>
#include <talus/stepping/obstacle_checks.hpp>
#include <talus/stepping/step_data.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// Coulomb friction with restitution by the weighted mean: the law of a simulation unless the user
/// asks for another.
template <int Dim>
using DefaultLaw = WeightedMean<Dim, Coulomb<Dim>>;

/// What a simulation is of: bodies with their shapes, obstacles with their motions, forces, and the
/// contact law of each pair of materials.
template <int Dim, class Law = DefaultLaw<Dim>, class ShapeType = AnyShape<Dim>>
requires SpaceDimension<Dim>
struct System {
    using Obstacle = talus::Obstacle<Dim>;

    Bodies<Dim> bodies;
    Column<Obstacle> obstacles;
    Vector<Dim> gravity = Vector<Dim>::Zero();  ///< acceleration [m/s^2]
    Column<ForceField<Dim>> forces;
    IgnoredPairs ignored;  ///< pairs that do not touch; groups of bodies: Bodies::groups
    MaterialTable<Law> laws;

    explicit System(MaterialTable<Law> laws_) : laws(std::move(laws_)) {}
    /// One material: the same law everywhere.
    explicit System(const Law& law) : laws(1, law) {}

    // Bodies and shapes can change between steps, not within one (by a force, a law, a hook), which
    // has begun without them: input_error.
    /// Adds a homogeneous body of the given density [kg/m^Dim]. `pose` places the shape as it was
    /// given; the body's own frame becomes the principal one. `twist` is of the mass centre.
    template <SolidShape<Dim> S>
    BodyIndex add(const S& shape, double density, const Pose<Dim>& pose,
                  const Twist<Dim>& twist = {}, MaterialIndex material = 0) {
        require_between_steps();
        require_positive("density", density);
        check_material(material);
        const auto principal = in_principal_frame<Dim>(shape);
        const Inertia<Dim> inertia{density * principal.volume, density * principal.frame.moments};
        return shapes_.add(principal.shape, [&] {
            return bodies.add(inertia, pose * principal.frame.pose, twist, material);
        });
    }

    /// Adds a body of the given inertia, whose shape is given in its principal frame.
    template <Shape<Dim> S>
    BodyIndex add(const S& shape, const Inertia<Dim>& inertia, const Pose<Dim>& pose,
                  const Twist<Dim>& twist = {}, MaterialIndex material = 0) {
        require_between_steps();
        check_material(material);
        return shapes_.add(shape, [&] { return bodies.add(inertia, pose, twist, material); });
    }

    /// Adds an obstacle that moves as prescribed, where it is at `time()`; a pose in place of a
    /// motion makes it stand still.
    template <Shape<Dim> S>
    BodyIndex add_obstacle(const S& shape, PrescribedMotion<Dim> motion = {},
                           MaterialIndex material = 0) {
        require_between_steps();
        check_material(material);
        return shapes_.add(shape, [&] {
            detail::make_room(obstacles, obstacles.size() + 1);
            detail::make_room(placed_, placed_.size() + 1);
            const BodyIndex body =
                bodies.add_obstacle(motion.pose(time_), motion.twist(time_), material);
            obstacles.push_back({body, std::move(motion)});
            placed_.push_back(placed_state(body));
            return body;
        });
    }

    /// Takes out the bodies, free ones and obstacles, for which `out(i)` holds. Those after them
    /// move up: indices change, ids do not, and the contacts between those that stay keep the
    /// impulses that the next step begins with. O(bodies) for any number: take out many at once.
    /// `StepData` of steps before is of the bodies there were then.
    template <class Out>
    std::size_t remove_if(Out&& out);
    /// Those of these names. Throws input_error, and removes none, if there is no such body.
    void remove(std::span<const BodyId> ids);
    void remove(BodyId id) { remove(std::span(&id, 1)); }

    /// Everything here that a RunState has: its clock and what it remembers are left as they are.
    void write_to(RunState<Dim, ShapeType>& state) const;
    /// Bodies, shapes, obstacles, pairs ignored, gravity and time of a state in place of those
    /// there are. Throws input_error, and changes nothing, where they do not fit together or the
    /// laws know no such material.
    void restore(const RunState<Dim, ShapeType>& state);

    /// Shapes in the bodies' frames, one for each body.
    std::span<const ShapeType> shapes() const { return shapes_.shapes(); }
    /// Of each shape about the body's centre; infinite where it has no bound [m].
    std::span<const double> bounding_radius() const { return shapes_.bounding_radius(); }
    /// Of each shape at its thinnest part, of compounds the thinnest child
    /// (talus::half_thickness); infinite for half-spaces; of what has none, as a rod without
    /// radius, the bounding radius [m].
    std::span<const double> half_thickness() const { return shapes_.half_thickness(); }
    /// Gives a body another shape, in the body's frame; mass and inertia stay. Throws input_error
    /// if there is no such body.
    template <Shape<Dim> S>
    void set_shape(BodyIndex body, const S& shape) {
        require_between_steps();
        if (body < 0 || static_cast<std::size_t>(body) >= shapes_.count())
            detail::reject("body", body,
                           detail::numbered("an index from 0 below", shapes_.count(),
                                            ", the number of bodies with shapes"));
        shapes_.replace(static_cast<std::size_t>(body), shape);
    }
    /// All of that as contact detection takes it, with its version, which copies share.
    ShapeList<Dim, ShapeType> shape_list() const { return shapes_.list(); }

    /// Puts all obstacles where they are at time t [s]. With `reach` [s] it checks that poses and
    /// twists belong together, see `place`.
    void place_obstacles(double t, double reach = 0.0);
    /// Of the places of the obstacles [s].
    double time() const { return time_; }
    /// After the obstacles were put back where they were at another time.
    void set_time(double t) noexcept;
    /// Throws input_error if an obstacle is not as its motion left it: a place or a velocity
    /// written into `bodies` would be lost without a word at the next step.
    void require_obstacles_in_place() const {
        require_in_place(bodies, std::span<const Obstacle>(obstacles),
                         std::span<const PlacedObstacle<Dim>>(placed_), time_);
    }
    /// Throws input_error for inverse masses and moments that no body has, and for a body without
    /// mass or motion that has a velocity, with which it would push others and stay where it is.
    void require_masses() const {
        require_masses_or_motions(bodies, std::span<const Obstacle>(obstacles));
    }

    /// Keeps a step from being changed, or begun again, on its way. Throws input_error if one is on
    /// its way already.
    void begin_step() {
        require_between_steps();
        step_.under_way = true;
    }
    void end_step() noexcept { step_.under_way = false; }
    void require_between_steps() const {
        if (step_.under_way)
            throw input_error(
                "bodies or shapes were changed, or a step begun, within a step, but must be "
                "between steps");
    }

    /// The periodic cell, if there is one, at `time()`.
    const std::optional<PeriodicCell<Dim>>& cell() const { return cell_; }
    /// From now on bodies meet each other's images; walls without bounds have none. In the place of
    /// another cell, a change of the rate is one as by set_velocity_gradient, about the homes in
    /// the new lattice. Throws input_error, and changes nothing, for what does not fit into the
    /// cell (require_room), and for a drive of what is not periodic.
    void set_cell(const PeriodicCell<Dim>& cell) {
        require_between_steps();
        require_room<Dim, ShapeType>(cell, bodies, shapes(), bounding_radius());
        if (drive_) drive_routines_->meet(*drive_, cell);
        if (cell_) cell_routines_->replace(*cell_, cell, bodies, bounding_radius());
        cell_ = cell;
        cell_routines_ = &talus::cell_routines<Dim, Law, ShapeType, System>;
    }
    void remove_cell() {
        require_between_steps();
        cell_.reset();
    }
    /// How the cell deforms from now on [1/s]. Throws, and changes the velocities of bodies that
    /// have left the cell (to be booked: record_exchange), as change_rate says.
    void set_velocity_gradient(const Matrix<Dim>& rate) {
        require_between_steps();
        change_rate(cell_, bodies, bounding_radius(), rate);
    }
    /// Lets a stress drive the cell, which there must be when a step is made, or (nullopt) leaves
    /// it at its rate; like forces no part of `state`. Throws input_error where the drive is not as
    /// it must be, or drives what is not periodic.
    void drive_cell(const std::optional<CellDrive<Dim>>& drive) {
        require_between_steps();
        if (drive) drive->require_valid();
        if (drive && cell_) drive->require_along(*cell_);
        drive_ = drive;
        drive_routines_ = &talus::drive_routines<Dim, Law, System>;
    }
    const std::optional<CellDrive<Dim>>& cell_drive() const { return drive_; }
    /// For steps: where there is a cell, where there is a drive.
    const auto& cell_routines() const { return *cell_routines_; }
    const auto& drive_routines() const { return *drive_routines_; }
    /// The cell as contact detection takes it in a step of that length [s].
    StepCell<Dim> step_cell(double h) const {
        return cell_ ? cell_routines_->images(*cell_, h) : StepCell<Dim>{};
    }
    void put_cell(const std::optional<PeriodicCell<Dim>>& cell) noexcept { cell_ = cell; }

    /// The law of a contact: that of the two bodies' materials.
    const Law& law_of(const ContactKey& key) const {
        return laws.at(bodies.material[static_cast<std::size_t>(key.a)],
                       bodies.material[static_cast<std::size_t>(key.b)]);
    }

    /// Mean over the free bodies of bounded shape; 0 if there are none [m]. O(bodies).
    double mean_bounding_radius() const;

  private:
    void check_material(MaterialIndex material) const;
    void move_up(const Column<BodyIndex>& to);

    /// Of this system alone: a copy, taken within a step, is in none.
    struct Step {
        bool under_way = false;
        Step() = default;
        Step(const Step&) noexcept {}
        Step& operator=(const Step&) noexcept { return *this; }
    };
    PlacedObstacle<Dim> placed_state(BodyIndex body) const {
        return {body, PlacedState<Dim>::of(bodies, static_cast<std::size_t>(body))};
    }

    double time_ = 0.0;
    Step step_;
    Column<PlacedObstacle<Dim>> placed_;  // in the order of obstacles
    BodyShapes<Dim, ShapeType> shapes_;
    std::optional<PeriodicCell<Dim>> cell_;
    std::optional<CellDrive<Dim>> drive_;
    const CellRoutines<Dim, System, StepData<Dim, Law>>* cell_routines_ = nullptr;
    const DriveRoutines<Dim, System, StepData<Dim, Law>>* drive_routines_ = nullptr;
};

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
template <class Out>
std::size_t System<Dim, Law, ShapeType>::remove_if(Out&& out) {
    require_between_steps();
    const std::size_t n = bodies.count();
    // All that may throw comes first.
    for (const Obstacle& obstacle : obstacles)
        require_in("body of an obstacle", obstacle.body, 0.0, static_cast<double>(n) - 1.0);
    Column<BodyIndex> to(n, -1);
    BodyIndex kept = 0;
    const std::int64_t removals = bodies.removals();
    for (std::size_t i = 0; i < n; ++i) {
        if (!out(i)) to[i] = kept++;
        if (bodies.count() != n || bodies.removals() != removals)
            throw input_error(detail::numbered(
                "number of bodies became", bodies.count(),
                " while it was asked which to remove, but must stay " + std::to_string(n)));
    }
    if (static_cast<std::size_t>(kept) == n) return 0;
    move_up(to);
    return n - static_cast<std::size_t>(kept);
}

// Defined apart, so that `extern template` can keep them from being compiled in every file.

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::remove(std::span<const BodyId> ids) {
    std::vector<bool> out(bodies.count(), false);
    for (const BodyId id : ids) out[static_cast<std::size_t>(bodies.index(id))] = true;
    remove_if([&](std::size_t i) { return out[i]; });
}

/// `to`: the new index of each body, -1 for those that go.
template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::move_up(const Column<BodyIndex>& to) {
    bodies.keep_if([&](std::size_t i) { return to[i] >= 0; });
    if (!ignored.empty()) ignored.erase_if([&](BodyId id) { return !bodies.find(id).has_value(); });
    shapes_.move_up(to);
    std::size_t listed = 0;
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const BodyIndex body = to[static_cast<std::size_t>(obstacles[k].body)];
        if (body < 0) continue;
        if (listed != k) obstacles[listed] = std::move(obstacles[k]);
        obstacles[listed].body = body;
        if (k < placed_.size()) {
            placed_[listed] = placed_[k];
            if (placed_[listed].body >= 0)
                placed_[listed].body = to[static_cast<std::size_t>(placed_[listed].body)];
        }
        ++listed;
    }
    obstacles.erase(obstacles.begin() + static_cast<std::ptrdiff_t>(listed), obstacles.end());
    placed_.resize(std::min(placed_.size(), listed));
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::place_obstacles(double t, double reach) {
    for (const Obstacle& obstacle : obstacles)
        place(bodies, static_cast<std::size_t>(obstacle.body), obstacle.motion, t, reach);
    placed_.resize(obstacles.size());
    set_time(t);
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::set_time(double t) noexcept {
    for (std::size_t k = 0; k < std::min(placed_.size(), obstacles.size()); ++k)
        placed_[k] = placed_state(obstacles[k].body);
    time_ = t;
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::check_material(MaterialIndex material) const {
    if (material < 0 || material >= laws.material_count())
        detail::reject(
            "material", material,
            detail::numbered("an index below", static_cast<std::size_t>(laws.material_count()),
                             ", the number of materials"));
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
double System<Dim, Law, ShapeType>::mean_bounding_radius() const {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < shapes_.count(); ++i) {
        const double radius = bounding_radius()[i];
        if (!std::isfinite(radius) || bodies.is_obstacle(i)) continue;
        sum += radius;
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::write_to(RunState<Dim, ShapeType>& state) const {
    state.bodies = bodies;
    state.shapes.assign(shapes().begin(), shapes().end());
    state.obstacles = obstacles;
    state.ignored = ignored;
    state.gravity = gravity;
    state.time = time_;
    state.cell = cell_;
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::restore(const RunState<Dim, ShapeType>& state) {
    require_between_steps();
    const std::size_t n = state.bodies.count();
    require_count("shapes", state.shapes.size(), "bodies", n);
    require_masses_of(state.bodies);
    require_count("materials", state.bodies.material.size(), "bodies", n);
    require_ids_of(state.bodies);
    for (const MaterialIndex material : state.bodies.material) check_material(material);
    require_finite("gravity", state.gravity);
    for (const Obstacle& obstacle : state.obstacles)
        require_in("body of an obstacle", obstacle.body, 0.0, static_cast<double>(n) - 1.0);
    System other(laws);
    other.bodies = state.bodies;
    for (const ShapeType& shape : state.shapes) other.shapes_.push_back(shape);
    other.obstacles = state.obstacles;
    other.ignored = state.ignored;
    for (const Obstacle& obstacle : other.obstacles)
        other.placed_.push_back(other.placed_state(obstacle.body));
    other.gravity = state.gravity;
    other.time_ = state.time;
    other.drive_ = drive_;
    other.drive_routines_ = drive_routines_;
    if (state.cell) other.set_cell(*state.cell);
    other.forces = std::move(forces);
    *this = std::move(other);
}

}  // namespace talus

TALUS_IN_PLANE(struct talus::System<2>)
TALUS_IN_SPACE(struct talus::System<3>)
