// SPDX-License-Identifier: BSL-1.0
//
// Round grains fall on a plate and off its edges: what stays is steeper the harder they roll.
#include <talus/law/rolling_coulomb.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

template <int Dim>
struct Types : talus::SimulationTypes<Dim> {
    using Law = talus::RollingFriction<Dim>;
};

template <int Dim>
void heap(double mu_r) {
    using V = talus::Vector<Dim>;
    const double radius = 0.005, pitch = 2.2 * radius, plate = 0.06;  // [m]
    talus::SimulationParams params{.h = 1e-3};
    params.step.scheme = talus::Scheme::gap_anticipating;
    talus::Simulation<Dim, Types<Dim>> sim({.mu = 0.5, .mu_r = mu_r}, params);
    auto& system = sim.system();
    const V up = V::Unit(Dim - 1);
    system.gravity = -9.81 * up;
    V half = V::Constant(plate);
    half[Dim - 1] = radius;
    system.add_obstacle(talus::Box<Dim>(half), talus::Pose<Dim>{V(-radius * up), {}});
    constexpr int wide = Dim == 2 ? 7 : 4, layer = Dim == 2 ? wide : wide * wide, layers = 9;
    const auto place = [&](int k) { return pitch * (k % wide - 0.5 * (wide - 1)); };
    for (int k = 0; k < layers * layer; ++k) {
        // No grain stands on the one below.
        V x = (place(k) + 0.3 * radius * std::sin(7.0 * k)) * V::Unit(0);
        if constexpr (Dim == 3) x[1] = place(k / wide) + 0.3 * radius * std::cos(5.0 * k);
        x[Dim - 1] = pitch * (k / layer + 1);
        system.add(talus::Ball<Dim>{radius * (0.9 + 0.1 * std::sin(3.0 * k))}, 2500.0, {x, {}});
    }
    const talus::RunSummary run = sim.run(1.0, [&](const auto&) {
        system.remove_if(
            [&](std::size_t i) { return system.bodies.position[i][Dim - 1] < -plate; });
    });
    // Height over half the width, of a triangle and of a cone with these means.
    const double shape = Dim == 2 ? 1.0 : 8.0 / 3.0;
    double height = 0.0, distance = 0.0;
    for (std::size_t i = 1; i < system.bodies.count(); ++i) {
        const V& x = system.bodies.position[i];
        height += x[Dim - 1];
        distance += V(x - x[Dim - 1] * up).norm();
    }
    std::printf("%dD, mu_r = %.2f: %3zu of %d grains stay, at %2.0f degrees; %s\n", Dim, mu_r,
                system.bodies.count() - 1, layers * layer,
                180.0 / std::numbers::pi * std::atan2(shape * height, distance),
                run.certified() ? "certified" : to_string(run).c_str());
}

int main() {
    for (const double mu_r : {0.0, 0.05, 0.1, 0.2}) heap<2>(mu_r);
    for (const double mu_r : {0.0, 0.1}) heap<3>(mu_r);
}
