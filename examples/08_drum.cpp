// SPDX-License-Identifier: BSL-1.0
//
// A drum, filled by a third, turns slowly: the surface of the grains leans until they flow. A drum
// is a RoundHole, which has no seams; in space half-spaces, which turn with it, close its ends.
#include <talus/feed/inlet.hpp>
#include <talus/sample/vessels.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

template <int Dim>
void drum() {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{.mu = 0.5}},
                               {.h = 1e-3, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * up;
    for (const auto& wall : talus::drum<Dim>(0.1, 0.024))
        system.add_obstacle(wall.shape, talus::PrescribedMotion<Dim>::uniform(
                                            wall.pose, talus::drum_twist<Dim>(0.3)));
    talus::Inlet<Dim> inlet({.place = talus::at_point<Dim>(V(0.06 * up)),
                             .shape = talus::balls<Dim>(talus::UniformRadii(0.0048, 0.006)),
                             .rate = 200.0,
                             .total = 70,
                             .velocity = -up});
    V lean = V::Zero();  // from the drum's axis to the grains, while they flow
    const talus::RunSummary run = sim.run(1.2, [&](auto&) {
        inlet.feed(system, sim.time());
        for (std::size_t i = 0; sim.time() > 0.9 && i < system.bodies.count(); ++i)
            if (!system.bodies.is_obstacle(i)) lean += system.bodies.position[i];
    });
    std::printf("%dD: the surface leans by %.1f degrees; %s\n", Dim,
                std::atan2(lean[0], -lean[Dim - 1]) * 180.0 / std::numbers::pi,
                run.certified() ? "certified" : to_string(run).c_str());
}

int main() {
    drum<2>();
    drum<3>();
}
