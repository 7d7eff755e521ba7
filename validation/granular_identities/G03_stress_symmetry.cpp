// SPDX-License-Identifier: BSL-1.0
#include "box_of_balls.hpp"

namespace validation {
namespace {

template <int Dim>
void run(Trial<Dim>& trial) {
    const BoxOfBalls<Dim> box{Dim == 2 ? 6 : 3, Dim == 2 ? 6 : 4};
    auto falling = box.make(trial, settling_params<Dim>(0.5));
    falling.system().forces.push_back(drag<Dim>(drag_rate));
    falling.run(settling_time);

    Series seen{"asymmetry", {}, {}}, bound{"10 × residual", {}, {}, true};
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
        auto params = settling_params<Dim>(0.5);
        params.solver = {.max_sweeps = 200000, .tolerance = tolerance};
        auto resting = box.make(trial, params);
        copy_places<Dim>(falling, resting);
        const auto report = resting.equilibrium();
        const auto moments = internal_moments<Dim>(
            report.data.problem.jacobian, measured_forces<Dim>(trial, report.data),
            resting.bodies().count());
        double all = 0.0, odd = 0.0;
        for (std::size_t i = BoxOfBalls<Dim>::walls; i < moments.size(); ++i) {
            all += moments[i].squaredNorm();
            odd += (moments[i] - moments[i].transpose()).squaredNorm();
        }
        const double asymmetry = std::sqrt(odd / all);
        trial.within("asymmetry of the internal moments, tolerance " +
                         std::to_string(static_cast<int>(std::round(std::log10(tolerance)))),
                     asymmetry, 0.0, 10 * tolerance, "ten times the residual asked for");
        seen.x.push_back(-std::log10(tolerance));
        seen.y.push_back(std::log10(asymmetry));
        bound.x.push_back(-std::log10(tolerance));
        bound.y.push_back(std::log10(10 * tolerance));
    }
    trial.curves({"asymmetry over the solver's tolerance", "digits asked of the solver",
                  "log10 of the asymmetry", {bound, seen}});
}

const Register g03(
    {.id = "G03",
     .name = "stress-symmetry",
     .title = "Grains at rest have symmetric moments",
     .gate = 2,
     .setup = "A heap of 36 discs (spheres) with friction 0.5 that fell into its box and came to "
              "rest in thick air; then one step from rest, with the solver stopped at 1e-6, 1e-8 "
              "and 1e-10.",
     .reference = {"M = Σ_c (x_c − x_G) ⊗ f_c",
                   "M − M^T = torque = frac{I Δω}{h}: 0 at rest"},
     .compared = "The root mean square of M − M^T over that of M, against ten times the residual.",
     .kind = Class::T,
     .why = "What the solver leaves undone appears as spin: the asymmetry is a diagnostic of the "
            "solver, and bounded by its residual.",
     .source = "Balance of moments.",
     .catches = {Fault::forces_in_local_axes, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace
}  // namespace validation
