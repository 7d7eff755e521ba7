// SPDX-License-Identifier: BSL-1.0
#include "moving_obstacles/belts.hpp"

namespace validation {
namespace A12 {

constexpr double rate = 2.0, mu = 0.3;
constexpr double critical = mu * g / (rate * rate);

/// A puck that turns with the table. It starts as if it had passed the radius given at the midpoint
/// of the step before, so that the first step is like all others.
World<3> puck(Trial<3>& trial, double r, double h) {
    auto world = trial.world({.h = h, .contact = law<3>(mu)});
    add_turntable(world, rate);
    const V<3> before(r, 0, 0), v = rate * quarter_turn(before);
    add_block<3>(world, 1.0, before + h / 2 * v, v);
    return world;
}

double radius_of(const World<3>& world) { return world.bodies().position[1].head<2>().norm(); }

void run(Trial<3>& trial) {
    trial.within("reference, critical radius", critical, 0.73575, 1e-12, "exact decimal");
    for (const double h : {1e-3, 2.7e-4}) {
        const double factor = 1 + h * h * rate * rate;
        // Inside: carried along.
        auto inside = puck(trial, 0.98 * critical, h);
        V<3> v = inside.bodies().velocity[1];
        const double r_start = radius_of(inside);
        double slip = 0.0;
        Worst power;
        Series in{"0.98 of the critical radius", {}, {}};
        inside.run(0.5, [&](const auto& now) {
            v += h * rate * quarter_turn(v);
            power.see(now.bodies().velocity[1], v);
            slip = std::max(slip, slip_speed(now.data()));
            in.x.push_back(now.time()), in.y.push_back(radius_of(now) / r_start);
        });
        const double steps = std::round(0.5 / h);
        trial.rounding("slip at 0.98", slip, 0.0, 10.0, h);
        // Velocities of order 1, 0.5/h steps.
        trial.rounding("velocity against the matrix power", power, 1.0 / std::sqrt(h), h);
        trial.rounding("creep of the radius", radius_of(inside) / r_start,
                       std::pow(factor, steps / 2), 1.0 / std::sqrt(h), h);
        if (h == 1e-3)
            trial.within("creep after 500 steps, as given", radius_of(inside) / r_start, 1.001,
                         1e-6, "digits given", h);
        // Outside: left behind from the first step on.
        auto outside = puck(trial, 1.02 * critical, h);
        Series out{"1.02 of the critical radius", {}, {}};
        const double out_start = radius_of(outside);
        double least = 1e9, first = -1.0, before = 0.0;
        bool outward = true;
        outside.run(0.5, [&](const auto& now) {
            const double s = slip_speed(now.data());
            if (first < 0) first = s;
            least = std::min(least, s);
            // The puck at the critical radius and beyond leaves the circle that the creep explains.
            const double r = radius_of(now) / out_start;
            outward = outward && r > before;
            before = r;
            out.x.push_back(now.time()), out.y.push_back(r);
        });
        trial.rounding("slip of the first step at 1.02", first,
                       h * (1.02 * critical * rate * rate - mu * g), 1.0, h);
        trial.holds("slips at every step at 1.02", least >= 0.5 * first, {}, h);
        trial.holds("slips outward at 1.02", outward && before > std::pow(factor, steps), {}, h);
        if (h == 1e-3)
            trial.curves({"radius over its start",
                          "t [s]",
                          "r / r_0",
                          {in, out, {"exact inside", {0.0, 0.5}, {1.0, 1.0}, true}}});
    }
    trial.order(
        "creep of the radius in half a second", halvings(8e-3, 6),
        [&](double h) {
            auto world = puck(trial, 0.98 * critical, h);
            const double start = radius_of(world);
            world.run(0.5);
            return radius_of(world) / start - 1;
        },
        first_order);
}

const Register a12(
    {.id = "A12",
     .name = "puck-corotation",
     .title = "A puck rides on a turntable or is left behind",
     .setup = "A puck that does not turn by itself lies on a table that turns at 2 rad/s, with "
              "friction 0.3, and begins with the table's velocity: at 0.98 or 1.02 of the radius "
              "at which friction just holds it.",
     .reference = {"r_c = frac{μ g}{Ω^2} = 0.73575 m", "v_{k+1} = (1 + h Ω J) v_k within",
                   "frac{r_n}{r_0} = (1 + h^2 Ω^2)^{n/2}, a creep of order h",
                   "first slip h (Ω^2 r − μ g) beyond"},
     .compared = "Within: no slip at any step, the velocity against the power of the matrix, the "
                 "creep of the radius and its order. Beyond: the slip of the first step, and that "
                 "it goes on and outward.",
     .kind = Class::R,
     .why = "The table carries the puck with the velocity of the midpoint's place, tangentially: "
            "an explicit step of the circular motion, whose creep outwards is known exactly.",
     .source = "Elementary; the creep is derived here.",
     .catches = {Fault::obstacle_velocity_forgotten, Fault::begin_point, Fault::friction_off}},
    nullptr, run, __FILE__);

}  // namespace A12
}  // namespace validation
