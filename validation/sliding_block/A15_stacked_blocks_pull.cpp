// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A15 {

constexpr double m_top = 1.0, m_low = 2.0, total = m_top + m_low;
constexpr double mu_top = 0.3, mu_low = 0.2;
constexpr double limit = (mu_top + mu_low) * total * g;

struct Accelerations {
    double top, low;
};
Accelerations exact(double pull) {
    const double together = (pull - mu_low * total * g) / total;
    if (together <= mu_top * g) return {together, together};
    return {mu_top * g, (pull - mu_top * m_top * g - mu_low * total * g) / m_low};
}

template <int Dim>
void pull_stack(Trial<Dim>& trial, double pull, double h) {
    constexpr talus::MaterialIndex floor = 0, low = 1, top = 2;
    talus::MaterialTable<Law<Dim>> laws(3);
    laws.set(floor, low, law<Dim>(mu_low));
    laws.set(low, top, law<Dim>(mu_top));
    auto world = trial.world({.h = h}, laws);
    world.add_floor(floor);
    // The lower one is long enough for the way that the upper one slides on it.
    V<Dim> half = V<Dim>::Constant(1.5);
    half[Dim - 1] = 0.1;
    const auto lower =
        world.add(talus::Box<Dim>(half), point_mass<Dim>(m_low), {0.1 * up<Dim>(), {}}, {}, low);
    world.add(talus::Ball<Dim>(0.2), point_mass<Dim>(m_top), {0.4 * up<Dim>(), {}}, {}, top);
    push(world, lower, [=](double, const V<Dim>&) { return V<Dim>(pull * heading<Dim>()); });

    const Accelerations a = exact(pull);
    Worst v_low, v_top, x_low, x_top;
    Series lower_path{"lower", {}, {}}, top_path{"upper", {}, {}};
    const V<Dim> start_low = world.bodies().position[1], start_top = world.bodies().position[2];
    constexpr double duration = 0.5;
    world.run(duration, [&](const auto& w) {
        const double t = w.time();
        const auto& bodies = w.bodies();
        v_low.see(bodies.velocity[1], V<Dim>(a.low * t * heading<Dim>()));
        v_top.see(bodies.velocity[2], V<Dim>(a.top * t * heading<Dim>()));
        x_low.see(V<Dim>(bodies.position[1] - start_low),
                  V<Dim>(a.low * t * t / 2 * heading<Dim>()));
        x_top.see(V<Dim>(bodies.position[2] - start_top),
                  V<Dim>(a.top * t * t / 2 * heading<Dim>()));
        lower_path.x.push_back(t), lower_path.y.push_back(bodies.velocity[1].dot(heading<Dim>()));
        top_path.x.push_back(t), top_path.y.push_back(bodies.velocity[2].dot(heading<Dim>()));
    });
    const std::string at = ", F = " + std::to_string(pull).substr(0, 6) + " N";
    // Each step may be off by the residual of its change of velocity: they add up to g t.
    trial.solver("velocity of the lower" + at, v_low, g, 1e-14, h);
    trial.solver("velocity of the upper" + at, v_top, g, 1e-14, h);
    trial.solver("way of the lower" + at, x_low, g, 1e-14, h);
    trial.solver("way of the upper" + at, x_top, g, 1e-14, h);
    if (h == 1e-2)
        trial.curves({"velocities" + at,
                      "t [s]",
                      "v [m/s]",
                      {lower_path,
                       top_path,
                       {"lower, exact", {0.0, duration}, {0.0, a.low * duration}, true},
                       {"upper, exact", {0.0, duration}, {0.0, a.top * duration}, true}}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    trial.within("reference, limit", limit, 14.715, 1e-12, "exact decimal");
    trial.within("reference, upper at 20 N", exact(20).top, 2.943, 1e-12, "exact decimal");
    trial.within("reference, lower at 20 N", exact(20).low, 5.5855, 1e-12, "exact decimal");
    trial.within("reference, both at 10 N", exact(10).low, 1.371333, 5e-7, "digits given");
    for (const double h : {1e-2, 3.1e-3})
        for (const double pull : {10.0, 0.99 * limit, 1.01 * limit, 20.0})
            pull_stack(trial, pull, h);
}

const Register a15(
    {.id = "A15",
     .name = "stacked-blocks-pull",
     .title = "Two blocks stacked, the lower one pulled",
     .setup = "A block of 1 kg lies on one of 2 kg, with friction 0.3 between them and 0.2 on the "
              "floor. The lower one is pulled from rest with a constant force: 10 N, 20 N, and 1 % "
              "below and above the force at which the upper one stays behind (in space along 37 "
              "degrees).",
     .reference = {"M = m_1 + m_2", "together for F ≤ (μ_1 + μ_2) M g = 14.715 N",
                   "a = frac{F − μ_2 M g}{M}", "else a_1 = μ_1 g",
                   "a_2 = frac{F − μ_1 m_1 g − μ_2 M g}{m_2}"},
     .compared = "Velocities and ways of both at every step.",
     .kind = Class::S,
     .why = "All forces are constant and the step is exact; the impulses of the two contacts in "
            "series come from the iteration of the solver.",
     .source = "Elementary.",
     .catches = {Fault::friction_off, Fault::reaction_lost, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace A15
}  // namespace validation
