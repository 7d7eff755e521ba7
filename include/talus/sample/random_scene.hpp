// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/lattice.hpp>
#include <talus/sample/scene.hpp>

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace talus {

/// What a random scene is made of, apart from the law of radii and the shapes.
struct RandomSceneParams {
    std::size_t grain_count = 250;
    double width = 0.2;       ///< every horizontal side of the box [m]
    double mu = 0.4;          ///< friction coefficient [-]; glass on glass, roughly
    double density = 2600.0;  ///< [kg/m^Dim]; quartz, in space
    double gravity = 9.81;    ///< [m/s^2]
    double looseness = 0.05;  ///< see LatticeParams
    std::uint64_t seed = 1;
};

/// Scene of grains on a loose lattice. `vertices(random, radius)` gives the corners of a grain
/// about its centroid, none for a ball, and none farther than `radius`.
template <int Dim, RadiusLaw Law, class Vertices>
requires std::is_invocable_r_v < std::vector<Vector<Dim>>,
const Vertices&, Random&,
    double > Scene<Dim> random_scene(const RandomSceneParams& params, const Law& law,
                                     const Vertices& vertices) {
    Random random(params.seed);
    Scene<Dim> scene;
    scene.box_size.template head<Dim - 1>().setConstant(
        require_positive("width of the box [m]", params.width));
    scene.mu = require_non_negative("friction coefficient", params.mu);
    scene.density = require_positive("density", params.density);
    scene.gravity = require_non_negative("gravity [m/s^2]", params.gravity);
    const auto places = jittered_lattice<Dim>(random, {.count = params.grain_count,
                                                       .box_size = scene.box_size,
                                                       .largest_radius = law.high_end(),
                                                       .looseness = params.looseness});
    scene.grains.reserve(places.size());
    for (const auto& place : places) {
        const double radius = law(random);
        scene.grains.push_back({place, radius, vertices(random, radius)});
    }
    scene.mean_radius = law.mean();
    if (scene.grains.empty()) return scene;
    // Few grains of a broad law may all be smaller, or larger, than its mean.
    const auto [least, most] = std::ranges::minmax_element(scene.grains, {}, &Grain<Dim>::radius);
    scene.mean_radius = std::clamp(scene.mean_radius, least->radius, most->radius);
    return scene;
}

/// Scene of balls: discs in the plane, spheres in space.
template <int Dim, RadiusLaw Law>
Scene<Dim> random_scene(const RandomSceneParams& params, const Law& law) {
    return random_scene<Dim>(params, law,
                             [](Random&, double) { return std::vector<Vector<Dim>>(); });
}

}  // namespace talus
