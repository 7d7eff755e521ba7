// SPDX-License-Identifier: BSL-1.0
// A case of one's own: everything that the page "Adding a case" talks about, in one file.
#include "harness/case.hpp"

namespace validation {
namespace U01 {

template <int Dim>
void run(Trial<Dim>& trial) {
    const double slope = 20 * degree, mu = 0.5, speed = 2.0;
    const double slowing = g * (std::sin(slope) + mu * std::cos(slope));
    const double t_stop = speed / slowing, way = speed * speed / (2 * slowing);
    for (const double h : {1e-2, 3e-3, 7e-4}) {
        // The floor stays level; gravity is turned instead.
        auto world =
            trial.world({.h = h,
                         .contact = law<Dim>(mu),
                         .gravity = g * in_plane<Dim>(-std::sin(slope), -std::cos(slope))});
        world.add_floor();
        const auto block =
            static_cast<std::size_t>(world.add(talus::Ball<Dim>(0.1), point_mass<Dim>(1.0),
                                               {0.1 * up<Dim>(), {}}, {in_plane<Dim>(speed, 0)}));
        Series seen{"h = " + std::to_string(h), {}, {}};
        world.run(t_stop + 0.2, [&](const auto& w) {
            seen.x.push_back(w.time());
            seen.y.push_back(w.bodies().velocity[block][0]);
        });
        // Exact but for the step of the stop, which ends r after it began to slide alone.
        const double r = t_stop - h * std::floor(t_stop / h);
        trial.rounding("way [m]", world.bodies().position[block][0],
                       way + slowing * r * (h - r) / 2, 1 / h, h);
        trial.rounding("stays where it stopped [m/s]", seen.y.back(), 0.0, speed, h);
        if (h == 1e-2)
            trial.curves({"speed",
                          "t [s]",
                          "v [m/s]",
                          {seen, {"exact", {0, t_stop, t_stop + 0.2}, {speed, 0, 0}, true}}});
    }
}

const Register u01(
    {.id = "U01",
     .name = "block-up-an-incline",
     .title = "A block shot up an incline",
     .gate = 1,
     .setup = "A block that does not turn is shot up an incline of 20° at 2 m/s; friction 0.5.",
     .reference = {"frac{dv}{dt} = −g (sin β + μ cos β)", "stays, since μ > tan β"},
     .compared = "The way up, step of the stop included, and the rest after it.",
     .kind = Class::R,
     .why = "Constant forces are exact; 1/h steps add their rounding errors.",
     .source = "Elementary.",
     .catches = {Fault::friction_off, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace U01
}  // namespace validation
