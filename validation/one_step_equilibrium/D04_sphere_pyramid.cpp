// SPDX-License-Identifier: BSL-1.0
#include "pyramid.hpp"

namespace validation {
namespace D04 {

void run(Trial<3>& trial) {
    const double three = std::sqrt(3.0) - std::sqrt(2.0), four = std::sqrt(2.0) - 1;
    trial.within("reference, 3 spheres, between them", three, 0.317837245, 1e-9, "digits");
    trial.within("reference, 3 spheres, floor", three / 4, 0.079459311, 1e-9, "digits");
    trial.within("reference, 4 spheres, between them", four, 0.414213562, 1e-9, "digits");
    trial.within("reference, 4 spheres, floor", four / 5, 0.082842712, 1e-9, "digits");
    test_pyramid<3>(trial, 3, three, three / 4);
    test_pyramid<3>(trial, 4, four, four / 5);
}

const Register d04(
    {.id = "D04",
     .name = "sphere-pyramid",
     .title = "Pyramids of four and five spheres",
     .gate = 1,
     .setup = "Three (or four) touching equal spheres in a ring on the floor, one more on top. "
              "Friction between spheres and with the floor is 1 % above and below its threshold, "
              "one at a time, with plenty at the other place.",
     .reference = {"cos ψ = √{2/3} for three, ψ = 45° for four",
                   "between spheres: μ ≥ tan frac{ψ}{2}",
                   "floor: μ_f ≥ frac{1}{n + 1} tan frac{ψ}{2}"},
     .compared = "The verdict at both thresholds, two step sizes, cold and warm; the forces that "
                 "equilibrium determines.",
     .kind = Class::S,
     .why = "The directions of friction lie between the axes of any contact frame, so that a "
            "faceted cone shifts the threshold.",
     .source = "Derived; linear programs with 180-sided cones give the same to their facets.",
     .catches = {Fault::friction_off, Fault::faceted_cone}},
    nullptr, run, __FILE__);

}  // namespace D04
}  // namespace validation
