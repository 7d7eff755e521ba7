// SPDX-License-Identifier: BSL-1.0
#include "arch.hpp"
#include "harness/gsl.hpp"
#include "one_step_equilibrium/statics.hpp"

namespace validation {
namespace D12 {

/// Thrust over specific weight R t that a hinge at angle b from the crown asks for.
double thrust_at(double b, double t) {
    const double inner = 1 - t / 2, outer = 1 + t / 2, k = 1 + t * t / 12;
    return (b * inner * std::sin(b) - k * (1 - std::cos(b))) / (outer - inner * std::cos(b));
}
/// The hinge that asks for the largest thrust.
double hinge(double t) {
    return gsl::minimum([t](double b) { return -thrust_at(b, t); }, 0.5, 0.95, 1.4);
}
/// Thrust at which the springings open outside.
double springing(double t) {
    const double outer = 1 + t / 2, k = 1 + t * t / 12;
    return (0.5 * pi * outer - k) / outer;
}

void run(Trial<2>& trial) {
    const double continuous =
        gsl::root([](double t) { return thrust_at(hinge(t), t) - springing(t); }, 0.05, 0.2);
    trial.within("reference, continuous arch, t / R", continuous, 0.107478038, 1e-9, "digits");
    trial.within("reference, hinge from the crown [deg]", hinge(continuous) / degree, 54.4840, 1e-4,
                 "digits");
    trial.within("reference, thrust", springing(continuous), 0.620881, 1e-6, "digits");

    struct Count {
        int voussoirs;
        double thickness;
    };
    Series finite{"n voussoirs (linear program)", {}, {}};
    for (const auto& [n, digits] :
         {Count{5, 0.096606}, Count{7, 0.096245}, Count{8, 0.100861}, Count{9, 0.102134},
          Count{10, 0.107460}, Count{11, 0.104910}, Count{15, 0.106266}, Count{16, 0.107237},
          Count{20, 0.107460}, Count{30, 0.107460}, Count{31, 0.107175}, Count{100, 0.107460}}) {
        const double t =
            least(0.05, 0.2, [n = n](double x) { return ArchStatics(n, x, -1.0).stands(); });
        trial.within("reference, " + std::to_string(n) + " voussoirs, t / R", t, digits, 1e-6,
                     "digits");
        finite.x.push_back(n);
        finite.y.push_back(t);
    }
    Series limit{"continuous limit", {5, 100}, {continuous, continuous}, true};
    trial.curves({"least thickness", "number of voussoirs", "t / R", {limit, finite}});

    expect_threshold<2>(trial, "10 voussoirs, t / R", 0.1085, 0.1064,
                        [&](double h, double t) { return arch(trial, 10, t, 1.0, h); });
    // The mechanism: hinges turn in turn at the crown, at 54 degrees and at the springings.
    const auto report = arch(trial, 10, 0.1064, 1.0, 1e-2).equilibrium();
    const auto relative_spin = [&](talus::BodyIndex a, talus::BodyIndex b) {
        const auto spin = [&](talus::BodyIndex k) {
            return k == 0 || k == 11 ? 0.0
                                     : report.data.end[static_cast<std::size_t>(k)].angular[0];
        };
        return spin(b) - spin(a);
    };
    // Right half, from the springing: the part below the haunch hinge leans out, the part above
    // falls in.
    const double unit = std::abs(relative_spin(0, 1));
    trial.holds("the springing hinge turns", unit > 1e-4 * g * 1e-2);
    trial.holds("the hinge at 54 degrees turns the other way",
                relative_spin(0, 1) * relative_spin(2, 3) < 0.0);
    trial.holds("the crown turns", std::abs(relative_spin(5, 6)) > 0.1 * unit);
    trial.within("the other joints of the right half stay shut",
                 std::abs(relative_spin(1, 2)) + std::abs(relative_spin(3, 4)) +
                     std::abs(relative_spin(4, 5)),
                 0.0, 1e-6 * unit, "the mechanism has five hinges");
}

const Register d12(
    {.id = "D12",
     .name = "arch-minimum-thickness",
     .title = "The thinnest semicircular arch",
     .gate = 2,
     .setup = "A semicircular arch of mean radius R = 1 m and thickness t, of n equal voussoirs "
              "with radial joints, stands on fixed springings; friction 1 keeps it from sliding. "
              "Every joint has two corner contacts. True weights and centroids of the sectors.",
     .reference = {"continuous: max_b frac{b R_i sin b − k (1 − cos b)}{R_o − R_i cos b} = "
                   "frac{frac{π}{2} R_o − k}{R_o}, k = 1 + frac{t^2}{12}",
                   "frac{t}{R} = 0.107478", "n voussoirs: linear program over the thrust line"},
     .compared = "The catalogue's values by two independent routes; the one-step verdict for n = "
                 "10 at t / R = 0.1085 and 0.1064 (threshold 0.10746), and the mechanism.",
     .kind = Class::T,
     .why = "One per cent beside the threshold the verdict is clear. The least thickness depends "
            "on n without order: on where a joint falls relative to 54.5°.",
     .source = "Couplet 1730; Milankovitch 1907; Heyman 1969; Cochetti, Colasante & Rizzi 2011.",
     .catches = {Fault::pulling_contact, Fault::reaction_lost}},
    run, nullptr, __FILE__);

}  // namespace D12
}  // namespace validation
