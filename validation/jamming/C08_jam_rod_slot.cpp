// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "jamming.hpp"

namespace validation {
namespace C08 {

// The mass plays no part in what is compared.
constexpr double m = 0.1, length = 1.0, h = 1e-2, mu_rod = 0.4;
constexpr double inertia = m * length * length / 12;

/// The rod's right end, from its centre; the left one is opposite.
V<2> right_end(double angle) { return 0.5 * length * V<2>(std::cos(angle), std::sin(angle)); }

/// A rod across a slot between two upright walls, its right end higher; the load pulls that end
/// upwards, which makes the rod shorter across the slot.
World<2> rod(Trial<2>& trial, double angle, double mu, double impulse) {
    auto world = trial.world({.h = h,
                              .contact = law<2>(mu),
                              .gravity = V<2>::Zero(),
                              .solver = {.max_sweeps = 200000, .tolerance = jam_tolerance}});
    const V<2> arm = right_end(angle);
    world.add_plane(-arm[0] * V<2>::Unit(0), V<2>::Unit(0));
    world.add_plane(arm[0] * V<2>::Unit(0), -V<2>::Unit(0));
    world.add(Rod<2>{length}, rod_inertia<2>(m, length), {V<2>::Zero(), tilt<2>(angle)});
    world.system().forces.push_back(
        [arm, impulse](double, const talus::Bodies<2>&, std::span<talus::Wrench<2>> wrenches) {
            wrenches[2] += talus::Wrench<2>::at(arm, impulse / h * up<2>());
        });
    return world;
}

/// Reference: the rod and its two contacts.
PlanarBody planar_rod(double angle, double mu) {
    PlanarBody body(m, inertia);
    const V<2> arm = right_end(angle);
    body.touch(-arm, {1, 0}, mu);
    body.touch(arm, {-1, 0}, mu);
    return body;
}
PlanarProblem planar(double angle, double mu, double impulse) {
    return planar_rod(angle, mu).problem(Eigen::Vector3d::Zero(),
                                         {0, impulse / m, right_end(angle)[0] * impulse / inertia});
}

void run(Trial<2>& trial) {
    trial.within("reference, threshold [degrees]", std::atan(mu_rod) / degree, 21.801409, 6e-7,
                 "digits of the catalogue");
    for (const double degrees : {21.3, 21.7, 21.9, 22.3}) {
        const double angle = degrees * degree;
        const bool jams = angle < std::atan(mu_rod);
        const std::string name = std::to_string(degrees).substr(0, 4) + " degrees";
        trial.rounding("reference, friction of the self-stress, " + name,
                       self_stress_friction(planar_rod(angle, 1.0)), std::tan(angle), 1.0);
        const Enumeration all(planar(angle, mu_rod, pull));
        trial.holds(
            "reference, " + std::string(jams ? "free and jammed" : "free alone") + ", " + name,
            all.velocities().size() == (jams ? 2u : 1u));
        const auto outcome =
            try_to_jam<2>([&](double impulse) { return rod(trial, angle, mu_rod, impulse); });
        judge<2>(trial, outcome, jams, name);
        trial.holds(
            "pushed towards the square position it " + std::string(jams ? "stays, " : "slips, ") +
                name,
            outcome.push.verdict == (jams ? talus::Verdict::equilibrium : talus::Verdict::moving));
        // Free of both walls, the load turns and lifts it.
        trial.solver("cold start, velocity, " + name, outcome.cold.data.end[2].linear,
                     V<2>(pull / m * up<2>()), pull / m, jam_tolerance);
        trial.solver("cold start, spin, " + name, outcome.cold.data.end[2].angular[0],
                     right_end(angle)[0] * pull / inertia, pull * length / inertia, jam_tolerance);
    }
    Series cold{"cold start", {}, {}}, warm{"warm start", {}, {}};
    Series free{"free, exact", {}, {}, true};
    const double critical = std::atan(mu_rod) / degree;
    for (int k = -8; k <= 8; ++k) {
        if (k == 0) continue;
        const double angle = critical + 0.25 * k;
        const auto outcome = try_to_jam<2>(
            [&](double impulse) { return rod(trial, angle * degree, mu_rod, impulse); });
        for (Series* s : {&cold, &warm, &free}) s->x.push_back(angle);
        cold.y.push_back(outcome.cold.data.end[2].angular[0]);
        warm.y.push_back(outcome.warm.data.end[2].angular[0]);
        free.y.push_back(right_end(angle * degree)[0] * pull / inertia);
    }
    trial.curves({"pulled along the slot",
                  "δ [degrees]",
                  "spin after the step [1/s]",
                  {cold, warm, free, {"jammed, exact", {critical - 2, critical}, {0, 0}, true}}});
}

const Register c08(
    {.id = "C08",
     .name = "jam-rod-slot",
     .title = "A rod wedged across a slot",
     .gate = 2,
     .setup =
         "A light rod of 1 m stands across a slot between two upright walls with friction 0.4, "
         "its chord at an angle from the perpendicular to the walls. Its higher end is "
         "pulled upwards, along the slot, by 0.01 N s in one step, from zero impulses and "
         "from those of a push downwards 10 000 times as large. No gravity.",
     .reference = {"a two-force member: self-stress along the chord if and only if δ ≤ atan μ = "
                   "21.801409 degrees"},
     .compared =
         "Whether the rod leaves or stays at 21.3, 21.7, 21.9 and 22.3 degrees; residuals "
         "below 1e-12; the enumeration lists all solutions; the threshold also follows from the "
         "impulses at zero load.",
     .kind = Class::T,
     .why = "At rest the far wall's impulse has to point along the chord, whatever the load at the "
            "other end; below the threshold that and the free rod both solve the step.",
     .source = "Elementary statics; enumeration.",
     .catches = {Fault::friction_off}},
    run, nullptr, __FILE__);

}  // namespace C08
}  // namespace validation
