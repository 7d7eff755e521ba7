// SPDX-License-Identifier: BSL-1.0
#include "sliding_rod.hpp"

namespace validation {
namespace C02 {

template <int Dim>
void run(Trial<Dim>& trial) {
    const double theta = 60 * degree, mu = 2.0, s = std::sin(theta), c = std::cos(theta);
    const V<2> limit(0.75 * s * c, (1 + 3 * c * c) / 4);
    trial.within("reference, P_n", limit[0], 0.324759526, 1e-9, "digits");
    trial.within("reference, P_t", limit[1], 0.4375, 1e-9, "digits");
    trial.rounding("reference, P_t / P_n = mu_P", limit[1] / limit[0], critical_friction(theta),
                   1.0);
    trial.within("reference, W_nn - mu |W_nt|", slip_stiffness(theta, mu), -0.848076, 5e-7,
                 "digits");
    Series found{"talus", {}, {}}, exact{"limit", {-4.5, -2.0}, {limit[0], limit[0]}, true};
    for (const double h : {1e-2, 1e-3, 1e-4}) {
        // Only one status can be: stick.
        const auto solutions = Enumeration(tip_problem(theta, mu, -1.0, 0.0, h)).solutions();
        trial.holds("reference, the enumeration finds sticking and nothing else",
                    solutions.size() == 1 && solutions[0].status == "s", {}, h);
        auto world = sliding_rod<Dim>(trial, theta, mu, -1.0, 0.0, h);
        const double before = talus::kinetic_energy(world.bodies(), 1);
        const auto& data = world.step();
        trial.holds("one contact", data.contact_count() == 1, {}, h);
        if (data.contact_count() != 1) continue;
        const V<2> p = tip_impulse<Dim>(data);
        trial.rounding("impulse against the enumerated one", p, V<2>(solutions.at(0).r), 1.0, h);
        trial.rounding("the tip stops", tip_velocity<Dim>(data, data.end), V<2>(0, 0), 1.0, h);
        trial.within("impulse against the limit", p, limit, 100 * h, "100 h", h);
        const double spin = tilting_spin<Dim>(data.end[1]);
        trial.within("spin [rad/s]", spin, 1.5 * s, 100 * h, "100 h", h);
        const double loss = before - talus::kinetic_energy(world.bodies(), 1);
        trial.within("energy lost [J]", loss, (1 + 3 * c * c) / 8, 100 * h, "100 h", h);
        trial.within("residual", data.report.residual, 0.0, 1e-10, "of the catalogue", h);
        found.x.push_back(std::log10(h));
        found.y.push_back(p[0]);
    }
    trial.curves(
        {"an impulse that does not shrink with h", "log10 h [s]", "P_n [N s]", {exact, found}});
    trial.order(
        "P_n against the limit", halvings(8e-3, 6),
        [&](double h) {
            auto world = sliding_rod<Dim>(trial, theta, mu, -1.0, 0.0, h);
            return tip_impulse<Dim>(world.step())[0] - limit[0];
        },
        first_order);
}

const Register c02(
    {.id = "C02",
     .name = "painleve-inconsistent",
     .title = "An impact without collision",
     .gate = 1,
     .setup = "The rod at 60° with friction 2 slides on its tip at 1 m/s towards the side where "
              "friction presses it down. No continuous motion exists: W_nn − μ |W_nt| < 0 and the "
              "free normal acceleration is negative.",
     .reference = {"the step has one solution: the tip sticks",
                   "P_n = frac{3}{4} m |v| sin θ cos θ, P_t = frac{m |v|}{4} (1 + 3 cos^2 θ)",
                   "ω^+ = ω + frac{3 |v| sin θ}{2 L}, energy lost frac{m v^2}{8} (1 + 3 cos^2 θ)"},
     .compared = "The impulse with the enumerated one; impulse, spin and loss with their limits, "
                 "which they approach in the first order: the excess is the impulse of gravity.",
     .kind = Class::T,
     .why = "The catalogue allows 100 h; the enumeration at the same h is met to rounding.",
     .source = "Lecornu 1905; Moreau 1988; Stewart 1998, 2000.",
     .catches = {Fault::short_arm, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace C02
}  // namespace validation
