// SPDX-License-Identifier: BSL-1.0
#include <talus/problem/delassus_product.hpp>

#include "harness/gsl.hpp"
#include "sliding_rod.hpp"

namespace validation {
namespace C01 {

/// The assembled block of the tip in the plane: W_nn, |W_nt|, and the rest.
template <int Dim>
talus::Matrix<Dim> assembled(Trial<Dim>& trial, double theta) {
    auto world = sliding_rod<Dim>(trial, theta, 0.0, 0.0, 0.0, 1e-3);
    const auto& data = world.step();
    talus::DelassusProduct<Dim> w;
    w.assign(data.problem.jacobian, data.problem.inverse_mass);
    return w.diagonal_block(0);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    struct Angle {
        double degrees, mu;
    };
    Series seen{"assembled W_nn / |W_nt|", {}, {}}, exact{"(tan θ + 4 / tan θ) / 3", {}, {}, true};
    for (const auto& [degrees, digits] :
         {Angle{30, 2.501851166}, Angle{45, 1.666666667}, Angle{60, 1.347150628},
          Angle{63.4349, 4.0 / 3}, Angle{75, 1.601282526}}) {
        const double theta = degrees * degree, mu = critical_friction(theta);
        const std::string at = " at " + std::to_string(degrees) + " degrees";
        trial.within("reference, mu_P" + at, mu, digits, 1e-9, "digits");
        const TipBlock block(theta);
        const talus::Matrix<Dim> w = assembled<Dim>(trial, theta);
        const double nt = w.col(0).template tail<Dim - 1>().norm();
        trial.rounding("W_nn" + at, w(0, 0), block.nn, 4.0);
        trial.rounding("|W_nt|" + at, nt, std::abs(block.nt), 4.0);
        // In space the third axis, across the rod, has stiffness 1/m + (L/2)^2 / I = 4.
        trial.rounding("det W" + at, w.determinant(), Dim == 2 ? 4.0 : 16.0, 64.0);
        trial.rounding("mu_P" + at, w(0, 0) / nt, mu, 4.0);
        trial.holds("no paradox 0.1 % below" + at, w(0, 0) - 0.999 * mu * nt > 0.0);
        trial.holds("paradox 0.1 % above" + at, w(0, 0) - 1.001 * mu * nt < 0.0);
        seen.x.push_back(degrees);
        seen.y.push_back(w(0, 0) / nt);
    }
    for (int k = 0; k <= 100; ++k) {
        exact.x.push_back(20 + 0.65 * k);
        exact.y.push_back(critical_friction(exact.x.back() * degree));
    }
    trial.curves({"critical friction", "θ [deg]", "μ_P", {exact, seen}});

    // mu = 2: 1 + 3 c^2 = 6 s c, that is tan^2 - 6 tan + 4 = 0.
    const auto tangents = gsl::quadratic_roots(1, -6, 4);
    trial.within("reference, paradox of mu = 2 from tan", tangents[0], 0.763932, 5e-7, "digits");
    trial.within("reference, paradox of mu = 2 to tan", tangents[1], 5.236068, 5e-7, "digits");
    for (const double tangent : tangents) {
        const talus::Matrix<Dim> w = assembled<Dim>(trial, std::atan(tangent));
        trial.rounding("W_nn - 2 |W_nt| on the border",
                       w(0, 0) - 2 * w.col(0).template tail<Dim - 1>().norm(), 0.0, 8.0);
    }
    trial.within("reference, smallest mu_P is at tan = 2",
                 std::tan(gsl::minimum(critical_friction, 0.5, 1.1, 1.4)), 2.0, 1e-6,
                 "a minimum is found to the square root of rounding");
    trial.rounding("reference, smallest mu_P", critical_friction(std::atan(2.0)), 4.0 / 3, 1.0);
}

const Register c01(
    {.id = "C01",
     .name = "painleve-threshold",
     .title = "Painlevé's threshold",
     .gate = 1,
     .setup = "A uniform rod (1 kg, 1 m) with its tip on the floor, at 30°, 45°, 60°, 63.4° and "
              "75° to it; in space the rod lies in the plane of sliding.",
     .reference = {"W_{nn} = 1 + 3 cos^2 θ, W_{tt} = 1 + 3 sin^2 θ, |W_{nt}| = 3 sin θ cos θ",
                   "paradox if μ > μ_P = frac{W_{nn}}{|W_{nt}|} = frac{1}{3} (tan θ + frac{4}{tan "
                   "θ})",
                   "smallest at tan θ = 2: μ_P = frac{4}{3}"},
     .compared = "The assembled Delassus block and the sign of W_nn − μ |W_nt| on both sides of "
                 "the threshold; the borders of the paradox for μ = 2.",
     .kind = Class::R,
     .why = "A matter of geometry and inertia alone; entries are of order 4.",
     .source = "Painlevé 1895; Génot & Brogliato 1999.",
     .catches = {Fault::short_arm, Fault::tilted_normal, Fault::stale_inertia}},
    run<2>, run<3>, __FILE__);

}  // namespace C01
}  // namespace validation
