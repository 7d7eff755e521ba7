// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D09 {

/// Floor (body 0), left wall (1), right wall (2), lower ball (3), upper ball (4), each of weight 1
/// and radius 1.
template <int Dim>
World<Dim> well(Trial<Dim>& trial, double width, double h) {
    auto world = trial.world(statics_params<Dim>(h));
    world.add_floor();
    world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(0));
    world.add_plane(in_plane<Dim>(width, 0), -V<Dim>::Unit(0));
    const double across = width - 2.0, rise = std::sqrt(4.0 - across * across);
    world.add(talus::Ball<Dim>{1.0}, round_inertia<Dim>(1.0 / g, 1.0), {in_plane<Dim>(1, 1), {}});
    world.add(talus::Ball<Dim>{1.0}, round_inertia<Dim>(1.0 / g, 1.0),
              {in_plane<Dim>(1 + across, 1 + rise), {}});
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double width = 3.2, sine = (width - 2) / 2, cosine = std::sqrt(1 - sine * sine);
    trial.rounding("reference, wall", sine / cosine, 0.75, 1.0);
    trial.rounding("reference, between the balls", 1 / cosine, 1.25, 1.0);
    const auto report =
        expect<Dim>(trial, "pair", true, [&](double h) { return well<Dim>(trial, width, h); });
    const auto force = [&](talus::BodyIndex from, talus::BodyIndex to) {
        return resultant<Dim>(report, from, to, V<Dim>::Zero()).force.norm();
    };
    trial.solver("left wall / W", force(1, 3), sine / cosine, 1.0, statics_tolerance);
    trial.solver("right wall / W", force(2, 4), sine / cosine, 1.0, statics_tolerance);
    trial.solver("between the balls / W", force(3, 4), 1 / cosine, 1.0, statics_tolerance);
    trial.solver("floor / W", force(0, 3), 2.0, 1.0, statics_tolerance);
}

const Register d09(
    {.id = "D09",
     .name = "two-balls-in-a-well",
     .title = "Two balls in a well",
     .gate = 2,
     .setup = "Two smooth discs (spheres) of radius 1 m and weight W in a well (slot) 3.2 m wide: "
              "one on the floor against the left wall, the other on it against the right wall.",
     .reference = {"sin a = frac{w − 2 r}{2 r} = 0.6", "walls: W tan a = 0.75 W",
                   "between the balls: frac{W}{cos a} = 1.25 W", "floor: 2 W"},
     .compared = "All four forces.",
     .kind = Class::S,
     .why = "Isostatic: as many forces as equations, so they agree to the solver's tolerance.",
     .source = "Elementary statics.",
     .catches = {Fault::tilted_normal, Fault::residual_ignored, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace D09
}  // namespace validation
