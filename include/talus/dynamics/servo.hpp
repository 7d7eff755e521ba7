// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/forces.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace talus {

/// What drives a body along one direction.
template <int Dim>
requires SpaceDimension<Dim>
struct ServoParams {
    /// Of the force, in world axes; normalised.
    Vector<Dim> direction = Vector<Dim>::Unit(0);
    /// Along the direction, of time [s] and the bodies at the midpoint [N]: a weight that is put
    /// on, a pressure times the area that it acts on now.
    std::function<double(double t, const Bodies<Dim>& bodies)> force;
    /// Slows the motion along the direction: 1/time in which a body without force loses 1 - 1/e of
    /// its speed [1/s]. What must settle wants about its own frequency. The product with the step
    /// size must be below 1.
    double damping = 0.0;
    /// The force, damping left out, is held within [-limit, limit] [N].
    double limit = std::numeric_limits<double>::infinity();
    /// No force pushes the body on while it is faster than this [m/s]: it approaches what is still
    /// out of reach at this speed.
    double top_speed = std::numeric_limits<double>::infinity();
};

/// A force that drives one free body, such as a wall with locked axes (Bodies::lock), towards a
/// target: `system.forces.push_back(servo<Dim>(id, {...}))`. The body has a mass, and what pushes
/// back comes out of the contacts of the same step, so that any load is stable on anything. A force
/// that depends on the body's own place is a spring k, explicit as all applied forces: it is stable
/// for h < 2 sqrt(m / k). The force is constant over a step, which may add h F / m to the speed
/// beyond `top_speed`. It does nothing when the body is gone. Throws input_error if a number is out
/// of range or there is no force; a step checks the force itself, and throws if the body is an
/// obstacle or never was.
template <int Dim>
ForceField<Dim> servo(BodyId body, ServoParams<Dim> params) {
    require_finite("direction of the servo", params.direction);
    const double length =
        require_positive("length of the servo's direction", params.direction.norm());
    params.direction /= length;
    require_non_negative("damping of the servo", params.damping);
    require_in("limit of the servo", params.limit, 0.0, std::numeric_limits<double>::infinity());
    if (!(params.top_speed > 0.0))
        detail::reject("top speed of the servo", params.top_speed, "positive");
    if (!params.force) throw input_error("force of the servo is empty, but must be callable");
    return [body, p = std::move(params)](double t, const Bodies<Dim>& bodies,
                                         std::span<Wrench<Dim>> wrenches) {
        const auto found = bodies.find(body);
        if (!found && (body.serial < 0 || body.serial >= bodies.next_serial()))
            detail::reject("body id of the servo", static_cast<double>(body.serial),
                           "that of a body");
        if (!found) return;
        if (bodies.is_obstacle(*found))
            throw input_error(detail::numbered("body", static_cast<std::size_t>(*found),
                                               " of the servo is an obstacle, but must be free"));
        const auto i = static_cast<std::size_t>(*found);
        const double speed = p.direction.dot(bodies.velocity[i]);
        double force = p.force(t, bodies);
        if (!std::isnan(force)) force = std::clamp(force, -p.limit, p.limit);
        const bool fast = std::abs(speed) > p.top_speed && force * speed > 0.0;
        if (fast) force = 0.0;
        wrenches[i].force += (force - p.damping * bodies.mass(i) * speed) * p.direction;
    };
}

}  // namespace talus
