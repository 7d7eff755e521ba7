// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A02 {

constexpr double speed = 3.0, mu = 0.3;

/// A block that does not turn, launched along `direction` over the floor.
template <int Dim>
World<Dim> launched(Trial<Dim>& trial, double h, const V<Dim>& direction) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_floor();
    add_block<Dim>(world, 1.0, V<Dim>::Zero(), speed * direction);
    return world;
}

template <int Dim>
void slide(Trial<Dim>& trial, const V<Dim>& direction, const std::string& name) {
    const double t_stop = speed / (mu * g), d = speed * speed / (2 * mu * g);
    for (const double h : {1e-2, 5e-3, 3e-3, 7e-4}) {
        auto world = launched<Dim>(trial, h, direction);
        const V<Dim> start = world.bodies().position[1];
        const double r = t_stop - h * std::floor(t_stop / h);
        const double discrete = d + mu * g * r * (h - r) / 2;
        double after = 0.0;
        Series path{"h = " + std::to_string(h), {}, {}};
        world.run(t_stop + 0.3, [&](const auto& w) {
            path.x.push_back(w.time());
            path.y.push_back(w.bodies().velocity[1].dot(direction));
            // From the step on that contains the stop.
            if (w.time() > t_stop + h) after = std::max(after, w.bodies().velocity[1].norm());
        });
        const V<Dim> way = world.bodies().position[1] - start;
        trial.rounding("way " + name, way, V<Dim>(discrete * direction), 1.0 / h, h);
        trial.within("distance " + name, way.norm(), d, mu * g * h * h / 8 * (1 + 1e-9),
                     "mu g h^2 / 8, the event lies within one step", h, Class::D2);
        trial.rounding("speed after the stop " + name, after, 0.0, speed, h);
        if (h == 1e-2)
            trial.curves({"speed " + name,
                          "t [s]",
                          "v [m/s]",
                          {path, {"exact", {0.0, t_stop, t_stop + 0.3}, {speed, 0.0, 0.0}, true}}});
    }
}

template <int Dim>
void run(Trial<Dim>& trial) {
    slide<Dim>(trial, V<Dim>::Unit(0), "along an axis");
    if constexpr (Dim == 3)
        slide<3>(trial, V<3>(std::cos(37 * degree), std::sin(37 * degree), 0), "at 37 degrees");
}

const Register a02(
    {.id = "A02",
     .name = "slide-to-stop",
     .title = "A block slides to a stop",
     .gate = 1,
     .setup = "A block that does not turn is launched at 3 m/s over a floor with friction 0.3; in "
              "space also at 37 degrees from an axis.",
     .reference = {"t_* = frac{v_0}{μ g}", "d = frac{v_0^2}{2 μ g}",
                   "d_h = d + frac{μ g r (h − r)}{2} with r = t_* − h floor(t_* / h)"},
     .compared = "The way slid against d_h and against d; the speed after the stop against zero.",
     .kind = Class::R,
     .why = "Friction is constant, so the step is exact but for the step in which the block stops; "
            "there the formula for d_h accounts for it. 1/h steps add their rounding errors.",
     .source = "Elementary; d_h follows from the midpoint rule.",
     .catches = {Fault::friction_off, Fault::faceted_cone, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace A02
}  // namespace validation
