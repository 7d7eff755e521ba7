// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D19 {

/// Of the heavy ball to the light one.
constexpr double mass_ratio = 1e4;
/// What steps of simulations aim at by default.
constexpr double tolerance = 1e-4;

template <int Dim>
void run(Trial<Dim>& trial) {
    const double radius = std::pow(mass_ratio, -1.0 / Dim);
    for (const double h : {1e-2, 1e-4}) {
        // What is closed is left to the library, as in its simulations.
        auto world = trial.world(
            {.h = h, .step = {}, .solver = {.max_sweeps = 1000000, .tolerance = tolerance}});
        world.add_floor();
        const auto light = world.add(talus::Ball<Dim>(radius), round_inertia<Dim>(1.0, radius),
                                     {radius * up<Dim>(), {}});
        const auto heavy = world.add(talus::Ball<Dim>(1.0), round_inertia<Dim>(mass_ratio, 1.0),
                                     {(2.0 * radius + 1.0) * up<Dim>(), {}});
        // No contact's velocity is off by more than this times g h, by what the residual promises;
        // by one hundredth more where a step begins with the error of the one before.
        const double off = 10.1 * tolerance;
        constexpr int steps = 5;
        for (int k = 1; k <= steps; ++k) {
            const auto& data = world.step();
            const auto on = [&](talus::BodyIndex body) {
                return impulse_on<Dim>(data, body)[Dim - 1] / h;
            };
            const std::string when = ", step " + std::to_string(k);
            const char* why = "10 times the tolerance at each contact below";
            const char* twice = "the same, and that of the step before";
            trial.within("force on the heavy ball / its weight" + when, on(heavy) / mass_ratio / g,
                         1.0, 4.0 * off, twice, h);
            trial.within("force of the floor / both weights" + when,
                         (on(light) + on(heavy)) / (1.0 + mass_ratio) / g, 1.0, 4.0 * off, twice,
                         h);
            trial.within("speed of the heavy ball / (g h)" + when,
                         world.bodies().velocity[static_cast<std::size_t>(heavy)].norm() / (g * h),
                         0.0, 2.0 * off, why, h);
        }
        const auto& x = world.bodies().position;
        trial.within("sinking of the heavy ball / (g h^2)",
                     (2.0 * radius + 1.0 - x.back()[Dim - 1]) / (g * h * h), 0.0, 2.0 * off * steps,
                     "the same in each step", h);
    }
}

const Register d19(
    {.id = "D19",
     .name = "heavy-on-light",
     .title = "A heavy ball on a light one",
     .gate = 1,
     .setup = "A ball of radius 1 m stands on one of the same stuff with a 10000th of its mass "
              "(radius 10 mm in the plane, 46 mm in space), upright and without friction. The "
              "solver's tolerance is 1e-4, at which the library's simulations aim.",
     .reference = {"N_{heavy} = M g", "N_{floor} = (M + m) g", "u_{end} = 0"},
     .compared = "Both forces, the speed of the heavy ball, and how far it sinks in five steps.",
     .kind = Class::T,
     .why =
         "A contact's velocity may be off by ten times the tolerance of g h, the speed that "
         "weight alone would give in a step. The residual of all contacts together does not show "
         "that the heavy ball falls: both contacts count as much as the light ball weighs.",
     .source = "Elementary statics.",
     .catches = {Fault::worst_contact_ignored, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace D19
}  // namespace validation
