// SPDX-License-Identifier: BSL-1.0
#include "moving_obstacles/belts.hpp"

namespace validation {
namespace A14 {

constexpr double b = 1.0, mu = 0.5, radius = 0.2, mass = 1.3;

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr double k = kap<Dim>, a = b * k / (1 + k);
    trial.within("reference, acceleration by that of the belt", a / b, Dim == 2 ? 1. / 3 : 2. / 7,
                 1e-15, "closed form");
    trial.holds("reference, friction suffices", a <= mu * g);
    for (const double h : {1e-2, 1.7e-3}) {
        auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
        add_belt(world, [](double t) { return in_plane<Dim>(b * t, 0.0); });
        world.add(talus::Ball<Dim>(radius), round_inertia<Dim>(mass, radius),
                  {radius * up<Dim>(), {}});
        Worst v, spin, place, force;
        Series speed{"h = " + std::to_string(h), {}, {}};
        world.run(2.0, [&](const auto& now) {
            const double t = now.time();
            // The belt is met with the velocity of the midpoint: half a step late.
            const double late = t - h / 2;
            v.see(now.bodies().velocity[1], in_plane<Dim>(a * late, 0.0));
            spin.see(now.bodies().twist(1).angular, rolling_spin<Dim>(-a * late / (k * radius)));
            // Trapezoidal sum of these velocities, the first of which is 0 and not -a h/2.
            place.see(now.bodies().position[1],
                      in_plane<Dim>(a * t * t / 2 - a * h / 2 * t + a * h * h / 4, radius));
            if (t > 1.5 * h)
                force.see(impulse_on(now.data(), 1), in_plane<Dim>(mass * a * h, mass * g * h));
            speed.x.push_back(t), speed.y.push_back(now.bodies().velocity[1][0]);
        });
        // Numbers of order 1 (spins of order 10) over 2/h steps.
        trial.rounding("velocity of the centre", v, 10.0, h);
        trial.rounding("spin", spin, 10.0 / radius, h);
        trial.rounding("place of the centre", place, 10.0, h);
        trial.rounding("impulse of the belt", force, 10.0, h);
        if (h == 1e-2)
            trial.curves({"velocity of the centre",
                          "t [s]",
                          "v [m/s]",
                          {speed, {"exact", {0.0, 2.0}, {0.0, 2 * a}, true}}});
    }
}

const Register a14(
    {.id = "A14",
     .name = "accelerated-belt",
     .title = "A round body on a belt that starts to move",
     .setup = "A homogeneous disc (a sphere in space) lies on a belt with friction 0.5 that moves "
              "with velocity b t, b = 1 m/s^2.",
     .reference = {"a = frac{b κ}{1 + κ}, a third of b (2/7 in space)",
                   "v_k = a (t_k − frac{h}{2})", "ω_k = frac{v_k}{κ r} against the rolling sense",
                   "friction m a ≤ μ m g"},
     .compared = "Velocity, spin and place at every step, and the impulse of the belt.",
     .kind = Class::R,
     .why = "All accelerations are constant. The body matches the velocity that the belt has at "
            "the midpoint of the step, hence the constant delay of half a step.",
     .source = "Elementary; the delay is derived here.",
     .catches = {Fault::obstacle_velocity_forgotten, Fault::short_arm, Fault::begin_point}},
    run<2>, run<3>, __FILE__);

}  // namespace A14
}  // namespace validation
