// SPDX-License-Identifier: BSL-1.0
#include "moving_obstacles/belts.hpp"

namespace validation {
namespace A16 {

constexpr double mass = 1.0, stiffness = 50.0, belt = 0.2, mu = 0.4, duration = 4.0;
const double w = std::sqrt(stiffness / mass);
constexpr double x_slip = mu * mass * g / stiffness, t_slip = x_slip / belt;

double exact_x(double t) {
    return t < t_slip ? belt * t : x_slip + belt / w * std::sin(w * (t - t_slip));
}

struct Ride {
    double error = 0.0;   ///< largest of the place [m]
    double sticks = 0.0;  ///< time without sliding after the first slip [s]
    Series x, v;
};

/// A block on a running belt, held by a spring that is slack at the start; begun at a time `delay`
/// after the spring was slack.
template <int Dim>
Ride ride(Trial<Dim>& trial, double h, double delay = 0.0) {
    auto world = trial.world({.h = h, .contact = law<Dim>(mu)});
    add_belt(world, [](double) { return V<Dim>(belt * heading<Dim>()); });
    const auto block =
        add_block<Dim>(world, mass, belt * delay * heading<Dim>(), belt * heading<Dim>());
    push(world, block, [](double, const V<Dim>& x) {
        return V<Dim>(-stiffness * x.dot(heading<Dim>()) * heading<Dim>());
    });
    Ride seen;
    seen.x.name = seen.v.name = "h = " + std::to_string(h);
    world.run(duration, [&](const auto& now) {
        const double t = now.time() + delay;
        const double x = now.bodies().position[1].dot(heading<Dim>());
        seen.error = std::max(seen.error, std::abs(x - exact_x(t)));
        if (t > t_slip + h && slip_speed(now.data()) < 1e-13) seen.sticks += h;
        seen.x.x.push_back(t), seen.x.y.push_back(x);
        seen.v.x.push_back(t), seen.v.y.push_back(now.bodies().velocity[1].dot(heading<Dim>()));
    });
    return seen;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    trial.within("reference, place of the first slip", x_slip, 0.07848, 1e-12, "exact decimal");
    trial.within("reference, time of the first slip", t_slip, 0.3924, 1e-12, "exact decimal");
    Series x{"exact", {}, {}, true}, v{"exact", {}, {}, true};
    for (int k = 0; k <= 239; ++k) {
        const double t = duration * k / 239;
        x.x.push_back(t), x.y.push_back(exact_x(t));
        v.x.push_back(t);
        v.y.push_back(t < t_slip ? belt : belt * std::cos(w * (t - t_slip)));
    }
    for (const double h : {1e-3, 1e-4}) {
        const Ride seen = ride(trial, h);
        // Twice the error that an independent program found, 1.5e-6 at 1e-3 and 1.5e-8 at 1e-4.
        trial.within("place, worst", seen.error, 0.0, 3 * h * h, "3 h^2 [m]", h, Class::D2);
        // Four times the block catches up with the belt and grazes it: no phase of sticking.
        trial.within("time of sticking after the first slip", seen.sticks, 0.0, 4 * h,
                     "a step at each of the four meetings", h);
        if (h == 1e-3) {
            trial.curves({"place", "t [s]", "x [m]", {seen.x, x}});
            trial.curves({"velocity", "t [s]", "v [m/s]", {seen.v, v}});
        }
    }
    trial.order(
        "place, worst, mean over shifted starts", halvings(4.3e-3, 6),
        [&](double h) {
            return mean_over_shifts(8,
                                    [&](double shift) { return ride(trial, h, shift * h).error; });
        },
        second_order);
}

const Register a16(
    {.id = "A16",
     .name = "belt-spring-grazing",
     .title = "A spring holds a block on a running belt",
     .setup = "A block of 1 kg rides on a belt that runs at 0.2 m/s (in space at 37 degrees from "
              "an axis) with friction 0.4, held back by a spring of 50 N/m that is slack at the "
              "start.",
     .reference = {"sticks until x_s = frac{μ m g}{k} = 0.07848 m at t_1 = 0.3924 s",
                   "x = x_s + frac{V}{ω} sin ω (t − t_1)", "ω = √{frac{k}{m}}"},
     .compared = "The worst error of the place during four seconds, its order, and the time that "
                 "the block sticks after it first slipped.",
     .kind = Class::D2,
     .why = "Leapfrog errs by h^2, and so does the first slip, which falls within a step. Each "
            "period the block reaches the belt's velocity once, tangentially: with one friction "
            "coefficient there is no cycle of stick and slip.",
     .source = "Den Hartog 1931; Leine and others 1998.",
     .catches = {Fault::obstacle_velocity_forgotten, Fault::friction_off, Fault::force_at_begin}},
    run<2>, run<3>, __FILE__);

}  // namespace A16
}  // namespace validation
