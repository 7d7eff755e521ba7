// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>
#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/feed/place.hpp>
#include <talus/geometry/any_shape.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace talus {

/// A shape drawn at random, in a frame of its own.
template <int Dim, class ShapeType = AnyShape<Dim>>
using ShapeSource = std::function<ShapeType(Random&)>;

/// Balls whose radii follow a law.
template <int Dim, RadiusLaw Law>
ShapeSource<Dim> balls(Law radii) {
    return [radii](Random& random) { return AnyShape<Dim>(Ball<Dim>(radii(random))); };
}

/// What comes out of an inlet, and how fast.
template <int Dim, class ShapeType = AnyShape<Dim>>
requires SpaceDimension<Dim>
struct InletParams {
    Place<Dim> place;                   ///< of the centre of mass [m]
    ShapeSource<Dim, ShapeType> shape;  ///< its frame is turned at random
    double density = 2600.0;            ///< [kg/m^Dim]
    double rate = 100.0;                ///< bodies that come in a second [1/s]
    std::int64_t total = std::numeric_limits<std::int64_t>::max();  ///< bodies in all
    Vector<Dim> velocity = Vector<Dim>::Zero();                     ///< that they come with [m/s]
    double clearance = 0.0;  ///< to what is there already, at least [m]
    MaterialIndex material = 0;
    double begin = 0.0;  ///< when it opens [s]
    int tries = 10;      ///< places tried for each body in one call
    std::uint64_t seed = 1;
};

/// Adds bodies to a system while it moves, as an observer of its run:
///
///     const UniformRadii radii(4e-3, 6e-3);
///     Inlet<3> inlet({.place = at_point<3>({0, 0, 1}), .shape = balls<3>(radii),
///                     .rate = 200.0, .total = 14000});
///     const RunSummary run = sim.run(80.0, [&](auto&) { inlet.feed(sim.system(), sim.time()); });
///
/// A body comes when it is due and there is room for it: it touches nothing and keeps the
/// clearance. What finds no room stays due, with its shape, so that the shapes that come follow
/// their law however crowded the place is. The order of everything is fixed: same seed, same bits.
/// Part of a checkpoint by `record_of(inlet)` and `restore`.
template <int Dim, class ShapeType = AnyShape<Dim>>
requires SpaceDimension<Dim>
class Inlet {
  public:
    /// Throws input_error if a number is out of range, or there is no place or shape.
    explicit Inlet(InletParams<Dim, ShapeType> params)
        : params_(std::move(params)), random_(params_.seed), shapes_(~params_.seed) {
        require_positive("density of the inlet", params_.density);
        require_non_negative("rate of the inlet", params_.rate);
        require_in("total of the inlet", static_cast<double>(params_.total), 0.0, 1e19);
        require_finite("velocity of the inlet", params_.velocity);
        require_non_negative("clearance of the inlet", params_.clearance);
        require_in("begin of the inlet", params_.begin, -1e300, 1e300);
        require_in("tries of the inlet", params_.tries, 1, 1000000);
        if (!params_.place || !params_.shape)
            throw input_error("place or shape of the inlet is empty, but must be callable");
    }

    /// Adds what is due at `time` [s], as far as there is room; returns how many. O(bodies) for
    /// each try.
    template <class Law>
    std::size_t feed(System<Dim, Law, ShapeType>& system, double time);

    std::int64_t count() const { return count_; }  ///< that came so far
    /// Whether all have come.
    bool done() const { return count_ >= allowed(); }
    /// That are due at `time` and have not come.
    std::int64_t due(double time) const {
        if (!std::isfinite(time)) detail::reject("time of an inlet", time, "finite");
        const double flown = std::floor(params_.rate * (time - params_.begin) * (1.0 + 1e-13));
        const double most = static_cast<double>(params_.total);
        const auto scheduled =
            static_cast<std::int64_t>(std::clamp(flown, 0.0, std::min(most, most_bodies)));
        return scheduled + owed_ - count_;
    }
    /// Lets more come, as soon as there is room: those that a sink took, to be used again. Throws
    /// input_error beyond 1e18 in all.
    void owe(std::size_t bodies) {
        require_in("bodies that an inlet owes",
                   static_cast<double>(bodies) + static_cast<double>(owed_), 0.0, most_bodies);
        owed_ += static_cast<std::int64_t>(bodies);
    }

    /// How far it is; what it was made of is said again by the program.
    void write(NumberRecord& out) const {
        random_.write(out);
        shapes_.write(out);
        out.integer(count_);
        out.integer(owed_);
    }
    void restore(const NumberRecord& record) {
        NumberRecordReader in(record);
        constexpr auto most = static_cast<std::int64_t>(most_bodies);
        const Random random = Random::read(in), shapes = Random::read(in);
        const auto count = in.integer(0, most), owed = in.integer(0, most);
        in.require_end();
        random_ = random;
        shapes_ = shapes;
        count_ = count;
        owed_ = owed;
    }

  private:
    static constexpr double most_bodies = 1e18;  // so that sums of two are integers

    std::int64_t allowed() const {
        return params_.total > std::numeric_limits<std::int64_t>::max() - owed_
                   ? std::numeric_limits<std::int64_t>::max()
                   : params_.total + owed_;
    }
    template <class Law>
    bool has_room(const System<Dim, Law, ShapeType>& system, const ShapeType& shape,
                  const Pose<Dim>& pose);

    InletParams<Dim, ShapeType> params_;
    Random random_, shapes_;  // of places, and of shapes
    std::int64_t count_ = 0, owed_ = 0;
    Column<ContactPoint<Dim>> points_;
};

template <int Dim, class ShapeType>
requires SpaceDimension<Dim>
template <class Law>
std::size_t Inlet<Dim, ShapeType>::feed(System<Dim, Law, ShapeType>& system, double time) {
    std::size_t added = 0;
    for (std::int64_t left = due(time); left > 0; --left) {
        // A shape that finds no room is the next one too: small ones must not win by fitting.
        const Random before = shapes_;
        const ShapeType shape = params_.shape(shapes_);
        const auto principal = in_principal_frame<Dim>(shape);
        bool came = false;
        for (int k = 0; k < params_.tries && !came; ++k) {
            const Pose<Dim> pose{params_.place(random_), random_rotation<Dim>(random_)};
            if (!has_room(system, principal.shape, pose)) continue;
            const Inertia<Dim> inertia{params_.density * principal.volume,
                                       params_.density * principal.frame.moments};
            system.add(principal.shape, inertia, pose,
                       Twist<Dim>{params_.velocity, AngularVector<Dim>::Zero()}, params_.material);
            came = true;
        }
        if (!came) {
            shapes_ = before;
            break;
        }
        ++count_;
        ++added;
    }
    return added;
}

template <int Dim, class ShapeType>
requires SpaceDimension<Dim>
template <class Law>
bool Inlet<Dim, ShapeType>::has_room(const System<Dim, Law, ShapeType>& system,
                                     const ShapeType& shape, const Pose<Dim>& pose) {
    const Aabb<Dim> box = shape.aabb(pose).expanded(params_.clearance);
    const Vector<Dim> centre = 0.5 * (box.low + box.high);
    const double radius = 0.5 * (box.high - box.low).norm();
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        const double reach = radius + system.bounding_radius()[i];
        if ((system.bodies.position[i] - centre).squaredNorm() > reach * reach) continue;
        const Pose<Dim> other = system.bodies.pose(i);
        if (!box.overlaps(system.shapes()[i].aabb(other))) continue;
        points_.clear();
        contact_points<Dim>(shape, pose, system.shapes()[i], other, params_.clearance, points_);
        if (!points_.empty()) return false;
    }
    return true;
}

}  // namespace talus
