// SPDX-License-Identifier: BSL-1.0
#include "arch.hpp"
#include "one_step_equilibrium/statics.hpp"

namespace validation {
namespace D13 {

double least_friction(int n, double t) {
    return least(0.1, 1.0, [&](double mu) { return ArchStatics(n, t, mu).stands(); });
}

void run(Trial<2>& trial) {
    struct Arch {
        int voussoirs;
        double thickness, mu;
    };
    Series table{"100 voussoirs (linear program)", {}, {}, true};
    for (const auto& [n, t, digits] :
         {Arch{100, 0.1076, 0.3951}, Arch{100, 0.11, 0.3924}, Arch{100, 0.12, 0.3817},
          Arch{100, 0.15, 0.3517}, Arch{100, 0.2, 0.3092}, Arch{100, 0.3, 0.3092},
          Arch{20, 0.15, 0.3503}, Arch{20, 0.3, 0.3089}, Arch{10, 0.15, 0.3503},
          Arch{10, 0.3, 0.3030}}) {
        const double mu = least_friction(n, t);
        trial.within("reference, n = " + std::to_string(n) + ", t / R = " + std::to_string(t), mu,
                     digits, 5e-5, "digits");
        if (n == 100) {
            table.x.push_back(t);
            table.y.push_back(mu);
        }
    }
    trial.curves({"least friction", "t / R", "μ", {table}});
    expect_threshold<2>(trial, "20 voussoirs, t / R = 0.3, mu", 0.320, 0.298,
                        [&](double h, double mu) { return arch(trial, 20, 0.3, mu, h); });
    const double critical = least_friction(20, 0.3);
    expect_threshold<2>(trial, "20 voussoirs, t / R = 0.3, mu within 1 %", 1.01 * critical,
                        0.99 * critical,
                        [&](double h, double mu) { return arch(trial, 20, 0.3, mu, h); });
}

const Register d13(
    {.id = "D13",
     .name = "arch-sliding-limit",
     .title = "The least friction of an arch",
     .gate = 2,
     .setup = "The arch of D12, with 10, 20 and 100 voussoirs: the smallest friction coefficient "
              "that lets it stand, over its thickness.",
     .reference = {"forces exist with |T| ≤ μ N and N ≥ 0 at every joint (linear program)"},
     .compared = "The catalogue's thresholds by the linear program; the one-step verdict for n = "
                 "20, t / R = 0.3 at μ = 0.320 and 0.298, and 1 % on either side of the threshold "
                 "0.3089.",
     .kind = Class::T,
     .why = "Friction is not associated: the one-step test asks for the existence of forces, "
            "which is what the linear program asks.",
     .source = "Gilbert, Casapulla & Ahmed 2006.",
     .catches = {Fault::friction_off, Fault::pulling_contact}},
    run, nullptr, __FILE__);

}  // namespace D13
}  // namespace validation
