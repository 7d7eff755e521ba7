// SPDX-License-Identifier: BSL-1.0
#include <algorithm>

#include "harness/gsl.hpp"
#include "sliding_rod.hpp"

namespace validation {
namespace C09 {

constexpr double mu = 2.0;

/// The step in which the largest impulse of a run is taken.
struct Event {
    double time = 0.0, angle = 0.0;              ///< at the midpoint
    double slide = 0.0, lift = 0.0, spin = 0.0;  ///< before
    double slide_jump = 0.0, spin_jump = 0.0;
    double impulse = 0.0;      ///< normal [N s]
    double energy_rise = 0.0;  ///< largest over the run, relative to the start
};

/// Slides from the start until the tip has stopped, the rod has left the floor for good or the time
/// is up.
template <int Dim>
Event slide(Trial<Dim>& trial, double theta, double speed, double spin, double h, double duration,
            Series* tip = nullptr) {
    auto world = sliding_rod<Dim>(trial, theta, mu, speed, spin, h, 1e-6);
    const auto energy = [&](const World<Dim>& w) {
        return talus::kinetic_energy(w.bodies(), 1) + g * w.bodies().position[1][Dim - 1];
    };
    const double start = energy(world);
    Event event;
    world.run(duration, [&](const World<Dim>& w) {
        event.energy_rise = std::max(event.energy_rise, energy(w) / start - 1);
        const auto& data = w.data();
        if (data.contact_count() == 0) return;
        const V<2> before = tip_velocity<Dim>(data, data.begin);
        const V<2> after = tip_velocity<Dim>(data, data.end);
        if (tip) {
            tip->x.push_back(w.time());
            tip->y.push_back(after[1]);
        }
        const double impulse = tip_impulse<Dim>(data)[0];
        if (impulse <= event.impulse) return;
        const double spin_before = tilting_spin<Dim>(data.begin[1]);
        event = {data.t_mid(),
                 floor_angle(w) - 0.5 * h * tilting_spin<Dim>(data.end[1]),
                 before[1],
                 before[0],
                 spin_before,
                 after[1] - before[1],
                 tilting_spin<Dim>(data.end[1]) - spin_before,
                 impulse,
                 event.energy_rise};
    });
    return event;
}

/// Regular slip by its differential equation until the border of the paradox. There N grows like
/// 1 / A, so the equation is integrated over tau with dt = A dtau, in which nothing is singular and
/// the border lies at infinity; a thousandth of a degree before it is near enough.
struct Border {
    double time, slide;
};
Border regular_slip(double theta, double speed, double spin) {
    // y = (theta, spin, tip velocity, time)
    const auto rhs = [](double, std::span<const double> y, std::span<double> dy) {
        const double s = std::sin(y[0]), c = std::cos(y[0]), a = slip_stiffness(y[0], mu);
        const double n_a = g - 0.5 * s * y[1] * y[1];  // N A
        dy[0] = a * y[1];
        dy[1] = 6 * n_a * (mu * s - c);
        dy[2] = mu * n_a + 0.5 * (s * dy[1] + a * c * y[1] * y[1]);
        dy[3] = a;
    };
    const double near = std::atan(gsl::quadratic_roots(1, -3 * mu, 4)[0]) - 1e-3 * degree;
    std::vector<double> y{theta, spin, speed, 0.0};
    gsl::ode_until(
        rhs, 0.0, y, [&](double, std::span<const double> s) { return s[0] - near; }, 4.0);
    return {y[3], y[2]};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double border = std::atan(gsl::quadratic_roots(1, -3 * mu, 4)[0]);
    trial.within("reference, border of the paradox [deg]", border / degree, 37.377368, 5e-7,
                 "digits");
    const Border ode = regular_slip(30 * degree, -12.0, 0.0);
    trial.within("reference, time at the border by the slip equation [s]", ode.time, 0.11445, 1e-4,
                 "the catalogue's, self-converged");
    trial.within("reference, tip velocity at the border [m/s]", ode.slide, -3.67, 0.05,
                 "the catalogue's, self-converged");

    Series tip{"tip, h = 1.5625e-5 s", {}, {}};
    for (const double h : {1.5625e-5, 4e-6}) {
        const Event e =
            slide<Dim>(trial, 30 * degree, -12.0, 0.0, h, 0.13, h == 1.5625e-5 ? &tip : nullptr);
        trial.within("time of the jump [s]", e.time, ode.time, 1e-4, "of the catalogue", h);
        trial.within("angle at the jump [deg]", e.angle / degree, border / degree, 0.05,
                     "of the catalogue", h);
        trial.within("tip velocity before [m/s]", e.slide, ode.slide, 0.05, "of the catalogue", h);
        trial.within("normal velocity before: no collision [m/s]", e.lift, 0.0, 0.01,
                     "two thousandths of the slide", h);
        trial.holds("one step takes an impulse of order one", e.impulse > 0.05,
                    "steps before take " + std::to_string(g * h) + " N s and more", h);
        trial.holds("the tip velocity jumps in it", std::abs(e.slide_jump) > 0.5,
                    std::to_string(e.slide_jump) + " m/s", h);
        const double ratio = 1.5 * std::sin(e.angle);
        trial.within("jump of spin / jump of slide [1/m]", e.spin_jump / e.slide_jump, ratio, 1e-3,
                     "of the catalogue", h);
        trial.within("energy rises above the start, relative", e.energy_rise, 0.0, 1e-9,
                     "rounding of 1e4 steps, and no gain", h);
        trial.note("h = " + std::to_string(h * 1e6) + " µs: slide " + std::to_string(e.slide) +
                   " m/s, jump " + std::to_string(e.slide_jump) +
                   " m/s: the outcome does not converge and is not compared.");
    }
    trial.curves({"the jump of a smooth slide",
                  "t [s]",
                  "tip velocity [m/s]",
                  {tip, {"border reached", {ode.time, ode.time}, {-12.0, 0.0}, true}}});

    // Tamer starts reach the border with the tip at rest: the largest jump shrinks with h.
    struct Tame {
        double degrees, spin;
    };
    for (const auto& [degrees, spin] : {Tame{30, 1.0}, Tame{34, 0.5}}) {
        const std::string name =
            "tame start at " + std::to_string(static_cast<int>(degrees)) + " degrees: ";
        double last = 1e9;
        for (const double h : {2.5e-4, 6.25e-5, 1.5625e-5, 4e-6}) {
            const Event e = slide<Dim>(trial, degrees * degree, -6.0, spin, h, 0.12);
            trial.holds(name + "largest jump of the tip velocity shrinks",
                        std::abs(e.slide_jump) < last, std::to_string(e.slide_jump) + " m/s", h);
            last = std::abs(e.slide_jump);
        }
        trial.within(name + "largest jump at the last h [m/s]", last, 0.0, 0.25,
                     "a tenth of that of the catastrophe");
    }
}

const Register c09(
    {.id = "C09",
     .name = "dynamic-jam",
     .title = "A smooth slide ends in a frictional catastrophe",
     .gate = 2,
     .setup = "The rod with friction 2 at 30°, outside of the paradox, slides at 12 m/s to the "
              "critical side. It rises to 37.38°, the border of the paradox, while it still "
              "slides. There one step takes an impulse of order one, without any collision.",
     .reference = {"slip: N A(θ) = g − frac{L}{2} ω^2 sin θ, A → 0 at θ = 37.377°",
                   "jump: Δω = frac{3 sin θ}{2 L} ΔU_t, whatever its size"},
     .compared = "Time, angle and tip velocity at the jump with the integrated slip equation; the "
                 "ratio of the jumps; energy; two tame starts in which jumps shrink with h.",
     .kind = Class::T,
     .why = "The arrival at the border converges, the outcome does not: it depends on where the "
            "steps fall, and the limit problem has several. The bounds are those of the "
            "catalogue.",
     .source = "Stewart 1998, 2000; Génot & Brogliato 1999; Or & Rimon 2012.",
     .catches = {Fault::friction_off, Fault::short_arm},
     .midpoint_because = "The step in which the tip jams and jumps is the midpoint scheme's."},
    run<2>, run<3>, __FILE__);

}  // namespace C09
}  // namespace validation
