// SPDX-License-Identifier: BSL-1.0
#include "sliding_rod.hpp"

namespace validation {
namespace C04 {

void run(Trial<2>& trial) {
    const double mu = 2.0;
    struct Control {
        std::string name;
        double degrees, slide, stiffness, force;
    };
    for (const auto& [name, degrees, slide, stiffness, digits] :
         {Control{"(a) 60 degrees, safe side", 60, 1.0, 4.348076, 2.2562},
          Control{"(b) 20 degrees", 20, -1.0, 1.721, 5.701},
          Control{"(c) 80 degrees", 80, -1.0, 0.064, 0.0}}) {
        const double theta = degrees * degree;
        const TipBlock w(theta);
        const double side = slide > 0 ? 1.0 : -1.0;
        const double a = w.nn + side * mu * std::abs(w.nt);
        trial.within("reference, A, " + name, a, stiffness, 1e-3, "digits");
        if (digits > 0.0)
            trial.within("reference, P_n / h, " + name, g / a, digits, 1e-3, "digits");
        for (const double h : {1e-2, 1e-3, 1e-4}) {
            const auto solutions = Enumeration(tip_problem(theta, mu, slide, 0.0, h)).solutions();
            trial.holds("reference, one solution, " + name, solutions.size() == 1, {}, h);
            auto world = sliding_rod<2>(trial, theta, mu, slide, 0.0, h);
            const auto& data = world.step();
            trial.holds("one contact, " + name, data.contact_count() == 1, {}, h);
            if (data.contact_count() != 1) continue;
            const V<2> p = tip_impulse<2>(data), u = tip_velocity<2>(data, data.end);
            const bool slips = std::abs(u[1]) > 1e-9;
            trial.rounding("impulse against the enumerated one, " + name, p,
                           V<2>(solutions.at(0).r), 1.0, h);
            trial.holds("status of the enumeration, " + name, slips == (solutions[0].status != "s"),
                        solutions[0].status, h);
            if (slips) {
                trial.rounding("P_n / h, " + name, p[0] / h, g / a, g / a / h * 1e-2, h);
                trial.rounding("P_t / P_n, " + name, p[1] / p[0], -side * mu, 1 / h, h);
                const double slowing = g * (mu * w.tt + side * std::abs(w.nt)) / a;
                trial.rounding("slowing of the tip, " + name,
                               (std::abs(slide) - std::abs(u[1])) / h, slowing, slowing / h, h);
            }
            // (c) slows down at 1.1e3 m/s^2: it really stops within 0.89 ms.
            if (degrees == 80)
                trial.holds("(c) sticks in steps longer than 0.89 ms", slips == (h < 8.9e-4), {},
                            h);
            else
                trial.holds(name + " slips", slips, {}, h);
        }
    }
}

const Register c04(
    {.id = "C04",
     .name = "painleve-consistent-controls",
     .title = "A rod that slides as it should",
     .gate = 1,
     .setup =
         "The rod with friction 2 outside of the paradox: (a) at 60° sliding to the safe side, "
         "(b) at 20° and (c) at 80° to the critical side, 1 m/s.",
     .reference = {"slip: frac{P_n}{h} = frac{m g}{A}, A = 1 + 3 cos^2 θ ± 3 μ sin θ cos θ",
                   "slowing of the tip: frac{g (μ W_{tt} ± |W_{nt}|)}{A}"},
     .compared = "Impulse and status with the enumeration; force and slowing with the closed form "
                 "wherever the tip slips.",
     .kind = Class::R,
     .why = "The midpoint geometry is the initial one, so the step is exact; forces are impulses "
            "divided by h. In (c) the slowing is 1.1e3 m/s²: steps above 0.89 ms rightly stick.",
     .source = "Elementary; enumeration of statuses.",
     .catches = {Fault::friction_off, Fault::short_arm, Fault::tilted_normal}},
    run, nullptr, __FILE__);

}  // namespace C04
}  // namespace validation
