// SPDX-License-Identifier: BSL-1.0
#include "pyramid.hpp"

namespace validation {
namespace D03 {

void run(Trial<2>& trial) {
    const double between = 2 - std::sqrt(3.0);
    trial.within("reference, threshold between discs", between, 0.267949192, 1e-9, "digits");
    trial.within("reference, threshold of the floor", between / 3, 0.089316397, 1e-9, "digits");
    test_pyramid<2>(trial, 2, between, between / 3);
}

const Register d03(
    {.id = "D03",
     .name = "disc-pyramid-2-1",
     .title = "Three discs piled up",
     .gate = 1,
     .setup = "Two equal discs touch each other on the floor, a third lies on both. Friction "
              "between the discs and with the floor is 1 % above and below its threshold, one at "
              "a time, with plenty at the other place.",
     .reference = {"between discs: μ ≥ 2 − √{3} = tan 15°", "floor: μ_f ≥ frac{2 − √{3}}{3}",
                   "each lower disc carries W / 2 of the upper one; the floor carries 3 W"},
     .compared = "The verdict at both thresholds, two step sizes, cold and warm; the forces that "
                 "equilibrium determines.",
     .kind = Class::S,
     .why = "Two thresholds, not one: the number often quoted is only the first. Forces agree to "
            "the solver's tolerance.",
     .source = "Elementary statics; linear programming over the cones.",
     .catches = {Fault::friction_off, Fault::residual_ignored, Fault::tilted_normal}},
    run, nullptr, __FILE__);

}  // namespace D03
}  // namespace validation
