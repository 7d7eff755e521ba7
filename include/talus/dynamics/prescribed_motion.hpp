// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/spatial/pose.hpp>
#include <talus/spatial/twist.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// Motion of an obstacle as a function of time: the term W of [Moreau] equation (4). `pose` places
/// the shape, `twist` gives the velocity of its points. They must belong together, which every step
/// checks, except where `belt` or `with_surface` says that the surface moves otherwise than the
/// shape.
template <int Dim>
requires SpaceDimension<Dim>
class PrescribedMotion {
  public:
    /// Any motion: of time [s] the pose, and the twist in world axes.
    PrescribedMotion(std::function<Pose<Dim>(double)> pose, std::function<Twist<Dim>(double)> twist)
        : pose_(std::move(pose)), twist_(std::move(twist)) {}

    /// Stands still at `at`. Implicit: a pose is the motion of what does not move.
    PrescribedMotion(const Pose<Dim>& at = {})
        : PrescribedMotion([at](double) { return at; }, [](double) { return Twist<Dim>{}; }) {
        require_finite("position of the obstacle", at.position);
        made({Kind::still, at, {}, {}, {}});
    }

    Pose<Dim> pose(double t) const { return pose_(t); }     ///< at time t [s]
    Twist<Dim> twist(double t) const { return twist_(t); }  ///< world axes, at time t [s]
    /// Whether the twist is not that of the shape.
    bool surface_moves() const { return surface_moves_; }
    /// Of the differences that the twist is made of; 0: of none [s].
    double resolution() const { return resolution_; }

    /// Stands still at `at` while its surface moves as part of a rigid body of twist `surface`: an
    /// endless belt, a turntable. Of that velocity counts, at each contact, what goes along the
    /// surface: the shape of a belt comes nearer nowhere, not at its ends either.
    static PrescribedMotion belt(const Pose<Dim>& at, const Twist<Dim>& surface) {
        PrescribedMotion result =
            PrescribedMotion(at).with_surface([surface](double) { return surface; });
        result.made({Kind::belt, at, surface, {}, {}});
        return result;
    }
    /// The same places, with a surface of another twist (world axes, of time [s]), which counts as
    /// that of a belt does.
    PrescribedMotion with_surface(std::function<Twist<Dim>(double)> surface) const {
        PrescribedMotion result(pose_, std::move(surface));
        result.surface_moves_ = true;
        result.name_ = name_;
        return result;
    }

    /// How far the shape goes between two times [s], whatever its surface does [m, rad].
    [[gnu::noinline]] Twist<Dim> displacement(double begin, double end) const {
        const Pose<Dim> from = pose(begin), to = pose(end);
        return {to.position - from.position, (to.rotation * from.rotation.inverse()).log()};
    }

    /// Moves from `start` (at time 0) with constant velocity and spin.
    static PrescribedMotion uniform(const Pose<Dim>& start, const Twist<Dim>& v) {
        require_finite("position of the obstacle", start.position);
        PrescribedMotion result(
            [start, v](double t) {
                return Pose<Dim>{start.position + t * v.linear,
                                 Rotation<Dim>::exp(t * v.angular) * start.rotation};
            },
            [v](double) { return v; });
        result.made({Kind::uniform, start, v, {}, {}});
        return result;
    }

    /// Is shifted from `start` without turning: by `displacement(t)` [m], at `velocity(t)` [m/s].
    static PrescribedMotion shifted(const Pose<Dim>& start,
                                    std::function<Vector<Dim>(double)> displacement,
                                    std::function<Vector<Dim>(double)> velocity) {
        return {[start, d = std::move(displacement)](double t) {
                    return Pose<Dim>{start.position + d(t), start.rotation};
                },
                [v = std::move(velocity)](double t) {
                    return Twist<Dim>{v(t), AngularVector<Dim>::Zero()};
                }};
    }

    /// A motion known by its pose alone, whose twist is differentiated: by differences of fourth
    /// order over +-2 `resolution` [s], which should be a small part of the shortest time in which
    /// the motion changes. `pose` is asked that much before and after each step.
    static PrescribedMotion of_pose(std::function<Pose<Dim>(double)> pose,
                                    double resolution = 1e-5);

    /// Is shifted from `start` by displacements given in a table [m], cubic between the times [s]
    /// (with the slopes of parabolas through neighbours), at rest before the first and after the
    /// last. Throws input_error unless there are two or more, with ascending times.
    static PrescribedMotion of_displacements(const Pose<Dim>& start, std::vector<double> time,
                                             std::vector<Vector<Dim>> displacement);
    /// Is shifted from `start`, where it rests, by accelerations given in a table [m/s^2], linear
    /// between the times [s], zero before the first and after the last: a record of an earthquake.
    /// Velocity and displacement are its exact integrals; a record whose integral is not zero goes
    /// on moving. Throws as of_displacements.
    static PrescribedMotion of_accelerations(const Pose<Dim>& start, std::vector<double> time,
                                             std::vector<Vector<Dim>> acceleration);

    /// The same motion with a name, by which a checkpoint knows what it cannot write down: a motion
    /// made of functions.
    PrescribedMotion named(const std::string& name) const {
        PrescribedMotion result = *this;
        result.name_ = name;
        return result;
    }
    const std::string& name() const { return name_; }  ///< empty if it was given none

    /// How the motion was made, or, of one made of functions, its name.
    void write(NumberRecord& out) const;
    /// Makes the motion again; `of_name` gives those that are made of functions, by name.
    static PrescribedMotion read(
        NumberRecordReader& in,
        const std::function<PrescribedMotion(const std::string& name)>& of_name);

  private:
    enum class Kind { functions, still, belt, uniform, displacements, accelerations };
    /// How to make it again.
    struct Recipe {
        Kind kind = Kind::functions;
        Pose<Dim> start;
        Twist<Dim> twist;
        std::vector<double> time;
        std::vector<Vector<Dim>> table;
    };
    void made(Recipe recipe) { recipe_ = std::make_shared<const Recipe>(std::move(recipe)); }

    std::function<Pose<Dim>(double)> pose_;
    std::function<Twist<Dim>(double)> twist_;
    bool surface_moves_ = false;
    double resolution_ = 0.0;
    std::string name_;
    std::shared_ptr<const Recipe> recipe_;  // none of functions
};

namespace detail {

/// A piecewise cubic of time: value and slope at the knots.
template <int Dim>
struct MotionTable {
    std::vector<double> time;
    std::vector<Vector<Dim>> value, slope, bend;  // bend: second derivative at the left end

    /// The piece of time t: -1 before the first knot, the last knot from there on.
    std::ptrdiff_t piece(double t) const {
        return std::upper_bound(time.begin(), time.end(), t) - time.begin() - 1;
    }
};

inline void require_table(std::span<const double> time, std::size_t count, const char* item) {
    if (time.size() != count || count < 2)
        throw input_error(std::string("number of ") + item + " is " + std::to_string(count) +
                          ", but must be that of times (" + std::to_string(time.size()) +
                          ") and at least 2");
    for (std::size_t k = 0; k < count; ++k) {
        if (!std::isfinite(time[k]) || (k > 0 && !(time[k] > time[k - 1])))
            throw input_error("time " + std::to_string(k) + " of the table is " + text_of(time[k]) +
                              ", but must be finite and later than the one before");
    }
}

}  // namespace detail

template <int Dim>
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::of_pose(
    std::function<Pose<Dim>(double)> pose, double resolution) {
    require_positive("resolution", resolution);
    auto twist = [pose, resolution](double t) {
        const auto rate = [&](double reach) {
            const Pose<Dim> before = pose(t - reach), after = pose(t + reach);
            const double part = 0.5 / reach;
            return Twist<Dim>{part * (after.position - before.position),
                              part * (after.rotation * before.rotation.inverse()).log()};
        };
        const Twist<Dim> fine = rate(resolution), coarse = rate(2.0 * resolution);
        return Twist<Dim>{(4.0 * fine.linear - coarse.linear) / 3.0,
                          (4.0 * fine.angular - coarse.angular) / 3.0};
    };
    PrescribedMotion result(std::move(pose), std::move(twist));
    result.resolution_ = resolution;
    return result;
}

template <int Dim>
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::of_displacements(
    const Pose<Dim>& start, std::vector<double> time, std::vector<Vector<Dim>> displacement) {
    detail::require_table(time, displacement.size(), "displacements");
    Recipe recipe{Kind::displacements, start, {}, time, displacement};
    for (const Vector<Dim>& x : displacement) require_finite("displacement", x);
    const std::size_t n = time.size();
    detail::MotionTable<Dim> table{std::move(time), std::move(displacement), {}, {}};
    table.slope.assign(n, Vector<Dim>::Zero());
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const double left = table.time[k] - table.time[k - 1];
        const double right = table.time[k + 1] - table.time[k];
        table.slope[k] = (right / left * (table.value[k] - table.value[k - 1]) +
                          left / right * (table.value[k + 1] - table.value[k])) /
                         (left + right);
    }
    const auto shared = std::make_shared<const detail::MotionTable<Dim>>(std::move(table));
    // Hermite's cubic on the piece of t, or its derivative.
    const auto at = [shared](double t, bool derivative) -> Vector<Dim> {
        const std::ptrdiff_t p = shared->piece(t);
        const auto last = static_cast<std::ptrdiff_t>(shared->time.size()) - 1;
        if (p < 0 || p >= last) {
            if (derivative) return Vector<Dim>::Zero();
            return p < 0 ? shared->value.front() : shared->value.back();
        }
        const auto k = static_cast<std::size_t>(p);
        const double length = shared->time[k + 1] - shared->time[k];
        const double s = (t - shared->time[k]) / length;
        const Vector<Dim> way = shared->value[k + 1] - shared->value[k];
        const Vector<Dim>&a = shared->slope[k], &b = shared->slope[k + 1];
        if (derivative)
            return 6.0 * s * (1.0 - s) / length * way + (1.0 - s) * (1.0 - 3.0 * s) * a +
                   s * (3.0 * s - 2.0) * b;
        return shared->value[k] + s * s * (3.0 - 2.0 * s) * way +
               length * s * (1.0 - s) * ((1.0 - s) * a - s * b);
    };
    PrescribedMotion result = shifted(
        start, [at](double t) { return at(t, false); }, [at](double t) { return at(t, true); });
    result.made(std::move(recipe));
    return result;
}

template <int Dim>
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::of_accelerations(
    const Pose<Dim>& start, std::vector<double> time, std::vector<Vector<Dim>> acceleration) {
    detail::require_table(time, acceleration.size(), "accelerations");
    Recipe recipe{Kind::accelerations, start, {}, time, acceleration};
    for (const Vector<Dim>& a : acceleration) require_finite("acceleration", a);
    const std::size_t n = time.size();
    detail::MotionTable<Dim> table{std::move(time), {}, {}, std::move(acceleration)};
    table.value.assign(n, Vector<Dim>::Zero());
    table.slope.assign(n, Vector<Dim>::Zero());
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const double length = table.time[k + 1] - table.time[k];
        const Vector<Dim>&a = table.bend[k], &b = table.bend[k + 1];
        table.slope[k + 1] = table.slope[k] + 0.5 * length * (a + b);
        table.value[k + 1] =
            table.value[k] + length * table.slope[k] + length * length / 6.0 * (2.0 * a + b);
    }
    const auto shared = std::make_shared<const detail::MotionTable<Dim>>(std::move(table));
    const auto at = [shared](double t, bool derivative) -> Vector<Dim> {
        const std::ptrdiff_t p = shared->piece(t);
        if (p < 0) return Vector<Dim>::Zero();
        const auto k = static_cast<std::size_t>(p);
        const double s = t - shared->time[k];
        if (k + 1 == shared->time.size())
            return derivative ? shared->slope[k]
                              : Vector<Dim>(shared->value[k] + s * shared->slope[k]);
        const Vector<Dim>& a = shared->bend[k];
        const Vector<Dim> jerk =
            (shared->bend[k + 1] - a) / (shared->time[k + 1] - shared->time[k]);
        if (derivative) return shared->slope[k] + s * (a + 0.5 * s * jerk);
        return shared->value[k] + s * (shared->slope[k] + 0.5 * s * (a + s / 3.0 * jerk));
    };
    PrescribedMotion result = shifted(
        start, [at](double t) { return at(t, false); }, [at](double t) { return at(t, true); });
    result.made(std::move(recipe));
    return result;
}

template <int Dim>
requires SpaceDimension<Dim>
void PrescribedMotion<Dim>::write(NumberRecord& out) const {
    out.text(name_);
    out.integer(recipe_ ? static_cast<int>(recipe_->kind) : 0);
    if (!recipe_) return;
    out.array(recipe_->start.position);
    recipe_->start.rotation.write(out);
    out.array(recipe_->twist.linear);
    out.array(recipe_->twist.angular);
    out.integer(recipe_->time.size());
    for (std::size_t k = 0; k < recipe_->time.size(); ++k) {
        out.real(recipe_->time[k]);
        out.array(recipe_->table[k]);
    }
}

template <int Dim>
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::read(
    NumberRecordReader& in,
    const std::function<PrescribedMotion(const std::string& name)>& of_name) {
    std::string name = in.text();
    const auto kind = static_cast<Kind>(in.integer<int>(0, static_cast<int>(Kind::accelerations)));
    if (kind == Kind::functions) return of_name(name).named(std::move(name));
    Pose<Dim> start{in.array<Vector<Dim>>(), {}};
    start.rotation = Rotation<Dim>::read(in);
    Twist<Dim> twist{in.array<Vector<Dim>>(), {}};
    twist.angular = in.array<AngularVector<Dim>>();
    std::vector<double> time(in.count(Dim + 1, 0));
    std::vector<Vector<Dim>> table(time.size());
    for (std::size_t k = 0; k < time.size(); ++k) {
        time[k] = in.real();
        table[k] = in.array<Vector<Dim>>();
    }
    const auto made = [&]() -> PrescribedMotion {
        switch (kind) {
            case Kind::belt:
                return belt(start, twist);
            case Kind::uniform:
                return uniform(start, twist);
            case Kind::displacements:
                return of_displacements(start, std::move(time), std::move(table));
            case Kind::accelerations:
                return of_accelerations(start, std::move(time), std::move(table));
            default:
                return start;
        }
    };
    return made().named(std::move(name));
}

}  // namespace talus
