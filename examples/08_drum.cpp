// SPDX-License-Identifier: BSL-1.0
//
// A drum, filled by a third, turns slowly: the surface of the grains leans until they flow. A drum
// is a RoundHole, which has no seams; in space half-spaces, which turn with it, close its ends.
#include <talus/feed/inlet.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

template <int Dim>
void drum() {
    using V = talus::Vector<Dim>;
    const double radius = 0.1, grain = 0.006, turns = 0.3;  // [m], [m], [1/s]
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{.mu = 0.5}},
                               {.h = 1e-3, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * V::Unit(Dim - 1);
    talus::AngularVector<Dim> spin = talus::AngularVector<Dim>::Zero();
    spin[Dim == 2 ? 0 : 1] = (Dim == 2 ? 1.0 : -1.0) * 2.0 * std::numbers::pi * turns;
    const auto turning = talus::PrescribedMotion<Dim>::uniform({}, {V::Zero(), spin});
    if constexpr (Dim == 2) {
        system.add_obstacle(talus::RoundHole<2>(radius), turning);
    } else {
        system.add_obstacle(talus::RoundHole<3>(radius, V::Unit(1)), turning);
        system.add_obstacle(talus::HalfSpace<3>(V::Unit(1), -2.0 * grain), turning);
        system.add_obstacle(talus::HalfSpace<3>(-V::Unit(1), -2.0 * grain), turning);
    }
    talus::Inlet<Dim> inlet({.place = talus::at_point<Dim>(V(0.06 * V::Unit(Dim - 1))),
                             .shape = talus::balls<Dim>(talus::UniformRadii(0.8 * grain, grain)),
                             .rate = 200.0,
                             .total = 70,
                             .velocity = -1.0 * V::Unit(Dim - 1)});
    double lean = 0.0, times = 0.0;  // of the way from the drum's axis to the grains' mass centre
    const talus::RunSummary run = sim.run(1.2, [&](auto&) {
        inlet.feed(system, sim.time());
        if (sim.time() < 0.9) return;
        V centre = V::Zero();
        for (std::size_t i = 0; i < system.bodies.count(); ++i)
            if (!system.bodies.is_obstacle(i))
                centre += system.bodies.mass(i) * system.bodies.position[i];
        lean += std::atan2(centre[0], -centre[Dim - 1]);
        times += 1.0;
    });
    std::printf("%dD: the surface leans by %.1f degrees; %s\n", Dim,
                lean / times * 180.0 / std::numbers::pi,
                run.certified() ? "certified" : to_string(run).c_str());
}

int main() {
    drum<2>();
    drum<3>();
}
