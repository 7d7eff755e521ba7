// SPDX-License-Identifier: BSL-1.0
#include "rolling/round_body.hpp"

namespace validation {
namespace A04 {

constexpr double speed = 2.0, mu = 0.3, mass = 1.7, radius = 0.3;

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr double k = kap<Dim>;
    const V<Dim> launch = in_plane<Dim>(speed, 0.0);
    const Skid<Dim> exact(launch, W<Dim>::Zero(), radius, mu);
    const double scale = speed * speed / (mu * g);
    trial.within("reference, rolling begins", exact.t_roll,
                 speed / (mu * g) * (Dim == 2 ? 1. / 3 : 2. / 7), 1e-15, "1/3 or 2/7");
    trial.within("reference, distance slid", exact.way(exact.t_roll)[0],
                 scale * (Dim == 2 ? 5. / 18 : 12. / 49), 1e-15, "5/18 or 12/49");
    trial.within("reference, final speed", exact.v_roll[0], speed * (Dim == 2 ? 2. / 3 : 5. / 7),
                 1e-15, "2/3 or 5/7");
    for (const double h : {7e-3, 3e-3, 1e-3, 4e-4}) {
        const auto seen = skid<Dim>(trial, mass, radius, mu, launch, W<Dim>::Zero(), h, 0.5);
        // Momentum about the line of contact is kept at each of 0.5/h steps.
        trial.rounding("final velocity", seen.velocity, exact.v_roll, 10 * speed, h);
        trial.rounding("final spin", seen.spin, rolling_spin<Dim>(speed / (1 + k) / radius),
                       10 * speed / radius, h);
        trial.within("end of the first step that sticks", seen.roll_step_end, exact.t_roll + h / 2,
                     h / 2 * (1 + 1e-9), "the step that contains t_r", h);
        trial.within("way", seen.way[0], exact.way(seen.end)[0], mu * g * h * h / 8 * (1 + 1e-9),
                     "mu g h^2 / 8, the event lies within one step", h, Class::D2);
        if (h == 7e-3)
            trial.curves({"velocity of the centre", "t [s]", "v [m/s]", {seen.along, seen.exact}});
    }
}

const Register a04(
    {.id = "A04",
     .name = "slide-to-roll",
     .title = "A sliding ball begins to roll",
     .gate = 1,
     .setup = "A homogeneous disc (a sphere in space) of 0.3 m radius is set on a floor with "
              "friction 0.3 at 2 m/s, without spin.",
     .reference = {"t_r = frac{v_0}{μ g} frac{κ}{1 + κ}", "v = frac{v_0}{1 + κ} afterwards",
                   "slid frac{v_0^2}{μ g} times 5/18 (disc) or 12/49 (sphere)"},
     .compared = "Final velocity and spin, the step in which rolling begins, and the way.",
     .kind = Class::R,
     .why = "Momentum about the line of contact is kept by the step exactly, whatever its size; "
            "the way is exact but for the step in which rolling begins.",
     .source = "Coriolis 1835; Routh.",
     .catches = {Fault::short_arm, Fault::friction_off, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace A04
}  // namespace validation
