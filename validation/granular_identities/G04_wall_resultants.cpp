// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/momentum.hpp>

#include "box_of_balls.hpp"

namespace validation {
namespace G04 {

/// Force and moment about the origin that floor and walls give to the balls at these places.
template <int Dim>
talus::Wrench<Dim> from_walls(const Trial<Dim>& trial, const talus::Bodies<Dim>& bodies,
                              const StepData<Dim>& data) {
    const auto forces = measured_forces<Dim>(trial, data);
    talus::Wrench<Dim> sum;
    for (std::size_t c = 0; c < forces.size(); ++c) {
        const auto a = static_cast<std::size_t>(data.problem.jacobian.a[c]);
        if (BoxOfBalls<Dim>::is_ball(a)) continue;  // between balls
        // A force acts where its arm ends.
        const V<Dim> place =
            bodies.position[data.problem.jacobian.b[c]] + data.problem.jacobian.arm_b[c];
        sum += talus::Wrench<Dim>::at(place, -forces[c]);
    }
    return sum;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const BoxOfBalls<Dim> box{Dim == 2 ? 6 : 3, Dim == 2 ? 6 : 4};
    const double weight = box.count() * box.mass * g;
    auto falling = box.make(trial, settling_params<Dim>(0.5));
    falling.system().forces.push_back(drag<Dim>(drag_rate));
    Worst momentum;
    V<Dim> before = V<Dim>::Zero();
    Series vertical{"force of floor and walls / weight", {}, {}};
    falling.run(settling_time, [&](const World<Dim>& w) {
        const double h = w.params().h;
        const V<Dim> walls = from_walls<Dim>(trial, w.bodies(), w.data()).force;
        V<Dim> others = -weight * up<Dim>();
        for (const auto& wrench : w.data().applied) others += wrench.force;
        const V<Dim> after = talus::momentum<Dim>(w.bodies()).linear;
        momentum.see(V<Dim>((after - before) / h), V<Dim>(walls + others));
        before = after;
        vertical.x.push_back(w.time());
        vertical.y.push_back(walls[Dim - 1] / weight);
    });
    // Forces at impact reach weight x (speed of fall / g h), a thousand weights, over 36 bodies.
    trial.rounding("rate of momentum = walls + weight + drag, worst step [N]", momentum,
                   1e3 * weight);
    trial.curves({"force of floor and walls",
                  "t [s]",
                  "force / weight",
                  {vertical, {"at rest", {0.0, settling_time}, {1.0, 1.0}, true}}});

    const double tolerance = 1e-10;
    auto world = box.make(trial, resting_params<Dim>(0.5, tolerance));
    copy_places<Dim>(falling, world);
    const auto report = world.equilibrium(falling.impulse_cache());
    trial.holds("the heap is at rest", report.verdict == talus::Verdict::equilibrium ||
                                           report.speed < 1e-4 * report.load_speed);
    const auto walls = from_walls<Dim>(trial, world.bodies(), report.data);
    talus::Wrench<Dim> expected;
    for (std::size_t i = BoxOfBalls<Dim>::walls; i < world.bodies().count(); ++i)
        expected += talus::Wrench<Dim>::at(world.bodies().position[i], box.mass * g * up<Dim>());
    // What the solver leaves on each of the bodies adds up.
    const double scale = weight * box.count();
    trial.solver("force of floor and walls at rest [N]", V<Dim>(walls.force),
                 V<Dim>(expected.force), scale, tolerance);
    trial.solver("moment of floor and walls at rest [N m]", W<Dim>(walls.torque),
                 W<Dim>(expected.torque), scale, tolerance);
}

const Register g04(
    {.id = "G04",
     .name = "wall-resultants",
     .title = "Walls carry the weight",
     .gate = 2,
     .setup = "36 discs (spheres) with friction 0.5 fall into a box and come to rest in thick air.",
     .reference = {"in motion: Σ walls + weight + drag = frac{Δ momentum}{h}, in every step",
                   "at rest: Σ vertical = W, Σ horizontal = 0, Σ moments = moment of the weights"},
     .compared =
         "The first in every step of the fall, to rounding; the second in a step from rest.",
     .kind = Class::S,
     .why = "The balance of momentum does not depend on the solver at all. At rest the bodies' "
            "remaining acceleration is what the solver left.",
     .source = "Balance of momentum.",
     .catches = {Fault::forces_in_local_axes, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace G04
}  // namespace validation
