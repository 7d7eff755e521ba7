// SPDX-License-Identifier: BSL-1.0
#include "lagrangian/table.hpp"

namespace validation {
namespace F03 {

constexpr double frequency = 25.0;

double lowest(double e, int k) { return pi * k * (1 - e) / (1 + e); }
double highest(double e, int k) {
    return std::hypot(lowest(e, k), 2 * (1 + e * e) / ((1 + e) * (1 + e)));
}

/// Phase of impacts in [0, 2 pi), and speed after them: means, and means of every second one.
struct Bounces {
    double phase = 0.0, speed = 0.0, odd_phase = 0.0;
};
/// Of twenty bounces, after so many from the exact orbit.
Bounces watch(Trial<2>& trial, double gamma, double e, double h, int settle) {
    const BallOnTable table = BallOnTable::of(gamma, frequency, e);
    const double phase = std::acos(lowest(e, 1) / gamma), t = phase / table.w;
    Machine<BallOnTable> machine(trial, table, One(table.height(t)), One(pi * g / table.w),
                                 {.h = h}, t);
    Bounces mean;
    int n = 0;
    machine.run((settle + 30) / frequency, [&](const auto& data) {
        if (data.contact_count() == 0 || !(data.impulse[0][0] > 0.0)) return true;
        if (++n <= settle) return true;
        const double seen = std::fmod(table.w * data.t_mid, 2 * pi);
        mean.phase += seen / 20;
        mean.odd_phase += (n % 2 == 1 ? seen : 0.0) / 10;
        mean.speed += data.end[0] / 20;
        return n < settle + 20;
    });
    if (n < settle + 20) mean.phase = std::nan("");
    return mean;
}

void run(Trial<2>& trial) {
    trial.within("reference, e = 0.5, lower bound", lowest(0.5, 1), 1.047198, 5e-7, "digits");
    trial.within("reference, e = 0.5, upper bound", highest(0.5, 1), 1.526824, 5e-7, "digits");
    trial.within("reference, e = 0.8, upper bound", highest(0.8, 1), 1.070836, 5e-7, "digits");
    trial.within("reference, e = 0.8, k = 2, upper bound", highest(0.8, 2), 1.229728, 5e-7,
                 "digits");
    const double e = 0.8, period = 1 / frequency, phase = std::acos(lowest(e, 1));
    const double speed = pi * g / (2 * pi * frequency);
    trial.within("reference, phase", phase, 1.214222, 5e-7, "digits");
    for (const double h : {period / 1000, period / 4000}) {
        const Bounces seen = watch(trial, 1.0, e, h, 100);
        trial.within("mean phase [rad]", seen.phase, phase, 2.0 * h / period,
                     "half a step is 3 h/T", h, Class::D1);
        trial.within("mean speed after it, of V", seen.speed / speed, 1.0, 8.0 * h / period,
                     "8 h / T", h, Class::D1);
    }
    // On either side of the bound of stability.
    const double h = period / 1000;
    for (const double side : {0.98, 1.02}) {
        const Bounces seen = watch(trial, side * highest(e, 1), e, h, 400);
        const double apart = std::abs(seen.odd_phase - seen.phase);
        if (side < 1.0)
            trial.within("one phase below the bound [rad]", apart, 0.0, 6.3 * h / period,
                         "one step", h);
        else
            trial.holds("two phases above the bound", apart > 0.1, "more than 0.1 rad off the mean",
                        h);
    }
}

const Register f03(
    {.id = "F03",
     .name = "vibrating-table-period-k",
     .title = "A ball that bounces in step with a table",
     .gate = 1,
     .setup =
         "A ball on a table a sin(w t) of 25 Hz, restitution 0.8, Γ = a w^2 / g = 1 and 2 % to "
         "both sides of the bound of stability; begun on the orbit of one bounce per period.",
     .reference = {"V = frac{π k g}{w}, cos φ = frac{Γ_{min}}{Γ}, Γ_{min} = π k frac{1 − e}{1 + e}",
                   "stable for Γ < √{Γ_{min}^2 + (frac{2 (1 + e^2)}{(1 + e)^2})^2}"},
     .compared = "Mean phase and speed of twenty bounces after a hundred; whether every second "
                 "phase differs after four hundred.",
     .kind = Class::D1,
     .why = "Bounces are seen at midpoints of steps: first order.",
     .source = "Holmes 1982; Tufillaro and Albano 1986; Luo and Han 1996.",
     .catches = {Fault::restitution_weight, Fault::obstacle_velocity_forgotten}},
    run, nullptr, __FILE__);

}  // namespace F03
}  // namespace validation
