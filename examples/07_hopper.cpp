// SPDX-License-Identifier: BSL-1.0
//
// A hopper that runs: grains rain in, leave through the outlet, and are used again. The same text
// in the plane and in space, where two walls in front and behind close it.
#include <talus/feed/inlet.hpp>
#include <talus/feed/sink.hpp>
#include <talus/sample/vessels.hpp>
#include <talus/stepping/simulation.hpp>

#include <cstdio>

template <int Dim>
void hopper() {
    const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{.mu = 0.3}},
                               {.h = 1e-3, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * up;
    for (const auto& wall : talus::hopper<Dim>({.opening = 0.06, .width = 0.3, .depth = 0.06}))
        system.add_obstacle(wall.shape, wall.pose);
    talus::Inlet<Dim> inlet({.place = talus::in_disc<Dim>(0.5 * up, Dim == 2 ? 0.13 : 0.02, up),
                             .shape = talus::balls<Dim>(talus::UniformRadii(0.006, 0.008)),
                             .rate = Dim == 2 ? 300.0 : 100.0,
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
