// SPDX-License-Identifier: BSL-1.0
#include <talus/law/local_problem.hpp>

#include "sliding_rod.hpp"
#include "tests/common/coulomb_enumeration.hpp"

namespace validation {
namespace C05 {

/// The tip's block; in space the axis across the rod comes last.
template <int Dim>
talus::Matrix<Dim> block(double theta) {
    const TipBlock w(theta);
    talus::Matrix<Dim> m = talus::Matrix<Dim>::Zero();
    m(0, 0) = w.nn;
    m(0, 1) = m(1, 0) = w.nt;
    m(1, 1) = w.tt;
    if constexpr (Dim == 3) m(2, 2) = 4.0;
    return m;
}

/// Largest violation of Signorini's and Coulomb's conditions, by their definition.
template <int Dim>
double violation(double mu, const V<Dim>& u, const V<Dim>& r) {
    const auto u_t = u.template tail<Dim - 1>(), r_t = r.template tail<Dim - 1>();
    double worst = std::max({-u[0], -r[0], r_t.norm() - mu * r[0], 0.0});
    worst = std::max(worst, std::min(std::abs(u[0]), std::abs(r[0])));
    // Slip has friction on the cone, opposite to it.
    if (u_t.norm() > 1e-13)
        worst = std::max(
            worst, (u_t * mu * r[0] / u_t.norm() + r_t).norm() * std::min(1.0, u_t.norm() * 1e3));
    return worst;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    // In space every right-hand side costs a search over directions.
    const int count = Dim == 2 ? 4000 : (trial.full() ? 4000 : 400);
    for (const double degrees : {20.0, 45.0, 60.0, 75.0})
        for (const double factor : {0.98, 1.02}) {
            const double theta = degrees * degree, mu = factor * critical_friction(theta);
            const talus::Matrix<Dim> w = block<Dim>(theta);
            auto rng = trial.rng(static_cast<std::uint64_t>(degrees));
            std::normal_distribution<double> normal;
            std::size_t most = 0, fewest = 99;
            double distance = 0.0, worst = 0.0;
            for (int k = 0; k < count; ++k) {
                V<Dim> b;
                for (int d = 0; d < Dim; ++d) b[d] = normal(rng);
                // Several solutions are rare away from weak lift in the plane of the rod: look
                // there too.
                if (k % 2 == 0) {
                    b[0] *= 0.01;
                    if constexpr (Dim == 3) b[2] *= 1e-6;
                }
                const talus::LocalProblem<Dim> problem{w, b};
                const CoulombEnumeration<Dim> all(problem, mu);
                most = std::max(most, all.solutions.size());
                fewest = std::min(fewest, all.solutions.size());
                const V<Dim> r = trial.solve_contact(law<Dim>(mu), problem);
                worst = std::max(worst, violation<Dim>(mu, problem.velocity(r), r));
                distance = std::max(distance, all.distance_to(r));
            }
            const std::string at = std::to_string(static_cast<int>(degrees)) + " degrees, " +
                                   std::to_string(factor).substr(0, 4) + " mu_P";
            trial.rounding("violation of the law, " + at, worst, 0.0, 10.0);
            trial.holds("reference, there is always a solution, " + at, fewest >= 1);
            if (factor < 1.0) {
                trial.holds("reference, exactly one solution, " + at, most == 1);
                // Near the threshold slip impulses grow by 1 / (1 - 0.98).
                trial.rounding("distance to the enumerated solution, " + at, distance, 0.0, 50.0);
            } else {
                trial.holds("reference, sometimes three, " + at, most == 3);
                trial.rounding("distance to the nearest enumerated solution, " + at, distance, 0.0,
                               1e3);
            }
        }
    auto world = sliding_rod<Dim>(trial, 60 * degree, 1.0, -1.0, 0.0, 1e-3);
    world.step();
}

const Register c05(
    {.id = "C05",
     .name = "one-contact-uniqueness",
     .title = "When one contact has one answer",
     .gate = 1,
     .setup =
         "The one-contact problem of the rod's tip at 20°, 45°, 60° and 75°, with friction 2 % "
         "below and above the threshold, for thousands of random right-hand sides.",
     .reference = {"one solution for every right-hand side if and only if μ |W_{nt}| < W_{nn}",
                   "at least one always, W being positive definite"},
     .compared = "The number of enumerated solutions: one, or sometimes three; the local solver's "
                 "answer with the conditions of the law and with the enumeration.",
     .kind = Class::R,
     .why = "The local solver is exact to rounding; near the threshold slip impulses are up to 50 "
            "times larger than the data, above it more.",
     .source = "Klarbring 1990; Pang & Stewart 1999.",
     .catches = {Fault::friction_off, Fault::pulling_contact, Fault::axis_bias}},
    run<2>, run<3>, __FILE__);

}  // namespace C05
}  // namespace validation
