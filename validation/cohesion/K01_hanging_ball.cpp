// SPDX-License-Identifier: BSL-1.0
#include "cohesion/cohesive_block.hpp"

namespace validation {
namespace K01 {

/// The half-space is a ceiling: gravity points away from it.
template <int Dim>
CohesiveBlock<Dim> hanging(Trial<Dim>& trial, double part, double h) {
    return {trial.fault(), h, 0.3, part * CohesiveBlock<Dim>::mass * g, g * up<Dim>()};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double h : {1e-2, 3e-3, 1e-3})
        for (const double part : {0.0, 0.5, 0.999, 1.001, 2.0}) {
            auto ball = hanging(trial, part, h);
            const std::string name = std::to_string(part) + " of the weight";
            Worst velocity, way;
            double before = 0.0, fallen = 0.0;
            ball.run(0.3, [&](double t, const V<Dim>& u, const V<Dim>& x) {
                // Cohesion acts in one step, the first; then the gap is open.
                const double falling = part > 1.0 ? 0.0 : g * t - part * g * h;
                fallen += h / 2 * (before + falling);
                before = falling;
                velocity.see(u, V<Dim>(falling * up<Dim>()));
                way.see(x, V<Dim>(fallen * up<Dim>()));
            });
            trial.rounding("velocity, cohesion " + name, velocity, 1.0 / std::sqrt(h), h);
            trial.rounding("way, cohesion " + name, way, 1.0 / std::sqrt(h), h);
            trial.within("worst residual, cohesion " + name, ball.worst_residual(), 0.0, 1e-12,
                         "100 times the solver's tolerance", h);
        }
    trial.order(
        "velocity of free fall after a break at half the weight", halvings(1e-2, 5),
        [&](double h) {
            double end = 0.0;
            hanging(trial, 0.5, h).run(0.32, [&](double t, const V<Dim>& u, const V<Dim>&) {
                end = u[Dim - 1] - g * t;
            });
            return end;
        },
        first_order);
}

const Register k01(
    {.id = "K01",
     .name = "hanging-by-cohesion",
     .title = "A ball hangs from a ceiling by its cohesion",
     .gate = 1,
     .setup = "A ball of 2 kg, which does not turn, touches a ceiling from below. The contact is "
              "cohesive, with a force of 0, 0.5, 0.999, 1.001 or 2 times the weight.",
     .reference = {"u = 0 for F_c ≥ m g", "u_k = g k h − frac{F_c h}{m} else, k = 1, 2, ...",
                   "u = g t for h to 0"},
     .compared = "Velocity and way at every step; the order in which free fall is approached.",
     .kind = Class::R,
     .why = "The forces are constant and the step is exact. A broken contact has cost one impulse "
            "h F_c, that of the step in which it opened: an error of first order in velocity.",
     .source = "Balance of momentum; the law.",
     .catches = {Fault::loose_contact, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace K01
}  // namespace validation
