// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
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
struct PrescribedMotion {
    std::function<Pose<Dim>(double)> pose;    ///< of time [s]
    std::function<Twist<Dim>(double)> twist;  ///< world axes, of time [s]
    bool surface_moves = false;               ///< the twist is not that of the shape
    double resolution = 0.0;  ///< [s] of the differences that the twist is made of; 0: of none

    /// Any motion.
    PrescribedMotion(std::function<Pose<Dim>(double)> pose_,
                     std::function<Twist<Dim>(double)> twist_)
        : pose(std::move(pose_)), twist(std::move(twist_)) {}

    /// Stands still at `at`. Implicit: a pose is the motion of what does not move.
    PrescribedMotion(const Pose<Dim>& at = {})
        : PrescribedMotion([at](double) { return at; }, [](double) { return Twist<Dim>{}; }) {
        require_finite("position of the obstacle", at.position);
    }

    /// Stands still at `at` while its surface moves as part of a rigid body of twist `surface`: an
    /// endless belt, a turntable. Of that velocity counts, at each contact, what goes along the
    /// surface: the shape of a belt comes nearer nowhere, not at its ends either.
    static PrescribedMotion belt(const Pose<Dim>& at, const Twist<Dim>& surface) {
        return PrescribedMotion(at).with_surface([surface](double) { return surface; });
    }
    /// The same places, with a surface of another twist (world axes, of time [s]), which counts as
    /// that of a belt does.
    PrescribedMotion with_surface(std::function<Twist<Dim>(double)> surface) const {
        PrescribedMotion result(pose, std::move(surface));
        result.surface_moves = true;
        return result;
    }

    /// How far the shape goes between two times [s], whatever its surface does [m, rad].
    Twist<Dim> displacement(double begin, double end) const {
        const Pose<Dim> from = pose(begin), to = pose(end);
        return {to.position - from.position, (to.rotation * from.rotation.inverse()).log()};
    }

    /// Moves from `start` (at time 0) with constant velocity and spin.
    static PrescribedMotion uniform(const Pose<Dim>& start, const Twist<Dim>& v) {
        require_finite("position of the obstacle", start.position);
        return {[start, v](double t) {
                    return Pose<Dim>{start.position + t * v.linear,
                                     Rotation<Dim>::exp(t * v.angular) * start.rotation};
                },
                [v](double) { return v; }};
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
                                    double resolution = 1e-5) {
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
        result.resolution = resolution;
        return result;
    }

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
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::of_displacements(
    const Pose<Dim>& start, std::vector<double> time, std::vector<Vector<Dim>> displacement) {
    detail::require_table(time, displacement.size(), "displacements");
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
    return shifted(
        start, [at](double t) { return at(t, false); }, [at](double t) { return at(t, true); });
}

template <int Dim>
requires SpaceDimension<Dim> PrescribedMotion<Dim> PrescribedMotion<Dim>::of_accelerations(
    const Pose<Dim>& start, std::vector<double> time, std::vector<Vector<Dim>> acceleration) {
    detail::require_table(time, acceleration.size(), "accelerations");
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
    return shifted(
        start, [at](double t) { return at(t, false); }, [at](double t) { return at(t, true); });
}

}  // namespace talus
