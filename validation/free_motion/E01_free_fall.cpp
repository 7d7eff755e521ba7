// SPDX-License-Identifier: BSL-1.0
#include "harness/case.hpp"

namespace validation {
namespace E01 {

constexpr double h = 0.37;
constexpr int steps = 100;

template <int Dim>
void run(Trial<Dim>& trial) {
    V<Dim> launch = in_plane<Dim>(3.0, 4.0);
    W<Dim> spin = rolling_spin<Dim>(2.0);
    if constexpr (Dim == 3) {
        launch = {3.0, 4.0, 1.0};
        spin = 2.0 * V<3>(1.0, -2.0, 2.0) / 3.0;
    }
    auto world = trial.world({.h = h});
    world.add(talus::Ball<Dim>(0.5), round_inertia<Dim>(2.0, 0.5), {}, {launch, spin});
    Worst velocity, place, turn, rate;
    Series seen{"measured", {0.0}, {0.0}}, exact{"exact", {}, {}, true};
    for (int k = 1; k <= steps; ++k) {
        world.step();
        const double t = k * h;
        const auto& bodies = world.bodies();
        velocity.see(bodies.velocity[0], V<Dim>(launch - g * t * up<Dim>()));
        place.see(bodies.position[0], V<Dim>(t * launch - g * t * t / 2 * up<Dim>()));
        turn.see(bodies.rotation[0].distance(talus::Rotation<Dim>::exp(t * spin)), 0.0);
        rate.see(bodies.twist(0).angular, spin);
        seen.x.push_back(t), seen.y.push_back(bodies.position[0][Dim - 1]);
    }
    for (const double t : seen.x)
        exact.x.push_back(t), exact.y.push_back(t * launch[Dim - 1] - g * t * t / 2);
    // Velocities to 360 m/s, ways to 6.6 km, angles to 74 rad; 100 steps.
    trial.rounding("velocity", velocity, 400.0, h);
    trial.rounding("place", place, 7000.0, h);
    trial.rounding("orientation", turn, 74.0, h);
    trial.rounding("spin", rate, 2.0, h);
    trial.curves({"height", "t [s]", "z [m]", {seen, exact}});
}

const Register e01(
    {.id = "E01",
     .name = "free-fall",
     .title = "A thrown ball",
     .gate = 1,
     .setup = "A homogeneous disc (a sphere in space) is thrown at (3, 4) m/s in the plane, at (3, "
              "4, 1) m/s in space, spinning at 2 rad/s (in space about a skew axis), and falls for "
              "100 steps of 0.37 s.",
     .reference = {"v = v_0 − g t", "x = v_0 t − frac{g t^2}{2}", "turned by the angle ω t"},
     .compared = "Velocity, place, orientation and spin at every step.",
     .kind = Class::R,
     .why = "The force is constant and the spin too: the midpoint rule and the exponential map "
            "are exact.",
     .source = "Galilei 1638.",
     .catches = {Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace E01
}  // namespace validation
