// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <string>

#include "harness/case.hpp"

/// Impacts of single bodies: balls that fall and bounce, and single steps in which something hits.
namespace validation {

inline constexpr double drop_radius = 0.1;

/// Height of the lowest point of the ball above the floor [m].
template <int Dim>
double ball_height(const World<Dim>& world) {
    return world.bodies().position[1][Dim - 1] - drop_radius;
}
template <int Dim>
double ball_speed_up(const World<Dim>& world) {
    return world.bodies().velocity[1][Dim - 1];
}

/// Free fall from rest: the time until the floor is met, and the speed there.
struct Fall {
    double height;  ///< [m]

    double duration() const { return std::sqrt(2 * height / g); }
    double speed() const { return std::sqrt(2 * g * height); }
    double height_at(double t) const { return height - g * t * t / 2; }
};

/// A ball of one kilogram on its way down to the floor, `late` seconds after it was let go at rest
/// at a height.
template <int Dim>
World<Dim> falling_ball(Trial<Dim>& trial, double h, double e, const Fall& fall,
                        double late = 0.0) {
    auto world = trial.world({.h = h, .contact = law<Dim>(0.0, e)});
    world.add_floor();
    world.add(talus::Ball<Dim>(drop_radius), round_inertia<Dim>(1.0, drop_radius),
              {(drop_radius + fall.height_at(late)) * up<Dim>(), {}}, {-g * late * up<Dim>()});
    return world;
}

/// Fractions of a step by which starts are shifted, so that an event falls everywhere in its step.
inline constexpr int start_count = 16;
inline double start_shift(int k) { return (k + 0.37) / start_count; }

/// Impact of a disc (a sphere in space) on the floor in one step without any force. Numbers are
/// those of the vertical plane of the motion; spins are positive from the first towards the last
/// axis.
struct Impact {
    double mass, radius;
    double along, upward, spin;  ///< velocity and spin before [m/s, rad/s]
};
/// The same after, as it is in the plane of the motion, and what must be zero out of it.
struct Rebound {
    double along, upward, spin;
    double astray;  ///< largest component of velocity, and r times spin, out of the plane
    double gained;  ///< kinetic energy [J]
};

/// By Coulomb's law on the mean, in the plane, with e_n and e_t.
template <int Dim>
Rebound rebound_of(const Impact& in, double mu, double e_n, double e_t) {
    const double k = kap<Dim>, inertia = k * in.mass * in.radius * in.radius;
    const double slip = in.along + in.radius * in.spin;
    const double p_n = in.mass * (1 + e_n) * -in.upward;
    const double p_stick = -in.mass * k / (1 + k) * (1 + e_t) * slip;
    const double p_t = std::abs(p_stick) <= mu * p_n ? p_stick : -std::copysign(mu * p_n, slip);
    Rebound out{in.along + p_t / in.mass, in.upward + p_n / in.mass,
                in.spin + p_t * in.radius / inertia, 0.0, 0.0};
    const auto energy = [&](const auto& s) {
        return 0.5 * in.mass * (s.along * s.along + s.upward * s.upward) +
               0.5 * inertia * s.spin * s.spin;
    };
    out.gained = energy(out) - energy(in);
    return out;
}

/// What talus makes of it when the motion is turned by an azimuth about the vertical (in space).
template <int Dim>
Rebound measured_rebound(Trial<Dim>& trial, const Impact& in, double mu, double e_n, double e_t,
                         double azimuth = 0.0) {
    constexpr double h = 1e-3;
    talus::Rotation<Dim> turn;
    if constexpr (Dim == 3) turn = talus::Rotation<3>::exp({0, 0, azimuth});
    const auto turned = [&](const W<Dim>& spin) {
        if constexpr (Dim == 3)
            return W<3>(turn * spin);
        else
            return spin;
    };
    const auto turned_back = [&](const W<Dim>& spin) {
        if constexpr (Dim == 3)
            return W<3>(turn.transpose_times(spin));
        else
            return spin;
    };
    auto world =
        trial.world({.h = h, .contact = law<Dim>(mu, e_n, e_t), .gravity = V<Dim>::Zero()});
    world.add_floor();
    const V<Dim> v = turn * in_plane<Dim>(in.along, in.upward);
    // Touches at the midpoint, where the step takes its geometry.
    world.add(talus::Ball<Dim>(in.radius), round_inertia<Dim>(in.mass, in.radius),
              {in.radius * up<Dim>() - 0.5 * h * v, {}}, {v, turned(rolling_spin<Dim>(-in.spin))});
    const double before = talus::kinetic_energy(world.bodies(), 1);
    world.step();
    const auto twist = world.bodies().twist(1);
    const V<Dim> velocity = turn.transpose_times(twist.linear);
    const W<Dim> spin = turned_back(twist.angular);
    Rebound out{velocity[0], velocity[Dim - 1], spin.dot(rolling_spin<Dim>(-1.0)), 0.0,
                talus::kinetic_energy(world.bodies(), 1) - before};
    out.astray = std::max(largest((velocity - in_plane<Dim>(out.along, out.upward)).eval()),
                          in.radius * largest((spin - rolling_spin<Dim>(-out.spin)).eval()));
    return out;
}

/// Compares the two; rounding of velocities and r times spins of the size of those before.
template <int Dim>
void compare(Trial<Dim>& trial, const std::string& name, const Impact& in, const Rebound& measured,
             const Rebound& exact) {
    const double size = std::abs(in.along) + std::abs(in.upward) + in.radius * std::abs(in.spin);
    trial.rounding("velocity along the floor, " + name, measured.along, exact.along, size);
    trial.rounding("velocity upwards, " + name, measured.upward, exact.upward, size);
    trial.rounding("spin, " + name, measured.spin, exact.spin, size / in.radius);
    trial.rounding("out of the plane of the motion, " + name, measured.astray, 0.0, size);
    trial.rounding("energy gained, " + name, measured.gained, exact.gained, in.mass * size * size);
}

}  // namespace validation
