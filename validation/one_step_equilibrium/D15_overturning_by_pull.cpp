// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D15 {

constexpr double mu = 0.3, half_width = 0.2, half_height = 0.5;

/// A block of unit weight, pulled at height z with force F along the first axis.
template <int Dim>
World<Dim> pulled(Trial<Dim>& trial, double height, double force, double h) {
    auto world = trial.world(statics_params<Dim>(h, mu));
    world.add_floor();
    const V<Dim> half = half_extents<Dim>(half_width, half_height, 0.2);
    const auto block = world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0 / g, half),
                                 {half_height * up<Dim>(), {}});
    push<Dim>(world, block, (height - half_height) * up<Dim>(), force * V<Dim>::Unit(0));
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    struct Pull {
        double height, digits;
    };
    for (const auto& [height, digits] : {Pull{0.5, 0.3}, Pull{0.9, 0.2222}}) {
        const bool topples = half_width / height < mu;
        const double critical = topples ? half_width / height : mu;
        const std::string at = "pulled at " + std::to_string(height) + " m, F / W";
        trial.within("reference, " + at, critical, digits, 5e-5, "digits");
        expect_threshold<Dim>(
            trial, at, 0.99 * critical, 1.01 * critical,
            [&, height = height](double h, double f) { return pulled<Dim>(trial, height, f, h); });
        // The manner of it.
        const double force = 1.01 * critical;
        const auto report = pulled<Dim>(trial, height, force, 1e-2).equilibrium();
        const double speed = report.data.end[1].linear[0] / (g * 1e-2);
        const double spin = -tilting_spin<Dim>(report.data.end[1]) / (g * 1e-2);
        const double corner = 4.0 / 3 * (half_width * half_width + half_height * half_height);
        trial.solver("spin of the first step / (g h), " + at, spin,
                     topples ? (force * height - half_width) / corner : 0.0, 1.0 / half_width,
                     statics_tolerance);
        trial.solver("speed of the first step / (g h), " + at, speed,
                     topples ? spin * half_height : force - mu, 1.0, statics_tolerance);
    }
}

const Register d15(
    {.id = "D15",
     .name = "overturning-by-pull",
     .title = "A block pulled over",
     .gate = 2,
     .setup = "A block 0.4 m wide and 1 m high on a floor with friction 0.3 is pulled sideways at "
              "height 0.5 m, where it slides, and at 0.9 m, where it topples; 1 % on either side "
              "of the critical force.",
     .reference = {"topples if F > W frac{a}{z}, where frac{a}{z} < μ",
                   "slides if F > μ W otherwise",
                   "toppling: frac{dω}{dt} = frac{F z − W a}{frac{4}{3} m (a^2 + c^2)}"},
     .compared = "The verdict, at two step sizes, cold and warm; spin and speed of the first step.",
     .kind = Class::S,
     .why = "The step from rest is exact, so that rates agree to the solver's tolerance.",
     .source = "Elementary statics.",
     .catches = {Fault::friction_off, Fault::short_arm, Fault::pulling_contact}},
    run<2>, run<3>, __FILE__);

}  // namespace D15
}  // namespace validation
