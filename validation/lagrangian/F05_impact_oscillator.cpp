// SPDX-License-Identifier: BSL-1.0
#include "harness/machine.hpp"

namespace validation {
namespace F05 {

constexpr double e = 0.8;

/// x'' + x = cos w t on the side x <= 0 of a stop.
struct Oscillator {
    static constexpr int dof = 1;
    double w;

    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double t, const auto& q, const auto&, auto& f) const { f << std::cos(w * t) - q[0]; }
    void contacts(double, const auto& q, auto& contacts) const {
        contacts.add(-q[0], law<2>(0.0, e), "stop").rows(0, 0) = -1.0;
    }
};

/// The orbit of one impact per period: its speed before the impact and phase w t of that.
struct Orbit {
    double w, period, gam, speed, phase;

    explicit Orbit(double frequency) : w(frequency), period(2 * pi / w), gam(1 / (1 - w * w)) {
        const double cot = 1 / std::tan(period / 2);
        speed = std::abs(gam) / std::hypot((1 + e) / 2 * cot, (1 - e) / (2 * w));
        phase = std::atan2(-(1 - e) / 2 * speed / (gam * w), (1 + e) / 2 * speed * cot / gam);
    }
    /// x at s after an impact: free oscillation and forced part, from x = 0 at -e speed.
    double x(double s) const {
        const double c0 = -gam * std::cos(phase);
        const double s0 = -e * speed + gam * w * std::sin(phase);
        return gam * std::cos(phase + w * s) + c0 * std::cos(s) + s0 * std::sin(s);
    }
};

/// Mean speed of twenty impacts after sixty periods from the exact orbit.
double mean_speed(Trial<2>& trial, const Orbit& orbit, double h) {
    Machine<Oscillator> machine(trial, {orbit.w}, One(0.0), One(-e * orbit.speed), {.h = h},
                                orbit.phase / orbit.w);
    double sum = 0.0;
    int impacts = 0;
    const double from = machine.time() + 60.5 * orbit.period;
    machine.run(90 * orbit.period, [&](const auto& data) {
        if (data.t_end() < from || data.contact_count() == 0 || !(data.impulse[0][0] > 0.0))
            return true;
        sum += data.begin[0];
        return ++impacts < 20;
    });
    return impacts == 20 ? sum / 20 : std::nan("");
}

void run(Trial<2>& trial) {
    const Orbit two(2.0), other(2.2);
    trial.within("reference, speed at w = 2", two.speed, 6.666666667, 5e-10, "digits");
    trial.within("reference, speed at w = 2.2", other.speed, 1.898748738, 5e-10, "digits");
    for (const Orbit& orbit : {two, other}) {
        double highest = -1.0;
        Series path{"x", {}, {}, true};
        for (int k = 1; k < 400; ++k) {
            path.x.push_back(orbit.period * k / 400.0);
            path.y.push_back(orbit.x(path.x.back()));
            highest = std::max(highest, path.y.back());
        }
        trial.holds("reference, stays off the stop between impacts", highest < 0.0);
        trial.within("reference, comes back to it", orbit.x(orbit.period), 0.0, 1e-12, "period");
        trial.curves({"exact orbit", "t [s]", "x [m]", {path}});
    }
    trial.order(
        "impact speed, w = 2.2", halvings(8e-3, 6),
        [&](double h) { return mean_speed(trial, other, h) - other.speed; }, first_order_irregular,
        10.0);
    for (const double h : {8e-3, 2e-3, 5e-4})
        trial.within("impact speed, w = 2", mean_speed(trial, two, h), two.speed, 500 * h * h,
                     "first order vanishes by symmetry, 1/(1 - e)^2 in the rest", h, Class::D2);
}

const Register f05(
    {.id = "F05",
     .name = "impact-oscillator",
     .title = "A forced oscillator against a stop",
     .gate = 2,
     .setup = "x'' + x = cos(w t), held at x ≤ 0 by a stop of restitution 0.8; w = 2 and 2.2, "
              "begun on the orbit with one impact in each period of the force.",
     .reference = {"γ = frac{1}{1 − w^2}, T = frac{2π}{w}",
                   "γ^2 = (frac{1 + e}{2} v cot frac{T}{2})^2 + (frac{(1 − e) v}{2 w})^2"},
     .compared =
         "The mean speed of twenty impacts after sixty periods, when the discrete orbit has "
         "been reached (what is off shrinks by e^2 in a period).",
     .kind = Class::D1,
     .why = "An impact is seen up to a step late; at w = 2, where cot(T/2) = 0, that does not "
            "change the speed to first order.",
     .source = "Shaw and Holmes 1983; Thompson and Ghaffari 1983.",
     .catches = {Fault::restitution_weight, Fault::reaction_lost, Fault::force_at_begin,
                 Fault::end_point_drift}},
    run, nullptr, __FILE__);

}  // namespace F05
}  // namespace validation
