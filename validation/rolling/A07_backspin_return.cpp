// SPDX-License-Identifier: BSL-1.0
#include "rolling/round_body.hpp"

namespace validation {
namespace A07 {

constexpr double speed = 2.0, mu = 0.3, mass = 1.0, radius = 0.1;

/// Launch with some spin; `name` tells which.
template <int Dim>
void launch(Trial<Dim>& trial, const W<Dim>& spin, const std::string& name) {
    const V<Dim> velocity = in_plane<Dim>(speed, 0.0);
    const Skid<Dim> exact(velocity, spin, radius, mu);
    const double duration = exact.t_roll + 0.5;
    const double slip = exact.slip.norm();
    for (const double h : {3.7e-3, 1e-3}) {
        const auto seen = skid<Dim>(trial, mass, radius, mu, velocity, spin, h, duration);
        // Slips of some m/s lose mu g h in each of some thousand steps.
        trial.rounding("final velocity, " + name, seen.velocity, exact.v_roll, 10 * slip, h);
        trial.rounding("direction of the slip, " + name, seen.slip_direction, 1.0, h);
        trial.rounding("way while it slides, " + name, seen.sliding_way, 10 * slip, h);
        trial.within("end of the first step that sticks, " + name, seen.roll_step_end,
                     exact.t_roll + h / 2, h / 2 * (1 + 1e-9), "the step that contains t_r", h);
        trial.within("way, " + name, (seen.way - exact.way(seen.end)).norm(), 0.0,
                     mu * g * h * h / 8 * (1 + 1e-9), "mu g h^2 / 8", h, Class::D2);
        if (h == 3.7e-3)
            trial.curves({"velocity along the launch, " + name,
                          "t [s]",
                          "v [m/s]",
                          {seen.along, seen.exact}});
    }
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const auto final_speed = [](double w) {
        return Skid<Dim>(in_plane<Dim>(speed, 0.0), rolling_spin<Dim>(-w), radius, mu).v_roll[0];
    };
    trial.within("reference, final speed at 60 rad/s", final_speed(60),
                 Dim == 2 ? -2. / 3 : -2. / 7, 1e-14, "closed form");
    trial.within("reference, final speed at 10 rad/s", final_speed(10), Dim == 2 ? 1. : 8. / 7,
                 1e-14, "closed form");
    trial.within("reference, final speed at the spin that just returns",
                 final_speed(speed / (kap<Dim> * radius)), 0.0, 1e-14, "v_0 / (kap r)");
    launch<Dim>(trial, rolling_spin<Dim>(-10), "backspin 10");
    launch<Dim>(trial, rolling_spin<Dim>(-60), "backspin 60");
    if constexpr (Dim == 3)
        launch<3>(trial, 60 * V<3>(std::cos(30 * degree), -std::sin(30 * degree), 0.0),
                  "axis at 30 degrees");
}

const Register a07(
    {.id = "A07",
     .name = "backspin-return",
     .title = "Backspin brings a ball back",
     .gate = 1,
     .setup = "A homogeneous disc (a sphere in space) of 0.1 m radius is launched at 2 m/s over a "
              "floor with friction 0.3, with backspin of 10 or 60 rad/s; in space also with 60 "
              "rad/s about an axis at 30 degrees to the launch.",
     .reference = {"v = frac{v_0 − κ r ω_b}{1 + κ}, backwards for ω_b > frac{v_0}{κ r}",
                   "in space v = v_0 − frac{κ}{1 + κ} U_0 with the slip U_0 = v_0 − ω × r n",
                   "the slip keeps its direction: a parabola until it rolls"},
     .compared = "Final velocity, direction of the slip and way while it slides, the step in "
                 "which rolling begins, the whole way.",
     .kind = Class::R,
     .why = "The slip keeps its direction, so friction is constant and the step exact until the "
            "one in which rolling begins.",
     .source = "Coriolis 1835.",
     .catches = {Fault::short_arm, Fault::friction_off, Fault::faceted_cone, Fault::axis_bias}},
    run<2>, run<3>, __FILE__);

}  // namespace A07
}  // namespace validation
