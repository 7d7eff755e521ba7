// SPDX-License-Identifier: BSL-1.0
#include "moving_obstacles/belts.hpp"

namespace validation {
namespace A05 {

constexpr double rate = 2.0, radius = 0.3, mu = 2.0;
constexpr double lam = kap<3> / (1 + kap<3>);  // 2/7
const V<3> x_start(1, 0, 0), v_start(0, 0.5, 0);

/// A ball that rolls on the turntable without sliding, from the first step on: its spin fits the
/// table half a step behind, where the midpoint before the first one would be.
World<3> rolling(Trial<3>& trial, double h) {
    auto world = trial.world({.h = h, .contact = law<3>(mu)});
    add_turntable(world, rate);
    const V<3> before = x_start - h / 2 * v_start;
    const V<3> spin = (rate * before + quarter_turn(v_start)) / radius;
    world.add(talus::Ball<3>(radius), round_inertia<3>(1.0, radius),
              {x_start + radius * up<3>(), {}}, {v_start, spin});
    return world;
}

/// The centre's velocity turns at the rate lam Om.
V<3> exact_velocity(double t) {
    const double angle = lam * rate * t;
    return std::cos(angle) * v_start + std::sin(angle) * quarter_turn(v_start);
}
V<3> exact_place(double t) {
    // Integral of the velocity.
    const double angle = lam * rate * t;
    return x_start + (std::sin(angle) * v_start + (1 - std::cos(angle)) * quarter_turn(v_start)) /
                         (lam * rate);
}

void run(Trial<3>& trial) {
    const double period = 2 * pi / (lam * rate);
    trial.within("reference, period", period, 2 * pi * 7 / (2 * rate), 1e-12,
                 "the same in other letters");
    for (const double h : {1.1e-2, 2.3e-3}) {
        auto world = rolling(trial, h);
        V<3> v = v_start;
        Worst power, growth;
        double slips = 0.0;
        int n = 0;
        Series path{"measured", {x_start[0]}, {x_start[1]}};
        world.run(period, [&](const auto& now) {
            v += h * lam * rate * quarter_turn(v);
            ++n;
            const double factor = std::pow(1 + h * h * lam * lam * rate * rate, n / 2.0);
            power.see(now.bodies().velocity[1], v);
            growth.see(now.bodies().velocity[1].norm(), factor * v_start.norm());
            slips = std::max(slips, slip_speed(now.data()));
            path.x.push_back(now.bodies().position[1][0]);
            path.y.push_back(now.bodies().position[1][1]);
        });
        // Velocities of order 1; the ways that enter the table's velocity add rounding up to n.
        trial.rounding("velocity against the matrix power", power, 1.0 / std::sqrt(h), h);
        trial.rounding("growth of the speed", growth, 1.0 / std::sqrt(h), h);
        trial.rounding("slip", slips, 0.0, 10.0, h);
        if (h > 1e-2) {
            Series circle{"exact", {}, {}, true};
            for (int k = 0; k <= 200; ++k) {
                const V<3> x = exact_place(period * k / 200);
                circle.x.push_back(x[0]), circle.y.push_back(x[1]);
            }
            trial.curves({"path of the centre", "x [m]", "y [m]", {path, circle}});
        }
    }
    trial.order(
        "velocity after 0.7 of a turn", halvings(2e-2, 6),
        [&](double h) {
            auto world = rolling(trial, h);
            world.run(0.7 * period);
            return (world.bodies().velocity[1] - exact_velocity(world.time())).norm();
        },
        first_order);
    trial.order(
        "place after 0.7 of a turn", halvings(2e-2, 6),
        [&](double h) {
            auto world = rolling(trial, h);
            world.run(0.7 * period);
            const V<3> x = world.bodies().position[1] - radius * up<3>();
            return (x - exact_place(world.time())).norm();
        },
        first_order);
}

const Register a05(
    {.id = "A05",
     .name = "turntable-orbit",
     .title = "A ball rolls in a circle on a turntable",
     .setup = "A homogeneous sphere rolls without sliding on a table that turns at 2 rad/s. It "
              "starts 1 m from the axis at 0.5 m/s, with a spin that fits the table half a step "
              "before the start.",
     .reference = {"frac{dv}{dt} = λ Ω J v, λ = frac{κ}{1 + κ} = frac{2}{7}",
                   "circle of radius frac{v_0}{λ Ω}, period frac{2 π}{λ Ω} = frac{7 π}{Ω}",
                   "v_{k+1} = (1 + h λ Ω J) v_k", "|v_n| = |v_0| (1 + h^2 λ^2 Ω^2)^{n/2}"},
     .compared = "The velocity of every step against the power of the matrix, its growth, and the "
                 "order of velocity and place against the circle.",
     .kind = Class::R,
     .why = "Rolling couples the velocities of two steps linearly, and the table is felt where "
            "the ball is at the midpoint; the matrix follows without approximation. Against the "
            "circle it is of first order.",
     .source = "Milne 1948; Weltner 1979.",
     .catches = {Fault::obstacle_velocity_forgotten, Fault::short_arm, Fault::begin_point}},
    nullptr, run, __FILE__);

}  // namespace A05
}  // namespace validation
