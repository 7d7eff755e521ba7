// SPDX-License-Identifier: BSL-1.0
//
// A box on an incline of 20 degrees: it holds if the friction coefficient is above tan 20 = 0.36397
// and slides with acceleration g (sin - mu cos) below, exactly, whatever the step size. The
// one-step equilibrium test gives the same verdict without any motion.
//
// Sample run:  examples/run 02_block_on_incline
#include <talus/talus.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

template <int Dim>
void block_on_incline(double mu) {
    using namespace talus;
    const double slope = 20.0 * std::numbers::pi / 180.0, g = 9.81;
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    Vector<Dim> half = Vector<Dim>::Constant(0.2);
    half[Dim - 1] = 0.1;

    Simulation<Dim> sim({Coulomb<Dim>{mu}}, {.h = 1e-2});
    sim.solver().params.tolerance = 1e-12;
    auto& system = sim.system();
    system.gravity = -g * std::cos(slope) * up;  // axes along the incline
    system.gravity[0] = g * std::sin(slope);
    system.add_obstacle(HalfSpace<Dim>(up, 0.0));
    system.add(Box<Dim>(half), 1000.0, {half[Dim - 1] * up, {}});

    const auto test = equilibrium(system);
    const RunSummary run = sim.run(1.0);
    if (!run.certified()) std::printf("%s\n", to_string(run).c_str());
    std::printf("%dD, mu = %.3f: %s; after 1 s the speed is %.9f m/s, exact %.9f\n", Dim, mu,
                to_string(test.verdict).data(), system.bodies.velocity[1][0],
                std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope))));
}

int main() {
    for (double mu : {0.368, 0.360}) {
        block_on_incline<2>(mu);
        block_on_incline<3>(mu);
    }
}
