// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/forces.hpp>
#include <talus/dynamics/place.hpp>
#include <talus/dynamics/prescribed_motion.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/geometry/principal_shape.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/material_table.hpp>
#include <talus/law/weighted_mean.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
    struct Obstacle {
        BodyIndex body;
        PrescribedMotion<Dim> motion;
    };

    Bodies<Dim> bodies;
    std::vector<Obstacle> obstacles;
    Vector<Dim> gravity = Vector<Dim>::Zero();  ///< acceleration [m/s^2]
    std::vector<ForceField<Dim>> forces;
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
        return attach(bodies.add(inertia, pose * principal.frame.pose, twist, material),
                      principal.shape);
    }

    /// Adds a body of the given inertia, whose shape is given in its principal frame.
    template <Shape<Dim> S>
    BodyIndex add(const S& shape, const Inertia<Dim>& inertia, const Pose<Dim>& pose,
                  const Twist<Dim>& twist = {}, MaterialIndex material = 0) {
        require_between_steps();
        check_material(material);
        return attach(bodies.add(inertia, pose, twist, material), shape);
    }

    /// Adds an obstacle that moves as prescribed, where it is at `time()`; a pose in place of a
    /// motion makes it stand still.
    template <Shape<Dim> S>
    BodyIndex add_obstacle(const S& shape, PrescribedMotion<Dim> motion = {},
                           MaterialIndex material = 0) {
        require_between_steps();
        check_material(material);
        const BodyIndex body =
            attach(bodies.add_obstacle(motion.pose(time_), motion.twist(time_), material), shape);
        obstacles.push_back({body, std::move(motion)});
        placed_.push_back(placed_state(body));
        return body;
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

    /// Shapes in the bodies' frames, one for each body.
    std::span<const ShapeType> shapes() const { return shapes_; }
    /// Of each shape about the body's centre; infinite where it has no bound [m].
    std::span<const double> bounding_radius() const { return bounding_radius_; }
    /// Of each shape at its thinnest part, of compounds the thinnest child
    /// (talus::half_thickness); infinite for half-spaces; of what has none, as a rod without
    /// radius, the bounding radius [m].
    std::span<const double> half_thickness() const { return half_thickness_; }
    /// Gives a body another shape, in the body's frame; mass and inertia stay. Throws input_error
    /// if there is no such body.
    template <Shape<Dim> S>
    void set_shape(BodyIndex body, const S& shape) {
        require_between_steps();
        if (body < 0 || static_cast<std::size_t>(body) >= shapes_.size())
            detail::reject("body", body,
                           detail::numbered("an index from 0 below", shapes_.size(),
                                            ", the number of bodies with shapes"));
        replace_shape(static_cast<std::size_t>(body), ShapeType(shape));
    }
    /// Another number whenever some shape is another; copies of a system share it.
    std::uint64_t shapes_version() const { return shapes_version_; }

    /// Puts all obstacles where they are at time t [s]. With `reach` [s] it checks that poses and
    /// twists belong together, see `place`.
    void place_obstacles(double t, double reach = 0.0);
    /// Of the places of the obstacles [s].
    double time() const { return time_; }
    /// After the obstacles were put back where they were at another time.
    void set_time(double t) noexcept;
    /// Throws input_error if an obstacle is not as its motion left it: a place or a velocity
    /// written into `bodies` would be lost without a word at the next step.
    void require_obstacles_in_place() const;
    /// Throws input_error for inverse masses and moments that no body has, and for a body without
    /// mass or motion that has a velocity, with which it would push others and stay where it is.
    void require_masses() const;

    /// Keeps a step from being changed, or begun again, on its way. Throws input_error if one is on
    /// its way already.
    void begin_step() {
        require_between_steps();
        step_.under_way = true;
    }
    void end_step() noexcept { step_.under_way = false; }

    /// The law of a contact: that of the two bodies' materials.
    const Law& law_of(const ContactKey& key) const {
        return laws.at(bodies.material[static_cast<std::size_t>(key.a)],
                       bodies.material[static_cast<std::size_t>(key.b)]);
    }

    /// Mean over the free bodies of bounded shape; 0 if there are none [m].
    double mean_bounding_radius() const {
        return bounded_count_ > 0 ? bounded_radius_sum_ / static_cast<double>(bounded_count_) : 0.0;
    }

  private:
    void require_between_steps() const;
    void check_material(MaterialIndex material) const;
    BodyIndex attach(BodyIndex body, ShapeType shape);
    void move_up(const std::vector<BodyIndex>& to);
    /// Into the mean, as the last of those counted.
    void count_radius(std::size_t i) {
        if (!std::isfinite(bounding_radius_[i]) || bodies.is_obstacle(i)) return;
        bounded_radius_sum_ += bounding_radius_[i];
        ++bounded_count_;
    }
    void replace_shape(std::size_t body, ShapeType shape);
    static double radius_of(const ShapeType& shape);
    static double thickness_of(const ShapeType& shape, double radius) {
        const double half = talus::half_thickness<Dim>(shape);
        return half > 0.0 ? half : radius;
    }
    static std::uint64_t new_version();

    /// Of this system alone: a copy, taken within a step, is in none.
    struct Step {
        bool under_way = false;
        Step() = default;
        Step(const Step&) noexcept {}
        Step& operator=(const Step&) noexcept { return *this; }
    };
    /// As the motion of an obstacle left its body.
    struct Placed {
        BodyIndex body;
        PlacedState<Dim> state;
    };
    Placed placed_state(BodyIndex body) const {
        return {body, PlacedState<Dim>::of(bodies, static_cast<std::size_t>(body))};
    }

    double time_ = 0.0;
    Step step_;
    std::vector<Placed> placed_;  // in the order of obstacles
    std::vector<ShapeType> shapes_;
    std::vector<double> bounding_radius_, half_thickness_;
    std::uint64_t shapes_version_ = 0;
    double bounded_radius_sum_ = 0.0;
    std::size_t bounded_count_ = 0;
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
    std::vector<BodyIndex> to(n, -1);
    BodyIndex kept = 0;
    for (std::size_t i = 0; i < n; ++i)
        if (!out(i)) to[i] = kept++;
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
void System<Dim, Law, ShapeType>::move_up(const std::vector<BodyIndex>& to) {
    bodies.keep_if([&](std::size_t i) { return to[i] >= 0; });
    bounded_radius_sum_ = 0.0;
    bounded_count_ = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (to[i] < 0) continue;
        if (kept != i) shapes_[kept] = std::move(shapes_[i]);
        bounding_radius_[kept] = bounding_radius_[i];
        half_thickness_[kept] = half_thickness_[i];
        count_radius(kept);
        ++kept;
    }
    // (Not resize: a shape need not be default-constructible.)
    shapes_.erase(shapes_.begin() + static_cast<std::ptrdiff_t>(kept), shapes_.end());
    bounding_radius_.resize(kept);
    half_thickness_.resize(kept);
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
    shapes_version_ = new_version();
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
void System<Dim, Law, ShapeType>::require_obstacles_in_place() const {
    // Where the list of obstacles was written by hand there is no record to compare with.
    if (placed_.size() != obstacles.size()) return;
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        const auto i = static_cast<std::size_t>(obstacles[k].body);
        const bool recorded = placed_[k].body == obstacles[k].body;
        if (recorded && bodies.is_obstacle(i) && !placed_[k].state.is_of(bodies, i))
            detail::reject_motion(i, time_,
                                  " does not lead to where the body is or to its velocity, which "
                                  "were changed by hand, but must: change the motion "
                                  "(System::obstacles)");
    }
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::require_masses() const {
    const std::size_t n = bodies.count();
    if (require_masses_of(bodies) == obstacles.size()) return;
    const auto has_motion = [&](std::size_t i) {
        return std::any_of(obstacles.begin(), obstacles.end(), [i](const Obstacle& obstacle) {
            return static_cast<std::size_t>(obstacle.body) == i;
        });
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (!bodies.is_obstacle(i)) continue;
        const double speed = bodies.velocity[i].norm() + bodies.spin[i].norm();
        const double turns = bodies.inverse_inertia[i].maxCoeff();
        if ((speed == 0.0 && turns == 0.0) || has_motion(i)) continue;
        const std::string body = detail::numbered(" of body", i);
        if (turns != 0.0)
            detail::reject("inverse moment of inertia" + body, turns,
                           "0 like its inverse mass, which makes it an obstacle");
        detail::reject("velocity" + body, speed,
                       "0, as it has neither mass nor a prescribed motion");
    }
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::require_between_steps() const {
    if (step_.under_way)
        throw input_error(
            "bodies or shapes were changed, or a step begun, within a step, but must be between "
            "steps");
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
requires SpaceDimension<Dim> BodyIndex System<Dim, Law, ShapeType>::attach(BodyIndex body,
                                                                           ShapeType shape) {
    const double radius = radius_of(shape);
    bounding_radius_.push_back(radius);
    half_thickness_.push_back(thickness_of(shape, radius));
    shapes_.push_back(std::move(shape));
    shapes_version_ = new_version();
    count_radius(static_cast<std::size_t>(body));
    return body;
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
void System<Dim, Law, ShapeType>::replace_shape(std::size_t body, ShapeType shape) {
    const double radius = radius_of(shape);
    half_thickness_[body] = thickness_of(shape, radius);
    shapes_[body] = std::move(shape);
    const double old = std::exchange(bounding_radius_[body], radius);
    shapes_version_ = new_version();
    if (bodies.is_obstacle(body)) return;
    bounded_radius_sum_ +=
        (std::isfinite(radius) ? radius : 0.0) - (std::isfinite(old) ? old : 0.0);
    bounded_count_ += std::isfinite(radius) ? 1 : 0;
    bounded_count_ -= std::isfinite(old) ? 1 : 0;
}

template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim>
double System<Dim, Law, ShapeType>::radius_of(const ShapeType& shape) {
    const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
    return box.bounded() ? box.low.cwiseAbs().cwiseMax(box.high).norm()
                         : std::numeric_limits<double>::infinity();
}

/// Unlike any given before in this program, as a system may be replaced by another one.
template <int Dim, class Law, class ShapeType>
requires SpaceDimension<Dim> std::uint64_t System<Dim, Law, ShapeType>::new_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace talus

TALUS_IN_PLANE(struct talus::System<2>)
TALUS_IN_SPACE(struct talus::System<3>)
