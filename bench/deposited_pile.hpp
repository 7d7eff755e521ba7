// SPDX-License-Identifier: BSL-1.0
//
// Piles of balls that talus deposits itself, for benches.
#pragma once

#include <talus/sample/granulometry.hpp>
#include <talus/sample/random_scene.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "bench_problem.hpp"

namespace bench {

constexpr double step_length = 1e-3;  // h [s]

/// Simulations with the law of the benches.
template <int Dim>
struct Types : talus::SimulationTypes<Dim> {
    using Law = bench::Law<Dim>;
    using Solver = talus::GaussSeidel<Dim, Law>;
};

template <int Dim>
using Vec = talus::Vector<Dim>;
template <int Dim>
using World = talus::System<Dim, Law<Dim>>;

/// A pose without rotation.
template <int Dim>
talus::Pose<Dim> at(const Vec<Dim>& position) {
    return {position, {}};
}

/// A world with a floor at height 0; the last axis points up.
template <int Dim>
World<Dim> world_with_floor(double mu) {
    World<Dim> world(Law<Dim>{mu});
    world.add_obstacle(talus::HalfSpace<Dim>(Vec<Dim>::Unit(Dim - 1), 0.0));
    return world;
}

/// Balls of a scene where they are, in its box, with or without the wall on the right.
template <int Dim>
World<Dim> boxed(const talus::Scene<Dim>& scene, bool right_wall) {
    World<Dim> world = world_with_floor<Dim>(scene.mu);
    for (int axis = 0; axis + 1 < Dim; ++axis) {
        const Vec<Dim> inward = Vec<Dim>::Unit(axis);
        world.add_obstacle(talus::HalfSpace<Dim>(inward, 0.0));
        if (right_wall || axis > 0)
            world.add_obstacle(talus::HalfSpace<Dim>(-inward, -scene.box_size[axis]));
    }
    for (const auto& grain : scene.grains)
        world.add(talus::Ball<Dim>{grain.radius}, scene.density, at<Dim>(grain.position));
    world.gravity = -scene.gravity * Vec<Dim>::Unit(Dim - 1);
    return world;
}

/// A pile about as high as wide, settled by talus; made once per size and seed.
template <int Dim>
const talus::Scene<Dim>& settled_scene(std::size_t contacts, std::uint64_t seed) {
    static std::map<std::pair<std::size_t, std::uint64_t>, talus::Scene<Dim>> known;
    const auto [place, is_new] = known.try_emplace({contacts, seed});
    talus::Scene<Dim>& scene = place->second;
    if (!is_new) return scene;
    const talus::UniformRadii radii(0.004, 0.006);
    talus::RandomSceneParams params;
    params.grain_count = std::max<std::size_t>(contacts / Dim, 4);
    params.width =
        2.2 * radii.mean() * std::pow(static_cast<double>(params.grain_count), 1.0 / Dim);
    params.looseness = 0.01;
    params.seed = seed;
    scene = talus::random_scene<Dim>(params, radii);
    talus::SimulationParams settings;
    settings.h = step_length;
    settings.step.scheme = talus::Scheme::gap_anticipating;
    talus::Simulation<Dim, Types<Dim>> sim(boxed(scene, true), settings);
    sim.solver().params.tolerance = 1e-3;
    sim.solver().params.max_sweeps = 200;
    const double rest = 1e-3 * std::sqrt(scene.gravity * params.width);  // [m/s]
    static_cast<void>(sim.run(0.5, [&](const auto& now) {
        const auto& bodies = now.system().bodies;
        double speed = 0.0;
        for (const auto& v : bodies.velocity) speed += v.norm();
        return now.time() < 0.05 || speed > rest * static_cast<double>(bodies.count());
    }));
    const auto& position = sim.system().bodies.position;
    const std::size_t obstacles = position.size() - scene.grains.size();
    for (std::size_t i = 0; i < scene.grains.size(); ++i)
        scene.grains[i].position = position[obstacles + i];
    return scene;
}

/// The pile of `settled_scene`, brought to rest with a fifth less friction than its problem will
/// have, so that the forces of rest lie inside the cones and nothing need slip; made once per size
/// and seed. What keeps that one moving is the error of its steps, 1e-3, and balls that roll about:
/// steps go on with an error of 1e-6, and each takes 3 % of all velocities away. (Taking half of
/// them makes loose balls roll at less than a thousandth of a diameter per step, and rest farther
/// away.) Ends at a root mean square speed of 1e-5 g h, or after 1.5 s.
template <int Dim>
const talus::Scene<Dim>& resting_scene(std::size_t contacts, std::uint64_t seed) {
    static std::map<std::pair<std::size_t, std::uint64_t>, talus::Scene<Dim>> known;
    const auto [place, is_new] = known.try_emplace({contacts, seed});
    talus::Scene<Dim>& scene = place->second;
    if (!is_new) return scene;
    scene = settled_scene<Dim>(contacts, seed);
    talus::SimulationParams settings;
    settings.h = step_length;
    settings.step.scheme = talus::Scheme::gap_anticipating;
    talus::Scene<Dim> slippery = scene;
    slippery.mu *= 0.8;
    talus::Simulation<Dim, Types<Dim>> sim(boxed(slippery, true), settings);
    sim.solver().params.tolerance = 1e-6;
    sim.solver().params.max_sweeps = 100;
    constexpr double kept = 0.97;
    const double rest = 1e-5 * scene.gravity * step_length;  // [m/s]
    auto& bodies = sim.system().bodies;
    static_cast<void>(sim.run(1.5, [&](const auto&) {
        double square = 0.0;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            square += bodies.velocity[i].squaredNorm();
            bodies.velocity[i] *= kept;
            bodies.spin[i] *= kept;
        }
        return square > rest * rest * static_cast<double>(bodies.count());
    }));
    const std::size_t obstacles = bodies.position.size() - scene.grains.size();
    for (std::size_t i = 0; i < scene.grains.size(); ++i)
        scene.grains[i].position = bodies.position[obstacles + i];
    return scene;
}

}  // namespace bench
