// SPDX-License-Identifier: BSL-1.0
#include "bouncing/bouncing.hpp"

namespace validation {
namespace B10 {

constexpr Impact in{.mass = 1.3, .radius = 0.2, .along = 3.0, .upward = -2.0, .spin = -20.0};
constexpr double mu = 5.0;

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr bool disc = Dim == 2;
    const Rebound exact = rebound_of<Dim>(in, mu, 1.0, 1.0);
    trial.within("reference, v_x", exact.along, disc ? 11.0 / 3.0 : 3.571428571, 5e-10,
                 "digits of the catalogue");
    trial.within("reference, ω", exact.spin, disc ? -40.0 / 3.0 : -12.857142857, 5e-10,
                 "digits of the catalogue");
    // The size of what is added up in the slip and the energy: 3 + 2 + 4 m/s.
    const double size = 9.0;
    for (int k = 0; k < (disc ? 1 : 10); ++k) {
        const std::string at = disc ? "in the plane" : "azimuth " + std::to_string(36 * k);
        const Rebound seen = measured_rebound<Dim>(trial, in, mu, 1.0, 1.0, 36 * k * degree);
        compare<Dim>(trial, at, in, seen, exact);
        trial.rounding("slip reversed, " + at, seen.along + in.radius * seen.spin,
                       -(in.along + in.radius * in.spin), size);
        trial.rounding("energy kept, " + at, seen.gained, 0.0, in.mass * size * size);
    }
    // Over the spin before the impact.
    Series seen{"measured", {}, {}}, truth{"exact", {}, {}, true};
    for (int k = 0; k <= 60; ++k) {
        Impact spun = in;
        spun.spin = -60.0 + 2.0 * k;
        seen.x.push_back(spun.spin), truth.x.push_back(spun.spin);
        seen.y.push_back(measured_rebound<Dim>(trial, spun, mu, 1.0, 1.0).along);
        truth.y.push_back(rebound_of<Dim>(spun, mu, 1.0, 1.0).along);
    }
    trial.curves({"velocity along the floor after the impact",
                  "ω before [rad/s]",
                  "v_x [m/s]",
                  {seen, truth}});
}

const Register b10(
    {.id = "B10",
     .name = "superball",
     .title = "A superball takes back its slip",
     .gate = 2,
     .setup =
         "A homogeneous disc (a sphere in space) of 0.2 m radius hits the floor at 3 m/s along "
         "it and 2 m/s towards it with a spin of −20 rad/s; both restitutions are 1 and "
         "friction, 5, is enough to stick; in space at ten azimuths.",
     .reference = {"U_T = v_x + r ω becomes − U_T", "v_x − frac{2 κ}{1 + κ} U_T",
                   "ω − frac{2}{1 + κ} frac{U_T}{r}", "energy is kept"},
     .compared = "Velocities, spin, slip and energy after the impact.",
     .kind = Class::R,
     .why = "One step, one contact, no forces: nothing but rounding.",
     .source = "Garwin 1969.",
     .catches = {Fault::friction_on_end_velocity, Fault::restitution_weight, Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace B10
}  // namespace validation
