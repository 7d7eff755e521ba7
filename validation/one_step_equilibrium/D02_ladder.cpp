// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D02 {

constexpr talus::MaterialIndex ladder_side = 0, floor_side = 1, wall_side = 2;

template <int Dim>
World<Dim> ladder(Trial<Dim>& trial, double mu_floor, double mu_wall, double angle, double h) {
    talus::MaterialTable<Law<Dim>> laws(3, law<Dim>(0.0));
    laws.set(ladder_side, floor_side, law<Dim>(mu_floor));
    laws.set(ladder_side, wall_side, law<Dim>(mu_wall));
    auto world = trial.world(statics_params<Dim>(h), laws);
    world.add_floor(floor_side);
    world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(0), wall_side);
    const V<Dim> centre = in_plane<Dim>(0.5 * std::cos(angle), 0.5 * std::sin(angle));
    world.add(Rod<Dim>{1.0}, rod_inertia<Dim>(1.0, 1.0), {centre, tilt<Dim>(-angle)}, {},
              ladder_side);
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    struct Pair {
        double floor, wall, degrees;
    };
    for (const auto& [floor, wall, degrees] :
         {Pair{0.4, 0.3, 47.726311}, Pair{0.5, 0.0, 45.0}, Pair{0.3, 0.6, 53.806792}}) {
        const double critical = std::atan((1 - floor * wall) / (2 * floor)) / degree;
        const std::string pair = "(" + std::to_string(floor) + ", " + std::to_string(wall) + ")";
        trial.within("reference, critical angle [deg], mu " + pair, critical, degrees, 1e-6,
                     "digits of the catalogue");
        expect_threshold<Dim>(trial, "mu " + pair + ", angle", critical + 0.5, critical - 0.5,
                              [&, floor = floor, wall = wall](double h, double angle) {
                                  return ladder<Dim>(trial, floor, wall, angle * degree, h);
                              });
    }
}

const Register d02(
    {.id = "D02",
     .name = "ladder",
     .title = "A ladder against a rough wall",
     .gate = 1,
     .setup = "A uniform ladder of 1 m leans on a wall. Friction on the floor and on the wall is "
              "(0.4, 0.3), (0.5, 0) and (0.3, 0.6); its angle with the floor is half a degree "
              "above and below the critical one.",
     .reference = {"tan θ = frac{1 − μ_1 μ_2}{2 μ_1}"},
     .compared = "The verdict, at two step sizes, cold and warm. The forces of a ladder that "
                 "stands are not determined.",
     .kind = Class::T,
     .why = "The verdict is yes or no: 1e-9 g h and 1e-4 g h are far from both answers.",
     .source = "Coulomb; any text on statics.",
     .catches = {Fault::friction_off, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace D02
}  // namespace validation
