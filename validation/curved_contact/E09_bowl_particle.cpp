// SPDX-License-Identifier: BSL-1.0
#include "curved_contact/curves.hpp"

namespace validation {
namespace E09 {

constexpr double release = 60 * degree;
const double w = std::sqrt(g);

double exact_angle(double t) {
    const double k = std::sin(release / 2);
    return 2 * std::asin(k * gsl::jacobi(gsl::ellint_K(k) - w * t, k * k).sn);
}
/// Square of the speed.
double speed2(double th) { return 2 * g * (std::cos(th) - std::cos(release)); }

/// Integral over one period of f(th), four times that over the way down, in which th = th0 - s^2
/// takes away the singularity at the release.
double over_period(const std::function<double(double)>& f) {
    return 4 * gsl::integral(
                   [&](double s) {
                       const double th = release - s * s;
                       // The cosines' difference without cancellation near the release.
                       const double v2 =
                           4 * g * std::sin(release - s * s / 2) * std::sin(s * s / 2);
                       return s > 0 ? f(th) * 2 * s / std::sqrt(v2) : 0.0;
                   },
                   0.0, std::sqrt(release));
}

template <int Dim>
double particle_energy(const World<Dim>& world) {
    return talus::kinetic_energy(world.bodies(), 1) + g * world.bodies().position[1][Dim - 1];
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double T = 4 * gsl::ellint_K(std::sin(release / 2)) / w;
    // To leading order a step of length h u leaves the circle by k (h u)^2 / 2.
    const double drift = -over_period(speed2) / 2;
    const double loss =
        -over_period([](double th) { return speed2(th) * (speed2(th) + g * std::cos(th)); }) / 2;
    trial.within("reference, period", T, 2.152874667, 5e-10, "digits given");
    trial.within("reference, gap by h", drift, -5.0903, 5e-5, "digits given");
    trial.within("reference, loss of energy by h", loss, -80.485, 5e-4, "digits given");

    const double h = T / 4000;
    auto world = particle_in_bowl(trial, h, release, 0.0);
    const double before = particle_energy(world);
    Series seen{"T/4000", {}, {}}, exact{"exact", {}, {}, true};
    Series gap{"gap / h", {}, {}};
    world.run(T, [&](const auto& now) {
        seen.x.push_back(now.time()), seen.y.push_back(angle_from_bottom(now) / degree);
        exact.x.push_back(now.time()), exact.y.push_back(exact_angle(now.time()) / degree);
        gap.x.push_back(now.time());
        gap.y.push_back((1.0 - now.bodies().position[1].norm()) / h);
    });
    trial.within("gap after a period, by h", gap.y.back() / drift, 1.0, 0.02, "2 %, leading order",
                 h, Class::D1);
    trial.within("loss of energy in a period, by h", (particle_energy(world) - before) / h / loss,
                 1.0, 0.02, "2 %, leading order", h, Class::D1);
    trial.curves({"angle", "t [s]", "θ [deg]", {seen, exact}});
    trial.curves({"gap, by h",
                  "t [s]",
                  "gap / h [m/s]",
                  {gap, {"exact after a period", {T}, {drift}, true}}});
    trial.order(
        "place after 0.7 T", halvings(T / 500, 6),
        [&](double step) {
            auto run = particle_in_bowl(trial, step, release, 0.0);
            run.run(0.7 * T);
            const double th = exact_angle(run.time());
            return (run.bodies().position[1] - in_plane<Dim>(std::sin(th), -std::cos(th))).norm();
        },
        first_order);
}

const Register e09(
    {.id = "E09",
     .name = "bowl-particle",
     .title = "A particle swings in a smooth bowl",
     .setup = "A particle of 1 kg is let go from rest inside a frictionless circular bowl of 1 m "
              "radius, at 60 degrees: a pendulum held by a one-sided contact.",
     .reference = {"T = 4 K(k) / √{g/R}, k = sin frac{θ_0}{2}",
                   "gap = −frac{h}{2} ∫ frac{u^2}{R} dt = −5.0903 h after a period",
                   "ΔE = −frac{h}{2} ∫ m frac{u^2}{R} (frac{u^2}{R} + g cos θ) dt = −80.485 h"},
     .compared = "Gap and loss of energy after a period of 4000 steps, and the order of the place "
                 "after 0.7 of a period.",
     .kind = Class::D1,
     .why = "The velocity obeys the contact at the midpoint; on the hollow side each step leaves "
            "the circle by half its curvature times the square of the step's length. The two "
            "formulas are leading terms in h.",
     .source = "Pendulum: Legendre. Drift and loss are derived here.",
     .catches = {Fault::end_point_drift, Fault::begin_point}},
    run<2>, run<3>, __FILE__);

}  // namespace E09
}  // namespace validation
