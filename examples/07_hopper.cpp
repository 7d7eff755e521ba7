// SPDX-License-Identifier: BSL-1.0
//
// A hopper that runs: grains rain in, leave through the outlet, and are used again. The same text
// in the plane and in space, where two walls in front and behind close it.
#include <talus/feed/inlet.hpp>
#include <talus/feed/sink.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>

template <int Dim>
void hopper() {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1), x = V::Unit(0);
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{.mu = 0.3}},
                               {.h = 1e-3, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * up;
    for (const double side : {-1.0, 1.0}) {
        system.add_obstacle(talus::HalfSpace<Dim>(side * x, -0.15));
        // The planks lean by 45 degrees and leave 6 cm between them.
        V half = V::Constant(0.2);
        half[Dim - 1] = 0.01;
        talus::AngularVector<Dim> turn = talus::AngularVector<Dim>::Zero();
        turn[Dim == 2 ? 0 : 1] = (Dim == 2 ? 1.0 : -1.0) * side * std::atan(1.0);
        const V middle = side * (0.03 + 0.21 * std::sqrt(0.5)) * x + 0.19 * std::sqrt(0.5) * up;
        system.add_obstacle(talus::Box<Dim>(half), {{middle, talus::Rotation<Dim>::exp(turn)}});
        if (Dim == 3) system.add_obstacle(talus::HalfSpace<Dim>(side * V::Unit(1), -0.03));
    }
    V low = V::Constant(-0.02), high = V::Constant(0.02);
    low[0] = -0.13, high[0] = 0.13, low[Dim - 1] = high[Dim - 1] = 0.5;
    talus::Inlet<Dim> inlet({.place = talus::in_box<Dim>(low, high),
                             .shape = talus::balls<Dim>(talus::UniformRadii(0.006, 0.008)),
                             .rate = 300.0,
                             .total = 150});
    auto sink = talus::Sink<Dim>::below(up, -0.2);
    const talus::RunSummary run = sim.run(1.5, [&](auto&) {
        inlet.feed(system, sim.time());
        inlet.owe(sink.drain(system));
    });
    std::printf("%dD: %lld grains came, %lld left; %s\n", Dim,
                static_cast<long long>(inlet.count()), static_cast<long long>(sink.count()),
                run.certified() ? "certified" : to_string(run).c_str());
}

int main() {
    hopper<2>();
    hopper<3>();
}
