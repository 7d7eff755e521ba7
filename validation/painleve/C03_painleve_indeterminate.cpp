// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include <algorithm>

#include "sliding_rod.hpp"

namespace validation {
namespace C03 {

/// The tip lifts by 4e-6 m up to the midpoint; it is meant to be in contact.
constexpr double closed = 1e-4;

/// Error of the law's own measure at an enumerated solution, in talus' signs: the normal of the
/// contact floor-rod points from the rod to the floor.
double law_error(const PlanarProblem& p, const Eigen::VectorXd& r, double mu) {
    talus::LocalProblem<2> local{p.w, p.b};
    const V<2> impulse(r);
    return (law<2>(mu).natural_map(local.velocity(impulse), impulse, 0.25) - impulse).norm();
}

void run(Trial<2>& trial) {
    const double theta = 60 * degree, mu = 2.0, h = 1e-3;
    const auto problem = tip_problem(theta, mu, -1.0, 9.0, h);
    const auto solutions = Enumeration(problem).solutions();
    const auto with = [&](const std::string& status) -> const PlanarSolution& {
        return *std::find_if(solutions.begin(), solutions.end(),
                             [&](const PlanarSolution& s) { return s.status == status; });
    };
    const auto has = [&](const std::string& status) {
        return std::any_of(solutions.begin(), solutions.end(),
                           [&](const PlanarSolution& s) { return s.status == status; });
    };
    trial.holds("reference, exactly three solutions: open, slip, stick",
                solutions.size() == 3 && has("o") && has("-") && has("s"));
    if (solutions.size() != 3) return;
    trial.within("reference, P_n of slip", with("-").r[0], 0.009159, 5e-7, "digits");
    trial.within("reference, P_n of stick", with("s").r[0], 0.313481, 5e-7, "digits");
    trial.within("reference, P_t of stick", with("s").r[1], 0.427698, 5e-7, "digits");

    for (const PlanarSolution& s : solutions)
        trial.within("the law holds at the solution " + s.status, law_error(problem, s.r, mu), 0.0,
                     1e-10, "of the catalogue");

    auto world = sliding_rod<2>(trial, theta, mu, -1.0, 9.0, h, closed);
    const auto& data = world.step();
    trial.holds("one contact", data.contact_count() == 1);
    if (data.contact_count() != 1) return;
    trial.within("residual of the step", data.report.residual, 0.0, 1e-10, "of the catalogue");
    const V<2> p = tip_impulse<2>(data);
    double nearest = 1e9;
    std::string status;
    for (const PlanarSolution& s : solutions)
        if ((V<2>(s.r) - p).norm() < nearest) {
            nearest = (V<2>(s.r) - p).norm();
            status = s.status;
        }
    trial.rounding("distance to the nearest of the three", nearest, 0.0, 1.0);
    trial.note("The step takes the solution " + status + ".");

    // The first step sees half of the centripetal term: with spin 6 it finds no way to open.
    const double seen = 0.25 * 36 * std::sin(theta) - g, full = 0.5 * 36 * std::sin(theta) - g;
    trial.holds("spin 6: free acceleration is upwards, and the first step sees it downwards",
                full > 0.0 && seen < 0.0);
    const auto six = Enumeration(tip_problem(theta, mu, -1.0, 6.0, h)).solutions();
    trial.holds("spin 6: the step has one solution, stick",
                six.size() == 1 && six[0].status == "s");
    const auto twelve = Enumeration(tip_problem(theta, mu, -1.0, 12.0, 1e-2)).solutions();
    trial.holds("spin 12, h = 0.01: only open is left",
                twelve.size() == 1 && twelve[0].status == "o");
    auto fast = sliding_rod<2>(trial, theta, mu, -1.0, 12.0, 1e-2, 1e-2);
    const auto& opened = fast.step();
    trial.holds("spin 12, h = 0.01: so does talus",
                opened.contact_count() == 1 && opened.impulse[0].norm() == 0.0);

    Series slip{"slip", {}, {}}, stick{"stick", {}, {}};
    for (const double size : halvings(4e-3, 7)) {
        const Enumeration all(tip_problem(theta, mu, -1.0, 9.0, size));
        for (const PlanarSolution& s : all.solutions()) {
            if (s.status == "o") continue;
            Series& series = s.status == "s" ? stick : slip;
            series.x.push_back(size);
            series.y.push_back(s.r[0]);
        }
    }
    trial.curves({"normal impulse of the branches",
                  "h [s]",
                  "P_n [N s]",
                  {slip, stick, {"open", {0.0, 4e-3}, {0.0, 0.0}, true}}});
}

const Register c03(
    {.id = "C03",
     .name = "painleve-indeterminate",
     .title = "Three futures of a rod",
     .gate = 1,
     .setup = "The rod of C02 with a spin of 9 rad/s, which lifts the tip: the free normal "
              "acceleration is positive while W_nn − μ |W_nt| is negative.",
     .reference = {"open: P = 0", "slip: P_n = O(h) (0.009159 at h = 0.001)",
                   "stick: P → (0.324760, 0.4375)"},
     .compared = "The three solutions, enumerated, with the catalogue; the law's own measure at "
                 "each; talus' step with the nearest of them, which has to be one of the three.",
     .kind = Class::T,
     .why = "All three solve the step, and the method does not choose. Residuals below 1e-10.",
     .source = "Painlevé 1895; Moreau 1988; Stewart 2000.",
     .catches = {Fault::begin_point, Fault::pulling_contact}},
    run, nullptr, __FILE__);

}  // namespace C03
}  // namespace validation
