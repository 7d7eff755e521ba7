// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "measured.hpp"

namespace validation {

/// Balls of radius 0.08 to 0.12 in a box of half-spaces, on a loose jittered lattice: `wide` per
/// horizontal axis, `high` layers. Bodies 0 .. 2 (Dim - 1) are floor and walls.
template <int Dim>
struct BoxOfBalls {
    int wide, high;
    static constexpr double pitch = 0.27, mass = 1.0;

    int count() const { return high * (Dim == 2 ? wide : wide * wide); }
    double width() const { return pitch * wide; }
    static constexpr std::size_t walls = 2 * (Dim - 1) + 1;
    static bool is_ball(std::size_t i) { return i >= walls; }

    World<Dim> make(Trial<Dim>& trial, const WorldParams<Dim>& params,
                    std::uint64_t realisation = 0) const {
        auto world = trial.world(params);
        world.add_floor();
        for (int axis = 0; axis < Dim - 1; ++axis) {
            world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(axis));
            world.add_plane(width() * V<Dim>::Unit(axis), -V<Dim>::Unit(axis));
        }
        auto rng = trial.rng(realisation);
        std::uniform_real_distribution<double> radius(0.08, 0.12), jitter(-0.01, 0.01);
        const int per_layer = Dim == 2 ? wide : wide * wide;
        for (int k = 0; k < count(); ++k) {
            V<Dim> x;
            x[0] = (k % wide + 0.5) * pitch;
            x[1] = ((k / wide) % wide + 0.5) * pitch;
            x[Dim - 1] = (k / per_layer + 0.5) * pitch;
            for (double& c : x) c += jitter(rng);
            const double r = radius(rng);
            world.add(talus::Ball<Dim>{r}, round_inertia<Dim>(mass, r), {x, {}});
        }
        return world;
    }
};

/// Drag of still air, thick enough to bring a heap to rest in a second or two: it slows down every
/// body and its spin at `rate` [1/s] and is nothing at rest.
template <int Dim>
talus::ForceField<Dim> drag(double rate) {
    return [rate](double, const talus::Bodies<Dim>& bodies,
                  std::span<talus::Wrench<Dim>> wrenches) {
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i)) continue;
            wrenches[i].force -= rate * bodies.mass(i) * bodies.velocity[i];
            // Point masses do not turn; balls have the same moment about every axis.
            if (bodies.inverse_inertia[i][0] > 0.0)
                wrenches[i].torque -= rate / bodies.inverse_inertia[i][0] * bodies.twist(i).angular;
        }
    };
}

/// How bodies fall and settle: 1e-6 is tight enough to come to rest, and is not always reached on
/// the way.
template <int Dim>
WorldParams<Dim> settling_params(double mu) {
    return {.h = 2e-3,
            .contact = law<Dim>(mu),
            .solver = {.max_sweeps = 2000, .tolerance = 1e-6},
            .prepares = true};
}
/// The same for the step that is looked at, solved to `tolerance`.
template <int Dim>
WorldParams<Dim> resting_params(double mu, double tolerance) {
    auto params = settling_params<Dim>(mu);
    params.solver = {.max_sweeps = 200000, .tolerance = tolerance};
    params.prepares = false;
    return params;
}
inline constexpr double drag_rate = 5.0;      // [1/s]
inline constexpr double settling_time = 8.0;  // [s]

/// Puts the bodies of one world where those of another, made alike, have come to.
template <int Dim>
void copy_places(const World<Dim>& from, World<Dim>& to) {
    to.bodies().position = from.bodies().position;
    to.bodies().rotation = from.bodies().rotation;
}

}  // namespace validation
