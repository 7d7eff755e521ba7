// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A11 {

constexpr double mass = 1.0, stiffness = 100.0, mu = 0.2, x_start = 0.1;
constexpr double dead_zone = mu * mass * g / stiffness;
const double w = std::sqrt(stiffness / mass);

struct Motion {
    std::vector<double> turns;  ///< the last one is where it stops
    double stop_time = 0.0;
    Series path;
};

/// The oscillator, begun where the exact motion is at time `delay` and timed from there.
template <int Dim>
Motion oscillate(Trial<Dim>& trial, double h, double delay = 0.0) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    world.add_floor();
    const double amplitude = x_start - dead_zone;
    const V<Dim> x0 = (dead_zone + amplitude * std::cos(w * delay)) * heading<Dim>();
    const V<Dim> v0 = -amplitude * w * std::sin(w * delay) * heading<Dim>();
    const auto block = add_block<Dim>(world, mass, x0, v0);
    push(world, block, [](double, const V<Dim>& x) {
        return V<Dim>(-stiffness * x.dot(heading<Dim>()) * heading<Dim>());
    });
    Motion motion;
    motion.path.name = "h = " + std::to_string(h);
    double extreme = 0.0, sense = -1.0;
    world.run(1.3, [&](const auto& now) {
        const double x = now.bodies().position[1].dot(heading<Dim>());
        const double v = now.bodies().velocity[1].dot(heading<Dim>());
        if (std::abs(v) > 1e-12) {
            // A block that reverses may rest for a step.
            if (v * sense < 0.0) {
                motion.turns.push_back(extreme);
                sense = -sense;
            }
            extreme = x;
            motion.stop_time = now.time() + h + delay;
        }
        if (sense * (x - extreme) > 0.0) extreme = x;
        motion.path.x.push_back(now.time() + delay), motion.path.y.push_back(x);
    });
    motion.turns.push_back(motion.path.y.back());
    return motion;
}

/// Each half swing goes about +D or -D, against the motion.
double exact_x(double t) {
    double turn = x_start;
    for (int k = 0;; ++k, t -= pi / w) {
        const double centre = std::copysign(dead_zone, turn);
        if (std::abs(turn) <= dead_zone) return turn;
        if (t <= pi / w) return centre + (turn - centre) * std::cos(w * t);
        turn = 2 * centre - turn;
    }
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double half_period = pi / w, stop_time = 3 * half_period;
    const std::vector<double> turns{-(x_start - 2 * dead_zone), x_start - 4 * dead_zone,
                                    -(x_start - 6 * dead_zone)};
    trial.within("reference, dead zone", dead_zone, 0.01962, 1e-12, "exact decimal");
    trial.within("reference, first turn", turns[0], -0.06076, 1e-12, "exact decimal");
    trial.within("reference, second turn", turns[1], 0.02152, 1e-12, "exact decimal");
    trial.within("reference, place of the stop", turns[2], 0.01772, 1e-12, "exact decimal");
    trial.within("reference, time of the stop", stop_time, 0.942477796, 5e-10, "digits given");
    trial.holds("reference, stops within the dead zone", std::abs(turns[2]) <= dead_zone);

    Series exact{"exact", {}, {}, true};
    for (int k = 0; k <= 200; ++k)
        exact.x.push_back(1.3 * k / 200), exact.y.push_back(exact_x(exact.x.back()));
    for (const double h : {1e-2, 1e-3, 3.7e-4}) {
        const Motion motion = oscillate(trial, h);
        trial.holds("turns twice and stops at the third", motion.turns.size() == 3, {}, h);
        for (std::size_t k = 0; k < std::min(turns.size(), motion.turns.size()); ++k)
            trial.within("turning point " + std::to_string(k + 1), motion.turns[k], turns[k],
                         10 * h * h, "10 h^2", h, Class::D2);
        trial.within("time of the stop", motion.stop_time, stop_time, 2 * h, "2 h", h, Class::D1);
        if (h == 1e-2) trial.curves({"place", "t [s]", "x [m]", {motion.path, exact}});
    }
    trial.order(
        "place of the stop, mean over shifted starts", halvings(1.1e-2, 6),
        [&](double h) {
            return mean_over_shifts(8, [&](double shift) {
                return std::abs(oscillate(trial, h, shift * h).turns.back() - turns.back());
            });
        },
        second_order);
}

const Register a11(
    {.id = "A11",
     .name = "coulomb-oscillator",
     .title = "Dry friction brings an oscillator to rest",
     .setup = "A block of 1 kg on a floor with friction 0.2 is tied to a spring of 100 N/m and "
              "let go 0.1 m from where the spring is slack (in space along 37 degrees).",
     .reference = {"D = frac{μ m g}{k} = 0.01962 m", "x_n = (−1)^n (x_0 − 2 n D)",
                   "t_n = n π √{frac{m}{k}}", "stops at the first n with |x_n| ≤ D"},
     .compared = "The turning points, the place and the time of the stop; the order of the place.",
     .kind = Class::D2,
     .why = "Leapfrog errs by h^2; each reversal falls within a step, which costs another h^2. "
            "The order is that of the mean over eight starts shifted by fractions of a step.",
     .source = "Den Hartog 1931.",
     .catches = {Fault::friction_off, Fault::force_at_begin, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace A11
}  // namespace validation
