// SPDX-License-Identifier: BSL-1.0
#include "rolling/bowl.hpp"

namespace validation {
namespace A18 {

/// Ratio of friction to normal force that rolling from rest at the release needs at the angle th.
template <int Dim>
double demand(double th) {
    constexpr double k = kap<Dim>;
    return k / (1 + k) * std::sin(th) /
           (std::cos(th) + 2 * (std::cos(th) - std::cos(release)) / (1 + k));
}

constexpr double whole_swing = 2.6;  // a little more than the period [s]

struct Swing {
    double slip = 0.0;  ///< largest [m/s]
    Worst worst;        ///< of |F|/N on the way down
    Series ratio{"measured", {}, {}}, exact{"exact", {}, {}, true};
};

template <int Dim>
Swing swing(Trial<Dim>& trial, double mu, double h, double duration) {
    auto world = ball_in_bowl(trial, mu, h);
    Swing seen;
    bool down = true;
    double before = release;
    world.run(duration, [&](const auto& w) {
        const auto& data = w.data();
        seen.slip = std::max(seen.slip, slip_speed(data));
        const double after = bowl_angle(w), th = 0.5 * (before + after);
        before = after;
        down = down && th > 0.05;
        if (!down || data.contact_count() == 0) return;
        const auto& r = data.impulse[0];
        const double measured = r.template tail<Dim - 1>().norm() / r[0];
        seen.worst.see(measured, demand<Dim>(th));
        seen.ratio.x.push_back(th / degree), seen.ratio.y.push_back(measured);
        seen.exact.x.push_back(th / degree), seen.exact.y.push_back(demand<Dim>(th));
    });
    return seen;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr double k = kap<Dim>;
    const double limit = k / (1 + k) * std::tan(release);
    trial.within("reference, largest demand", limit, Dim == 2 ? 0.577350 : 0.494872, 5e-7,
                 "digits given");
    double largest_demand = 0.0;
    for (int n = 0; n <= 1000; ++n)
        largest_demand = std::max(largest_demand, demand<Dim>(n / 1000.0 * release));
    trial.within("reference, the demand is largest at the release", largest_demand, limit, 1e-15,
                 "compared at 1000 angles");
    for (const double h : {1e-3, 2.3e-4}) {
        auto below = ball_in_bowl(trial, 0.98 * limit, h);
        below.step();
        // The normal force holds m g cos th0; friction lacks 2 % of the limit of stopping the foot,
        // whose effective mass is m / (1 + 1/kap).
        trial.rounding("slip of the first step, 2 % below", slip_speed(below.data()),
                       0.02 * limit * g * std::cos(release) * (1 + 1 / k) * h, 1.0, h);
        const Swing above = swing(trial, 1.02 * limit, h, whole_swing);
        trial.rounding("slip at any step of a swing, 2 % above", above.slip, 0.0, 10.0, h);
        if (h == 1e-3)
            trial.curves({"friction by normal force on the way down",
                          "θ [deg]",
                          "|F| / N",
                          {above.ratio, above.exact}});
    }
    trial.order(
        "friction by normal force on the way down, worst", halvings(4e-3, 6),
        [&](double h) { return swing(trial, 1.02 * limit, h, whole_swing / 2).worst.error(); },
        first_order);
}

const Register a18(
    {.id = "A18",
     .name = "sticking-sphere-in-bowl-friction-demand",
     .title = "Friction that a ball needs to roll in a bowl",
     .setup = "A homogeneous disc (a sphere in space) of 0.1 m radius is let go from rest on the "
              "inside of a circular bowl of 1 m radius, at 60 degrees, with friction 2 % below or "
              "above what rolling needs.",
     .reference = {"frac{F}{N} = frac{κ}{1 + κ} frac{sin θ}{cos θ + 2 (cos θ − cos θ_0)/(1 + κ)}",
                   "largest at the release, frac{κ}{1 + κ} tan θ_0: 0.494872 (sphere), 0.577350 "
                   "(disc)"},
     .compared = "Below: the slip of the first step. Above: no slip in a whole swing, and the "
                 "order of the ratio of the forces on the way down.",
     .kind = Class::E,
     .why = "From rest the first step is exact, so the threshold is sharp. Later the midpoints "
            "leave the circle by a distance of order h, and the forces with them.",
     .source = "Routh.",
     .catches = {Fault::friction_off, Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace A18
}  // namespace validation
