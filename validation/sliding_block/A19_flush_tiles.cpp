// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A19 {

constexpr double speed = 2.0, tile = 0.1, half_height = 0.05, start = -0.413172;

/// A box, longer than two tiles, launched along a row of tiles with their tops at height 0.
template <int Dim>
World<Dim> launched(Trial<Dim>& trial, double h, double mu) {
    auto world = trial.world(
        {.h = h,
         .contact = law<Dim>(mu),
         .step = {.scheme = talus::Scheme::gap_anticipating, .contact_tolerance = touching},
         .solver = {.max_sweeps = 50000, .tolerance = 1e-12}});
    const auto extents = [](double first, double last, double middle) {
        V<Dim> half = V<Dim>::Constant(middle);
        half[0] = first;
        half[Dim - 1] = last;
        return half;
    };
    for (int k = 0; k < 16; ++k)
        world.add_obstacle(talus::Box<Dim>(extents(0.5 * tile, 0.1, 0.5)),
                           talus::Pose<Dim>{in_plane<Dim>((k - 5.5) * tile, -0.1), {}});
    const V<Dim> half = extents(0.12, half_height, half_height);
    world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0, half),
              {in_plane<Dim>(start, half_height), {}}, {in_plane<Dim>(speed, 0.0)});
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double mu = 0.3, t_stop = speed / (mu * g), d = speed * speed / (2 * mu * g);
    trial.within("reference, distance with friction 0.3 [m]", d, 0.679579, 5e-7, "digits");
    for (const double h : {5e-3, 3e-3, 7e-4}) {
        auto smooth = launched<Dim>(trial, h, 0.0);
        Worst velocity, height;
        smooth.run(0.4, [&](const auto& w) {
            velocity.see(V<Dim>(w.bodies().velocity.back()), in_plane<Dim>(speed, 0.0));
            height.see(w.bodies().position.back()[Dim - 1], half_height);
        });
        trial.rounding("velocity without friction [m/s]", velocity, speed / h, h);
        trial.rounding("height without friction [m]", height, 1.0 / h, h);

        auto rough = launched<Dim>(trial, h, mu);
        double after = 0.0;
        Series seen{"h = " + std::to_string(h), {}, {}};
        rough.run(t_stop + 0.05, [&](const auto& w) {
            const V<Dim>& v = w.bodies().velocity.back();
            seen.x.push_back(w.time());
            seen.y.push_back(v[0]);
            if (w.time() > t_stop + h) after = std::max(after, v.norm());
        });
        const double r = t_stop - h * std::floor(t_stop / h);
        const double way = rough.bodies().position.back()[0] - start;
        trial.rounding("way with friction [m]", way, d + mu * g * r * (h - r) / 2, 1.0 / h, h);
        trial.rounding("speed after the stop [m/s]", after, 0.0, speed / h, h);
        if (h == 5e-3)
            trial.curves({"speed with friction",
                          "t [s]",
                          "v [m/s]",
                          {seen, {"exact", {0.0, t_stop, t_stop + 0.05}, {speed, 0, 0}, true}}});
    }
}

const Register a19(
    {.id = "A19",
     .name = "flush-tiles",
     .title = "A box slides over the seams of a tiled floor",
     .gate = 1,
     .setup = "A box 0.24 m long and 0.1 m high is launched at 2 m/s along a row of tiles 0.1 m "
              "long whose tops are level, without friction and with friction 0.3. The step "
              "anticipates contacts.",
     .reference = {"without friction: v = v_0", "with friction: d = frac{v_0^2}{2 μ g}",
                   "d_h = d + frac{μ g r (h − r)}{2} with r = t_* − h floor(t_* / h), t_* = "
                   "frac{v_0}{μ g}"},
     .compared = "Velocity and height after every step; the way slid against d_h, the speed after "
                 "the stop against zero: as on a floor of one piece.",
     .kind = Class::R,
     .why = "The seams are none: the box is held from below alone, and constant friction is exact "
            "but for the step of the stop, as in A02. 1/h steps add their rounding errors.",
     .source = "Elementary.",
     .catches = {Fault::ghost_edge, Fault::friction_off, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace A19
}  // namespace validation
