// SPDX-License-Identifier: BSL-1.0
#include "sliding_block/block.hpp"

namespace validation {
namespace A01 {

constexpr double slope = 20 * degree;
/// Either side of tan 20 degrees = 0.36397.
constexpr double holding = 0.3650, yielding = 0.3629;

template <int Dim>
World<Dim> incline(Trial<Dim>& trial, double mu, double h) {
    auto world = trial.world({.h = h,
                              .contact = law<Dim>(mu),
                              .gravity = in_plane<Dim>(g * std::sin(slope), -g * std::cos(slope)),
                              // Near the threshold the corners of the box converge slowly.
                              .solver = {.max_sweeps = 20000, .tolerance = 1e-14}});
    world.add_floor();
    return world;
}

/// Runs body 1 from rest for one second and compares every step; the worst of u and x goes to
/// `check(name, worst, scale)`.
template <int Dim, class Check>
void compare(Trial<Dim>& trial, World<Dim> world, double mu, const std::string& what, Check check) {
    const double a = mu > std::tan(slope) ? 0.0 : g * (std::sin(slope) - mu * std::cos(slope));
    const V<Dim> start = world.bodies().position[1];
    Worst u, x;
    Series path{what, {}, {}}, exact{"exact", {}, {}, true};
    world.run(1.0, [&](const auto& w) {
        const double t = w.time();
        u.see(w.bodies().velocity[1], in_plane<Dim>(a * t, 0.0));
        x.see(V<Dim>(w.bodies().position[1] - start), in_plane<Dim>(0.5 * a * t * t, 0.0));
        path.x.push_back(t), path.y.push_back(w.bodies().velocity[1][0]);
        exact.x.push_back(t), exact.y.push_back(a * t);
    });
    const std::string name = what + (mu > std::tan(slope) ? ", mu above tan" : ", mu below tan");
    check("velocity of the " + name, u);
    check("way of the " + name, x);
    if (world.params().h == 1e-2)
        trial.curves({"velocity of the " + name, "t [s]", "u [m/s]", {path, exact}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    trial.within("reference, tan 20 deg", std::tan(slope), 0.3639702, 5e-8, "digits given");
    V<Dim> half = V<Dim>::Constant(0.2);
    half[Dim - 1] = 0.1;
    for (const double h : {1e-2, 1e-3, 1e-4})
        for (const double mu : {holding, yielding}) {
            auto block = incline(trial, mu, h);
            add_block<Dim>(block, 1.0, V<Dim>::Zero(), V<Dim>::Zero());
            // 1/h increments g h add their rounding errors like a random walk at worst: 1/sqrt(h).
            compare<Dim>(trial, std::move(block), mu, "point block",
                         [&](const std::string& label, const Worst& worst) {
                             trial.rounding(label, worst, 1.0 / std::sqrt(h), h);
                         });
            // Many sweeps over many steps: left to the long run.
            if (h < 1e-3 && !trial.full()) continue;
            auto box = incline(trial, mu, h);
            box.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0, half),
                    {half[Dim - 1] * up<Dim>(), {}});
            // Every step may be off by the residual of its g h; 1/h of them add up to g.
            compare<Dim>(trial, std::move(box), mu, "box",
                         [&](const std::string& label, const Worst& worst) {
                             trial.solver(label, worst, g, 1e-14 + 1e-16 / h, h);
                         });
        }
}

const Register a01(
    {.id = "A01",
     .name = "incline-threshold",
     .title = "A block on an incline holds or slides",
     .gate = 1,
     .setup = "A block of 1 kg starts from rest on an incline of 20 degrees: a point block that "
              "touches at one point and does not turn, and a box of 0.4 m by 0.2 m (by 0.4 m) that "
              "stands on its corners. The friction coefficient is 0.3650 or 0.3629, a little more "
              "or less than tan 20° = 0.36397.",
     .reference = {"u = 0 for μ > tan β", "u = g (sin β − μ cos β) t for μ < tan β",
                   "x = frac{u t}{2}"},
     .compared = "Velocity and way during the first second, at every step.",
     .kind = Class::R,
     .why = "Gravity and friction are constant, so the step is exact at every size. The forces on "
            "the corners of the box are not unique and are found by iteration: class S.",
     .source = "Coulomb 1781; any text on mechanics.",
     .catches = {Fault::friction_off, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace A01
}  // namespace validation
