// SPDX-License-Identifier: BSL-1.0
#include <Eigen/LU>

#include "statics.hpp"

namespace validation {
namespace D08 {

/// A ball of unit weight between two planes that rise to the left at angle `left` and to the right
/// at angle `right`. Bodies 0 and 1 are the planes.
template <int Dim>
World<Dim> groove(Trial<Dim>& trial, double left, double right, double h) {
    auto world = trial.world(statics_params<Dim>(h));
    world.add_plane(V<Dim>::Zero(), in_plane<Dim>(std::sin(left), std::cos(left)));
    world.add_plane(V<Dim>::Zero(), in_plane<Dim>(-std::sin(right), std::cos(right)));
    // The centre is at distance 1 from both planes.
    Eigen::Matrix2d normals;
    normals << std::sin(left), std::cos(left), -std::sin(right), std::cos(right);
    const Eigen::Vector2d centre = normals.inverse() * Eigen::Vector2d(1.0, 1.0);
    world.add(talus::Ball<Dim>{1.0}, round_inertia<Dim>(1.0 / g, 1.0),
              {in_plane<Dim>(centre[0], centre[1]), {}});
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    struct Groove {
        double left, right, n_left, n_right;
    };
    for (const auto& [left, right, n_left, n_right] :
         {Groove{30, 60, 0.866025404, 0.5}, Groove{20, 45, 0.780206009, 0.377377474}}) {
        const double a = left * degree, b = right * degree;
        const double on_a = std::sin(b) / std::sin(a + b), on_b = std::sin(a) / std::sin(a + b);
        const std::string name = std::to_string(static_cast<int>(left)) + " and " +
                                 std::to_string(static_cast<int>(right)) + " degrees";
        trial.within("reference, N_a, " + name, on_a, n_left, 1e-9, "digits");
        trial.within("reference, N_b, " + name, on_b, n_right, 1e-9, "digits");
        const auto report =
            expect<Dim>(trial, name, true, [&](double h) { return groove<Dim>(trial, a, b, h); });
        const V<Dim> centre = V<Dim>::Zero();
        trial.solver("N_a / W, " + name, resultant<Dim>(report, 0, 2, centre).force.norm(), on_a,
                     1.0, statics_tolerance);
        trial.solver("N_b / W, " + name, resultant<Dim>(report, 1, 2, centre).force.norm(), on_b,
                     1.0, statics_tolerance);
    }
}

const Register d08(
    {.id = "D08",
     .name = "v-groove-forces",
     .title = "A ball in a smooth groove",
     .gate = 2,
     .setup = "A disc (sphere) of weight W and radius 1 m lies between two smooth planes of "
              "inclinations 30° and 60°, and 20° and 45°.",
     .reference = {"N_a = frac{W sin b}{sin(a + b)}", "N_b = frac{W sin a}{sin(a + b)}"},
     .compared = "Both normal forces.",
     .kind = Class::S,
     .why = "Two forces, two equations: unique, so they agree to the solver's tolerance.",
     .source = "Elementary statics.",
     .catches = {Fault::tilted_normal, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace D08
}  // namespace validation
