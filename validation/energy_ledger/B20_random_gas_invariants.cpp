// SPDX-License-Identifier: BSL-1.0
#include "walled_box.hpp"

namespace validation {
namespace B20 {

constexpr double h = 5e-4, speed = 1.0, tolerance = 1e-13;

template <int Dim>
WalledBox<Dim> gas(double spin) {
    return {Dim == 2 ? 10 : 5, Dim == 2 ? 10 : 4, speed, spin};
}

template <int Dim>
World<Dim> empty_space(Trial<Dim>& trial, double mu, double e) {
    return trial.world({.h = h,
                        .contact = law<Dim>(mu, e, e),
                        .gravity = V<Dim>::Zero(),
                        .solver = {.max_sweeps = 100000, .tolerance = tolerance}});
}

/// Momentum, and moment of momentum about the origin.
template <int Dim>
std::pair<V<Dim>, W<Dim>> momentum(const World<Dim>& world) {
    V<Dim> linear = V<Dim>::Zero();
    W<Dim> angular = W<Dim>::Zero();
    const auto& b = world.bodies();
    for (std::size_t i = 0; i < b.count(); ++i) {
        if (b.is_obstacle(i)) continue;
        const V<Dim> p = b.mass(i) * b.velocity[i];
        linear += p;
        // Balls: the same moment of inertia about every axis.
        angular += b.inertia(i)[0] * b.twist(i).angular;
        if constexpr (Dim == 2)
            angular[0] += b.position[i][0] * p[1] - b.position[i][1] * p[0];
        else
            angular += b.position[i].cross(p);
    }
    return {linear, angular};
}

/// Within walls: energy exact at e = 1, falling for a common e with friction; momentum changes by
/// what the walls give.
template <int Dim>
void walled(Trial<Dim>& trial, double mu, double e, const std::string& name) {
    auto world = empty_space<Dim>(trial, mu, e);
    const auto box = gas<Dim>(mu > 0.0 ? 5.0 : 0.0);
    world.add_floor();
    box.add_sides(world);
    box.add_lid(world);
    box.add_balls(world, trial.rng(2));
    const double start = energy<Dim>(world), duration = trial.full() ? 5.0 : 0.5;
    const V<Dim> p_start = momentum<Dim>(world).first;
    V<Dim> given = V<Dim>::Zero();
    double before = start, gain = 0.0;
    long hits = 0;
    Worst drift, balance;
    Series energies{"computed", {0}, {start}};
    world.run(duration, [&](const auto& w) {
        const auto& data = w.data();
        for (std::size_t i = 0; i < w.bodies().count(); ++i)
            if (w.bodies().is_obstacle(i))
                given -= impulse_on<Dim>(data, static_cast<talus::BodyIndex>(i));
        hits += static_cast<long>(data.contact_count());
        const double now = energy<Dim>(w);
        gain = std::max(gain, now - before);
        before = now;
        drift.see(now, start);
        balance.see(momentum<Dim>(w).first, V<Dim>(p_start + given));
        energies.x.push_back(w.time());
        energies.y.push_back(now);
    });
    trial.holds("balls met, " + name, hits > 100, std::to_string(hits) + " contacts");
    trial.rounding("momentum, walls included [N s], " + name, balance,
                   box.count() * speed * duration);
    if (e == 1.0) {
        trial.solver("energy [J], " + name, drift, start, tolerance);
    } else {
        trial.solver("largest gain of a step [J], " + name, std::max(0.0, gain), 0.0, start,
                     tolerance);
        trial.holds("energy is lost, " + name, before < 0.99 * start);
    }
    if (e == 1.0)
        trial.curves({"energy, " + name,
                      "t [s]",
                      "E [J]",
                      {energies, {"exact", {0, duration}, {start, start}, true}}});
}

/// Alone in space, drawn together: momentum and moment of momentum.
template <int Dim>
void isolated(Trial<Dim>& trial, double mu, double e, const std::string& name) {
    auto world = empty_space<Dim>(trial, mu, e);
    const auto box = gas<Dim>(mu > 0.0 ? 5.0 : 0.0);
    box.add_balls(world, trial.rng(3));
    auto& b = world.bodies();
    const V<Dim> middle = 0.5 * box.size(), off = 0.3 * V<Dim>::Unit(0);
    for (std::size_t i = 0; i < b.count(); ++i) b.velocity[i] += 2 * (middle - b.position[i]) + off;
    const auto [p_start, l_start] = momentum<Dim>(world);
    Worst linear, angular;
    Series turning{"computed", {0}, {l_start[0]}};
    long hits = 0;
    const double duration = trial.full() ? 5.0 : 0.5;
    world.run(duration, [&](const auto& w) {
        const auto [p, l] = momentum<Dim>(w);
        linear.see(p, p_start);
        angular.see(l, l_start);
        hits += static_cast<long>(w.data().contact_count());
        turning.x.push_back(w.time());
        turning.y.push_back(l[0]);
    });
    // A thousand steps and a hundred balls of some N s, some m from the origin.
    const double scale = box.count() * (1 + duration);
    trial.holds("balls met, " + name, hits > 100, std::to_string(hits) + " contacts");
    trial.rounding("momentum [N s], " + name, linear, scale);
    trial.rounding("moment of momentum [N m s], " + name, angular, 3 * scale);
    if (mu > 0.0)
        trial.curves({"moment of momentum about the first axis of spin, " + name,
                      "t [s]",
                      "L [N m s]",
                      {turning, {"exact", {0, duration}, {l_start[0], l_start[0]}, true}}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    walled<Dim>(trial, 0.0, 1.0, "elastic, walled");
    walled<Dim>(trial, 0.3, 0.9, "e = 0.9 with friction, walled");
    isolated<Dim>(trial, 0.0, 1.0, "elastic, alone in space");
    isolated<Dim>(trial, 0.3, 0.9, "e = 0.9 with friction, alone in space");
}

const Register b20(
    {.id = "B20",
     .name = "random-gas-invariants",
     .title = "A gas of balls keeps what it must",
     .gate = 2,
     .setup = "100 discs (spheres) of different sizes at 1 m/s in random directions, elastic and "
              "smooth; then with restitution 0.9 in all directions, friction 0.3 and spins. Once "
              "in a box; once alone in space, drawn together by their velocities. h = 0.5 ms, "
              "0.5 s (5 s with --full).",
     .reference = {"Σ p = Σ p_0 + impulses of the walls", "Σ (x × p + I w) constant without walls",
                   "E constant at e = 1; never growing for a common e"},
     .compared = "Energy, momentum and moment of momentum about the origin after every step.",
     .kind = Class::R,
     .why = "Momenta: both bodies of a contact receive opposite impulses at one point, at the "
            "midpoint, so that only rounding is left. Energy: as exact as the solver, also where "
            "several balls meet at once, since e is common to all contacts.",
     .source = "Conservation laws; energy by the identity of the midpoint rule.",
     .catches = {Fault::reaction_lost, Fault::short_arm, Fault::restitution_weight,
                 Fault::end_point_drift, Fault::stale_candidates}},
    run<2>, run<3>, __FILE__);

}  // namespace B20
}  // namespace validation
