// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D17 {

constexpr double radius = 1.0, rise = 0.3;

/// Floor (body 0), step (1) and a wheel (2) of unit weight that touches both, pulled at its centre.
template <int Dim>
World<Dim> wheel(Trial<Dim>& trial, double pull, double mu, double h) {
    auto world = trial.world(statics_params<Dim>(h, mu));
    world.add_floor();
    const double reach = std::sqrt(2 * radius * rise - rise * rise);
    world.add_obstacle(talus::Box<Dim>(half_extents<Dim>(1.0, 1.0, 1.0)),
                       talus::Pose<Dim>{in_plane<Dim>(reach + 1.0, rise - 1.0), {}});
    const auto body = world.add(talus::Ball<Dim>{radius}, round_inertia<Dim>(1.0 / g, radius),
                                {radius * up<Dim>(), {}});
    push<Dim>(world, body, V<Dim>::Zero(), pull * V<Dim>::Unit(0));
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double reach = std::sqrt(2 * radius * rise - rise * rise);
    const double critical = reach / (radius - rise);
    trial.within("reference, threshold / W", critical, 1.020204, 5e-7, "digits");
    for (const double mu : {0.0, 0.5}) {
        const std::string with = "mu = " + std::to_string(mu) + ", F / W";
        expect_threshold<Dim>(trial, with, 0.99 * critical, 1.01 * critical,
                              [&](double h, double f) { return wheel<Dim>(trial, f, mu, h); });
    }
    // Smooth: the edge takes the pull, the floor what is left of the weight.
    const double pull = 0.99 * critical;
    const auto report = wheel<Dim>(trial, pull, 0.0, 1e-2).equilibrium();
    const V<Dim> centre = radius * up<Dim>();
    trial.solver("force of the edge / W", resultant<Dim>(report, 1, 2, centre).force.norm(),
                 pull * radius / reach, 1.0, statics_tolerance);
    trial.solver("force of the floor / W", resultant<Dim>(report, 0, 2, centre).force.norm(),
                 1 - pull * (radius - rise) / reach, 1.0, statics_tolerance);
}

const Register d17(
    {.id = "D17",
     .name = "wheel-and-step",
     .title = "A wheel before a step",
     .gate = 2,
     .setup = "A wheel of radius 1 m on the floor against a step 0.3 m high is pulled sideways at "
              "its centre, 1 % below and above the force that lifts it; without friction and with "
              "0.5.",
     .reference = {"lifts if F > W frac{√{2 r s − s^2}}{r − s} = 1.020204 W",
                   "smooth: N_{edge} = frac{F r}{√{2 r s − s^2}}"},
     .compared = "The verdict, at two step sizes, cold and warm; both forces of the smooth wheel.",
     .kind = Class::S,
     .why = "The pull goes through the centre, so friction plays no part in the threshold. Smooth "
            "forces are unique and agree to the solver's tolerance.",
     .source = "Elementary statics.",
     .catches = {Fault::tilted_normal, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace D17
}  // namespace validation
