// SPDX-License-Identifier: BSL-1.0
#include "rolling/round_body.hpp"

namespace validation {
namespace A13 {

constexpr double mu = 0.2, radius = 0.1, mass = 1.3;

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr double k = kap<Dim>;
    trial.within("reference, limit tan b / mu", 1 + 1 / k, Dim == 2 ? 3.0 : 3.5, 1e-15,
                 "disc 3, sphere 3.5");
    for (const double factor : {0.999, 1.001}) {
        const double slope = std::atan(factor * mu * (1 + 1 / k));
        const bool rolls = factor < 1;
        const double a =
            rolls ? g * std::sin(slope) / (1 + k) : g * (std::sin(slope) - mu * std::cos(slope));
        const double turning = rolls ? a / radius : mu * g * std::cos(slope) / (k * radius);
        const double slip = a - turning * radius;
        const std::string name = rolls ? ", below the limit" : ", above the limit";
        for (const double h : {1e-2, 1.3e-3}) {
            auto world =
                trial.world({.h = h,
                             .contact = law<Dim>(mu),
                             .gravity = in_plane<Dim>(g * std::sin(slope), -g * std::cos(slope))});
            world.add_floor();
            add_round<Dim>(world, mass, radius, V<Dim>::Zero(), W<Dim>::Zero());
            Worst v, spin, way, sliding;
            Series path{"h = " + std::to_string(h), {}, {}};
            world.run(1.0, [&](const auto& w) {
                const double t = w.time();
                const auto twist = w.bodies().twist(1);
                v.see(twist.linear, in_plane<Dim>(a * t, 0.0));
                spin.see(twist.angular, rolling_spin<Dim>(turning * t));
                way.see(w.bodies().position[1], in_plane<Dim>(a * t * t / 2, radius));
                sliding.see(slip_speed(w.data()), slip * t);
                path.x.push_back(t), path.y.push_back(twist.linear[0]);
            });
            // Velocities to 5 m/s, spins to 50 rad/s, from 1/h increments.
            trial.rounding("velocity" + name, v, 10.0, h);
            trial.rounding("spin" + name, spin, 10.0 / radius, h);
            trial.rounding("way" + name, way, 10.0, h);
            trial.rounding("slip" + name, sliding, 10.0, h);
            if (h == 1e-2)
                trial.curves({"velocity" + name,
                              "t [s]",
                              "v [m/s]",
                              {path, {"exact", {0.0, 1.0}, {0.0, a}, true}}});
        }
    }
}

const Register a13(
    {.id = "A13",
     .name = "rolling-down-incline",
     .title = "A round body rolls or slides down an incline",
     .gate = 1,
     .setup = "A homogeneous disc (a sphere in space) of 0.1 m radius starts from rest on an "
              "incline with friction 0.2, a thousandth less or more steep (in the tangent) than "
              "the one on which it just rolls.",
     .reference = {"rolls for tan β ≤ μ (1 + frac{1}{κ})", "a = frac{g sin β}{1 + κ}",
                   "else a = g (sin β − μ cos β)", "frac{dω}{dt} = frac{μ g cos β}{κ r}"},
     .compared = "Velocity, spin, way and slip at every step.",
     .kind = Class::R,
     .why = "All forces are constant: the step is exact at every size.",
     .source = "Routh.",
     .catches = {Fault::short_arm, Fault::friction_off, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace A13
}  // namespace validation
