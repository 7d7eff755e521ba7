// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/energy_ledger.hpp>

#include "bouncing/bouncing.hpp"

namespace validation {
namespace B04 {

constexpr Fall fall{1.0};
constexpr double duration = 50.0;

/// Steps before the one of the impact: the first midpoint that is not above the floor.
int steps_of_fall(double h) {
    int k = 0;
    while (fall.height - g * (k * h) * (k * h + h) / 2 > 0.0) ++k;
    return k;
}

template <int Dim>
void bounce(Trial<Dim>& trial, double h) {
    auto world = falling_ball<Dim>(trial, h, 1.0, fall);
    const int k = steps_of_fall(h), period = 2 * k + 1;
    const double e0 = g * fall.height;
    const auto energy = [](const World<Dim>& w) {
        // From the floor, not from the centre of the coordinates: the sharper scale.
        return talus::kinetic_energy(w.bodies()) + g * ball_height(w);
    };
    Worst drift, apex, apex_speed;
    int step = 0, impacts = 0;
    Series path{"h = " + std::to_string(h), {}, {}}, exact{"exact", {}, {}, true};
    Series change{"(E − E_0) / E_0", {}, {}};
    world.run(duration, [&](const auto& w) {
        ++step;
        const double error = (energy(w) - e0) / e0;
        drift.see(error, 0.0);
        impacts += w.data().contact_count() > 0 ? 1 : 0;
        if (step % period == 0) {
            apex.see(ball_height(w), fall.height);
            apex_speed.see(ball_speed_up(w), 0.0);
        }
        if (w.time() <= 5.0) {
            path.x.push_back(w.time()), path.y.push_back(ball_height(w));
            const double in_period = std::remainder(w.time(), 2 * fall.duration());
            exact.x.push_back(w.time()), exact.y.push_back(fall.height_at(in_period));
        }
        change.x.push_back(w.time()), change.y.push_back(error);
    });
    trial.within("largest change of energy / E_0", drift, 1e-12, "tolerance of the catalogue", h);
    // 1/h steps per second add their rounding errors.
    trial.rounding("height after whole periods", apex, duration / h, h);
    trial.rounding("speed after whole periods", apex_speed, duration / h, h);
    trial.holds("one impact per period", impacts == (step + k) / period,
                std::to_string(impacts) + " impacts", h);
    // From k (k + 1) h^2 >= t_c^2 > (k - 1) k h^2.
    trial.within("reference, half a period", (k + 0.5) * h, fall.duration() + h / 2,
                 h / 2 + h * h / (8 * fall.duration()), "the step in which the ball arrives", h,
                 Class::D1);
    if (h == 1e-2) trial.curves({"height of the lowest point", "t [s]", "z [m]", {path, exact}});
    trial.curves({"change of energy, h = " + std::to_string(h),
                  "t [s]",
                  "(E − E_0) / E_0",
                  {change, {"exact", {0.0, duration}, {0.0, 0.0}, true}}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double h : {1e-2, 1e-3}) bounce<Dim>(trial, h);
}

const Register b04(
    {.id = "B04",
     .name = "elastic-bounce-energy",
     .title = "An elastic ball bounces for ever",
     .gate = 1,
     .setup = "A ball is let go one metre above the floor and bounces for 50 s with restitution 1.",
     .reference = {"E = m g H at the end of every step",
                   "period (2 k + 1) h, k steps of fall: z = H and v = 0 after whole periods",
                   "t_c ≤ (k + frac{1}{2}) h ≤ t_c + h + frac{h^2}{8 t_c}"},
     .compared = "Energy at the end of every step; height and speed after whole discrete periods; "
                 "the number of impacts; the period itself with 2 t_c.",
     .kind = Class::R,
     .why = "The step of the impact reverses the velocity and gives the place back, so the ball "
            "goes back through the states it came from. Only the period differs, by less than "
            "about two steps.",
     .source = "Follows from the step; derived in the catalogue.",
     .catches = {Fault::restitution_weight, Fault::loose_contact, Fault::end_point_drift,
                 Fault::begin_point}},
    run<2>, run<3>, __FILE__);

}  // namespace B04
}  // namespace validation
