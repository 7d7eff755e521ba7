// SPDX-License-Identifier: BSL-1.0
//
// A block on a table that shakes harder and harder: it slips once the acceleration is beyond mu g,
// so that the table's largest one before tells the friction coefficient.
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>

template <int Dim>
void shaking_table() {
    using V = talus::Vector<Dim>;
    const double mu = 0.35, g = 9.81, omega = 20.0, growth = 1.0;  // [-], [m/s^2], [1/s], [m/s^3]
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{mu}}, {.h = 2e-4});
    auto& system = sim.system();
    system.gravity = -g * V::Unit(Dim - 1);
    V half = V::Constant(0.5), block = V::Constant(0.05);
    half[Dim - 1] = 0.05;
    const auto table = system.add_obstacle(
        talus::Box<Dim>(half), talus::PrescribedMotion<Dim>::of_pose([=](double t) {
            const double amplitude = growth * t / (omega * omega);
            return talus::Pose<Dim>{V(amplitude * std::sin(omega * t) * V::Unit(0)), {}};
        }));
    const auto body = system.add(talus::Box<Dim>(block), 2000.0, {V(0.1 * V::Unit(Dim - 1)), {}});
    double slipped_at = 0.0;
    const talus::RunSummary run = sim.run(10.0, [&](const auto&) {
        const V way = system.bodies.position[body] - system.bodies.position[table];
        if (std::abs(way[0]) > 1e-4) slipped_at = sim.time();
        return slipped_at == 0.0;
    });
    std::printf("%dD: slips at %.2f s, where the table reaches %.3f g; mu is %.3f; %s\n", Dim,
                slipped_at, growth * slipped_at / g, mu,
                run.certified() ? "certified" : to_string(run).c_str());
}

int main() {
    shaking_table<2>();
    shaking_table<3>();
}
