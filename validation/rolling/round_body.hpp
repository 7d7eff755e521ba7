// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"
#include "harness/observed.hpp"

/// Discs and spheres on the floor and in bowls.
namespace validation {

/// A homogeneous disc (a sphere in space) that stands on the floor above `foot`.
template <int Dim>
talus::BodyIndex add_round(World<Dim>& world, double mass, double radius, const V<Dim>& velocity,
                           const W<Dim>& spin, const V<Dim>& foot = V<Dim>::Zero()) {
    return world.add(talus::Ball<Dim>(radius), round_inertia<Dim>(mass, radius),
                     {foot + radius * up<Dim>(), {}}, {velocity, spin});
}

/// Velocity of the point of a round body that touches the floor [m/s].
template <int Dim>
V<Dim> foot_velocity(const talus::Twist<Dim>& twist, double radius) {
    return twist.at(-radius * up<Dim>());
}

/// What a skid that ends in rolling comes to.
template <int Dim>
struct Skid {
    V<Dim> slip;    ///< of the foot at the start [m/s]
    double t_roll;  ///< rolling begins [s]
    V<Dim> v_roll;  ///< of the centre from then on [m/s]

    Skid(const V<Dim>& velocity, const W<Dim>& spin, double radius, double mu)
        : slip(foot_velocity<Dim>({velocity, spin}, radius)),
          t_roll(slip.norm() / (mu * g) * kap<Dim> / (1 + kap<Dim>)),
          // Friction takes the slip away, with kap/(1+kap) of it from the centre.
          v_roll(velocity - kap<Dim> / (1 + kap<Dim>)*slip),
          velocity_(velocity),
          deceleration_(mu * g / slip.norm() * slip) {}

    V<Dim> velocity(double t) const {
        return t < t_roll ? V<Dim>(velocity_ - t * deceleration_) : v_roll;
    }
    V<Dim> way(double t) const {
        const double s = std::min(t, t_roll);
        return s * velocity_ - s * s / 2 * deceleration_ + (t - s) * v_roll;
    }

  private:
    V<Dim> velocity_, deceleration_;
};

/// The world of a skid and what was seen of it: each step compared with the closed form.
template <int Dim>
struct SkidRun {
    Worst slip_direction;  ///< while it slides
    Worst sliding_way;     ///< against the closed form while it slides
    V<Dim> velocity, way;  ///< at the end
    W<Dim> spin;
    double roll_step_end = 0.0;  ///< end of the first step that sticks [s]
    double end = 0.0;            ///< [s]
    Series along, exact;         ///< velocity along the first axis
};

template <int Dim>
SkidRun<Dim> skid(Trial<Dim>& trial, double mass, double radius, double mu, const V<Dim>& velocity,
                  const W<Dim>& spin, double h, double duration) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_floor();
    add_round<Dim>(world, mass, radius, velocity, spin);
    const Skid<Dim> exact(velocity, spin, radius, mu);
    const V<Dim> start = world.bodies().position[1];
    SkidRun<Dim> run;
    run.along.name = "h = " + std::to_string(h);
    run.exact = {"exact", {}, {}, true};
    const auto note = [&](double t, double v) {
        run.along.x.push_back(t), run.along.y.push_back(v);
        run.exact.x.push_back(t), run.exact.y.push_back(exact.velocity(t)[0]);
    };
    note(0.0, velocity[0]);
    world.run(duration, [&](const auto& w) {
        const auto twist = w.bodies().twist(1);
        const V<Dim> slip = foot_velocity<Dim>(twist, radius);
        if (w.time() < exact.t_roll) {
            run.slip_direction.see(V<Dim>(slip.normalized()), V<Dim>(exact.slip.normalized()));
            run.sliding_way.see(V<Dim>(w.bodies().position[1] - start), exact.way(w.time()));
        }
        if (run.roll_step_end == 0.0 && slip_speed(w.data()) < 1e-12 * (1 + exact.slip.norm()))
            run.roll_step_end = w.time();
        note(w.time(), twist.linear[0]);
    });
    run.velocity = world.bodies().velocity[1];
    run.spin = world.bodies().twist(1).angular;
    run.way = world.bodies().position[1] - start;
    run.end = world.time();
    return run;
}

}  // namespace validation
