// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D18 {

constexpr double radius = 0.5;

/// A ball on a fixed equal ball, at an angle from the vertical.
template <int Dim>
World<Dim> balanced(Trial<Dim>& trial, double angle, double h) {
    auto world = trial.world(statics_params<Dim>(h, 1.0));
    world.add_obstacle(talus::Ball<Dim>{radius});
    world.add(talus::Ball<Dim>{radius}, round_inertia<Dim>(1.0, radius),
              {2 * radius * in_plane<Dim>(std::sin(angle), std::cos(angle)), {}});
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    expect<Dim>(trial, "exact column", true,
                [&](double h) { return balanced<Dim>(trial, 0.0, h); });

    // An offset of 1e-6 r of the centre.
    const double start = std::asin(1e-6 / 2), k = kap<Dim>;
    for (const double h : {1e-2, 1e-4}) {
        auto world = balanced<Dim>(trial, start, h);
        const auto report = world.equilibrium();
        trial.holds("with the offset: verdict", report.verdict == talus::Verdict::moving,
                    "of the library", h);
        const double rate = std::sin(start) / (1 + k);
        trial.solver("speed of the first step / (g h sin of the angle)",
                     report.data.end[1].linear.norm() / (g * h) / rate, 1.0, 1 / rate,
                     statics_tolerance, h);
    }

    const double lambda = std::sqrt(g / ((1 + k) * 2 * radius));
    const double duration = 4.0 / lambda;
    const auto angle_at_end = [&](double h, Series* path) {
        auto world = balanced<Dim>(trial, start, h);
        double angle = 0.0;
        world.run(duration, [&](const auto& w) {
            const V<Dim>& x = w.bodies().position[1];
            angle = std::atan2(x[0], x[Dim - 1]);
            if (path) {
                path->x.push_back(w.time());
                path->y.push_back(angle / start);
            }
        });
        // The run ends on the step nearest to the duration.
        return angle / start / std::cosh(lambda * std::round(duration / h) * h);
    };
    Series seen{"h = 0.004", {}, {}}, exact{"cosh λt", {}, {}, true};
    angle_at_end(4e-3, &seen);
    for (const double t : seen.x) {
        exact.x.push_back(t);
        exact.y.push_back(std::cosh(lambda * t));
    }
    trial.curves({"growth of the angle", "t [s]", "angle / initial angle", {seen, exact}});
    trial.order(
        "growth of the angle", halvings(8e-3, 6),
        [&](double h) { return angle_at_end(h, nullptr) - 1; }, second_order);
}

const Register d18(
    {.id = "D18",
     .name = "sphere-stack-column-instability",
     .title = "A ball balanced on a ball",
     .gate = 2,
     .setup = "A disc (sphere) of radius 0.5 m stands exactly on top of a fixed equal one, and "
              "beside it by a millionth of the radius. Friction 1, so that it rolls.",
     .reference = {"exactly on top: equilibrium, an unstable one",
                   "beside: frac{d^2 θ}{dt^2} = λ^2 sin θ, λ^2 = frac{g}{(1 + κ) 2 r}",
                   "θ = θ_0 cosh λt while small"},
     .compared = "The one-step verdict, the speed of the first step, and the growth of the angle "
                 "over four e-foldings.",
     .kind = Class::D2,
     .why = "A possible equilibrium need not be stable, and the one-step test does not ask. The "
            "errors of first order of a curved contact go with the square of the angle: at a "
            "millionth only those of second order are left.",
     .source = "Derived from rolling without slip.",
     .catches = {Fault::end_point_drift, Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace D18
}  // namespace validation
