// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D06 {

template <int Dim>
void run(Trial<Dim>& trial) {
    const double a = 0.1, c = 0.3;
    const V<Dim> half = half_extents<Dim>(a, c, 0.1);
    expect_threshold<Dim>(trial, "mu = 0.5, tan b", 0.99 * a / c, 1.01 * a / c,
                          [&](double h, double slope) {
                              return block_on_incline<Dim>(trial, half, std::atan(slope), 0.5, h);
                          });
    expect_threshold<Dim>(trial, "mu = 0.25, tan b", 0.99 * 0.25, 1.01 * 0.25,
                          [&](double h, double slope) {
                              return block_on_incline<Dim>(trial, half, std::atan(slope), 0.25, h);
                          });

    // How it moves: about the lower edge, or along the incline.
    const double slope = std::atan(0.34), radius = std::hypot(a, c);
    const double rate = radius * std::sin(slope - std::atan(a / c)) / (4.0 / 3 * radius * radius);
    trial.within("reference, toppling rate / g", rate, 0.014201591, 1e-9, "digits");
    for (const double h : {1e-2, 1e-4}) {
        const auto topples = block_on_incline<Dim>(trial, half, slope, 0.5, h).equilibrium();
        // Downhill is towards the first axis: the prism rolls that way.
        trial.solver("spin in the first step / (g h)",
                     -tilting_spin<Dim>(topples.data.end[1]) / (g * h), rate, 1.0,
                     statics_tolerance, h);
        const auto slides =
            block_on_incline<Dim>(trial, half, std::atan(0.26), 0.25, h).equilibrium();
        const double cosine = std::cos(std::atan(0.26));
        trial.solver("speed in the first step / (g h)", slides.data.end[1].linear[0] / (g * h),
                     (0.26 - 0.25) * cosine, 1.0, statics_tolerance, h);
        trial.solver("spin while sliding / (g h)", slides.data.end[1].angular.norm() / (g * h), 0.0,
                     10.0, statics_tolerance, h);
    }
}

const Register d06(
    {.id = "D06",
     .name = "topple-or-slide",
     .title = "A prism topples or slides",
     .gate = 1,
     .setup = "A prism 0.2 m wide and 0.6 m high stands on an incline. With friction 0.5 it "
              "topples at tan β = 1/3 before it slides, with 0.25 it slides at tan β = 0.25; 1 % "
              "on either side.",
     .reference = {"slides if tan β > μ, topples if tan β > frac{a}{c}",
                   "frac{dω}{dt} = frac{m g R sin(β − β_0)}{I_{corner}}, I_{corner} = frac{4}{3} "
                   "m R^2, β_0 = atan frac{a}{c}"},
     .compared = "The verdict, at two step sizes, cold and warm; the spin of the first step when "
                 "it topples, the speed and the absence of spin when it slides.",
     .kind = Class::S,
     .why = "The step from rest is exact: the rates agree to the solver's tolerance, the spin of "
            "the sliding prism to ten times it, as lengths of 0.1 m divide.",
     .source = "Elementary; enumeration of statuses.",
     .catches = {Fault::friction_off, Fault::short_arm, Fault::pulling_contact}},
    run<2>, run<3>, __FILE__);

}  // namespace D06
}  // namespace validation
