// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A08 {

constexpr double mass = 1.0, mu = 0.3, rate = 5.0;

/// A block that is pulled along `heading` with a force that grows from nothing.
template <int Dim>
World<Dim> pulled(Trial<Dim>& trial, double h) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_floor();
    const auto block = add_block<Dim>(world, mass, V<Dim>::Zero(), V<Dim>::Zero());
    push(world, block, [](double t, const V<Dim>&) { return V<Dim>(rate * t * heading<Dim>()); });
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double release = mu * mass * g / rate, end = 3 * release;
    trial.within("reference, release time", release, 0.5886, 5e-5, "digits given");
    const auto exact_v = [&](double t) {
        const double s = std::max(0.0, t - release);
        return rate * s * s / (2 * mass);
    };
    const auto exact_x = [&](double t) {
        const double s = std::max(0.0, t - release);
        return rate * s * s * s / (6 * mass);
    };
    for (const int count : {200, 400}) {
        const double h = release / count;
        auto world = pulled(trial, h);
        Worst v, excess;
        Series path{"h = t_0/" + std::to_string(count), {}, {}}, exact{"exact", {}, {}, true};
        world.run(end, [&](const auto& w) {
            const double t = w.time(), s = std::max(0.0, t - release);
            const V<Dim> way = w.bodies().position[1] - 0.1 * up<Dim>();
            v.see(w.bodies().velocity[1], V<Dim>(exact_v(t) * heading<Dim>()));
            excess.see(V<Dim>(way - exact_x(t) * heading<Dim>()),
                       V<Dim>(rate / mass * h * h * s / 12 * heading<Dim>()));
            path.x.push_back(t), path.y.push_back(w.bodies().velocity[1].dot(heading<Dim>()));
            exact.x.push_back(t), exact.y.push_back(exact_v(t));
        });
        // Times, velocities and ways are of order 1; 600 or 1200 steps add their rounding errors.
        trial.rounding("velocity", v, 3.0, h);
        trial.rounding("excess of the way", excess, 3.0, h);
        trial.curves(
            {"velocity, h = t_0/" + std::to_string(count), "t [s]", "v [m/s]", {path, exact}});
    }
    trial.order(
        "way at 3 t_0", halvings(release / 25, 6),
        [&](double h) {
            auto world = pulled(trial, h);
            world.run(end);
            return world.bodies().position[1].dot(heading<Dim>()) - exact_x(end);
        },
        second_order);
}

const Register a08(
    {.id = "A08",
     .name = "ramp-force-release",
     .title = "A growing pull sets a block free",
     .setup = "A block of 1 kg rests on a floor with friction 0.3 and is pulled along the floor "
              "(in space at 37 degrees from an axis) with a force that grows by 5 N every second. "
              "The step size divides the time t_0 at which the pull overcomes friction.",
     .reference = {"t_0 = frac{μ m g}{k} = 0.5886 s", "v = frac{k (t − t_0)^2}{2 m}",
                   "x = frac{k (t − t_0)^3}{6 m}", "x_h − x = frac{k}{m} frac{h^2 (t − t_0)}{12}"},
     .compared = "The velocity at every step, the excess of the way over the exact one against its "
                 "formula, and the order in h of the way.",
     .kind = Class::R,
     .why = "The force enters at the midpoint of the step, which integrates a linear force "
            "exactly; the way is the trapezoidal sum of the velocities.",
     .source = "Elementary; the excess is the error of the trapezoidal rule on a parabola.",
     .catches = {Fault::friction_off, Fault::force_at_begin, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace A08
}  // namespace validation
