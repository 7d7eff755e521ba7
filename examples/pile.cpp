// SPDX-License-Identifier: BSL-1.0
//
// The main job: grains settle under gravity in a box, in the plane or in space, from one text. At
// the end comes a certificate of the answer, and pictures in the manner of Moreau: grains grey by
// their load, force chains as segments as wide as the force.
//
// Sample runs:  examples/run
//               examples/run pile --dim 3 --shape polyhedron --count 200
//               examples/run pile --scene examples/scenes/discs.txt --json certificate.json
#include <talus/geometry/convex_polytope.hpp>
#include <talus/io/scene_file.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random_scene.hpp>
#include <talus/stepping/gap_correction.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "pile_certificate.hpp"
#include "pile_options.hpp"
#include "pile_pictures.hpp"
#include "progress.hpp"

namespace pile {

/// A box some grains wide, so that the pile will be about as high as wide.
template <int Dim>
double box_width(std::size_t count, double radius) {
    const double grains_per_side = std::pow(static_cast<double>(count), 1.0 / Dim);
    return 2.0 * radius * std::max(3.0, 1.15 * grains_per_side);
}

template <int Dim>
talus::Scene<Dim> make_scene(const Options& o) {
    if (!o.scene.empty()) return talus::read_scene<Dim>(o.scene);
    const talus::UniformRadii radii(0.004, 0.006);  // [m], as in the common scenes
    talus::RandomSceneParams params;
    params.grain_count = static_cast<std::size_t>(o.count);
    params.width = box_width<Dim>(params.grain_count, radii.mean());
    params.seed = static_cast<std::uint64_t>(o.seed);
    if (o.shape == "polygon" || o.shape == "polyhedron" || (o.shape.empty() && Dim == 2))
        return talus::random_scene<Dim>(params, radii, RandomGrain<Dim>());
    return talus::random_scene<Dim>(params, radii);
}

template <int Dim>
struct PileTypes : talus::SimulationTypes<Dim> {
    using GapCorrection = talus::GapCorrection<Dim>;
};
template <int Dim>
using Pile = talus::Simulation<Dim, PileTypes<Dim>>;

template <int Dim>
Pile<Dim> make_simulation(const talus::Scene<Dim>& scene, const Options& o) {
    using namespace talus;
    SimulationParams params;
    params.h = o.step;
    params.step.scheme = o.scheme == "midpoint" ? Scheme::midpoint : Scheme::gap_anticipating;
    params.step.gyroscopic = Gyroscopic::momentum_preserving;
    Pile<Dim> sim({{o.mu.value_or(scene.mu)}, o.restitution, 0.0}, params);
    sim.gap_correction().params.fraction = o.correction;
    sim.solver().params.tolerance = o.tolerance;
    sim.solver().params.max_sweeps = static_cast<int>(o.max_sweeps);

    auto& system = sim.system();
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    system.gravity = -scene.gravity * up;
    system.add_obstacle(HalfSpace<Dim>(up, 0.0));
    for (int axis = 0; axis + 1 < Dim; ++axis) {
        system.add_obstacle(HalfSpace<Dim>(Vector<Dim>::Unit(axis), 0.0));
        system.add_obstacle(HalfSpace<Dim>(-Vector<Dim>::Unit(axis), -scene.box_size[axis]));
    }
    for (const Grain<Dim>& grain : scene.grains) {
        const Pose<Dim> pose{grain.position, {}};
        if (grain.is_ball())
            system.add(Ball<Dim>{grain.radius}, scene.density, pose);
        else
            system.add(ConvexPolytope<Dim>(grain.vertices), scene.density, pose);
    }
    return sim;
}

/// Settles one pile; returns its certificate.
template <int Dim>
nlohmann::json settle(const Options& o) {
    const auto scene = make_scene<Dim>(o);
    auto sim = make_simulation(scene, o);
    std::printf("%dD: %zu grains, mu %g, h = %g s, %g s to settle\n", Dim, scene.grains.size(),
                o.mu.value_or(scene.mu), o.step, o.duration);
    Certificate<Dim> certificate(sim, o.tolerance, scene.mean_radius);
    Progress progress(std::to_string(Dim) + "D");
    const talus::RunSummary run = sim.run(o.duration, [&](const auto& s) {
        certificate.record(s);
        if (o.quiet) return;
        char remark[100];
        std::snprintf(remark, sizeof remark, "%zu contacts, %d sweeps, residual %.0e",
                      certificate.last().contacts, certificate.last().sweeps,
                      certificate.last().residual);
        progress.show(s.time() / o.duration, remark);
    });
    if (run.steps == 0)
        throw talus::input_error("--duration is less than half of --step, but must hold a step");
    const double seconds = progress.seconds();
    std::printf("Certificate\n%s", certificate.text(seconds).c_str());
    for (const auto& file : write_pictures(sim, scene, certificate.mean_grain_weight(), o.out))
        std::printf("  wrote %s\n", file.c_str());
    auto json = certificate.json();
    json["seconds"] = seconds;
    json["step_s"] = o.step;
    json["scene"] = o.scene;
    return json;
}

void run(const Options& o) {
    nlohmann::json all = nlohmann::json::array();
    int dim = o.dim;
    if (!o.scene.empty()) {
        dim = talus::scene_dimension(o.scene);
        if (o.dim != 0 && o.dim != dim)
            throw talus::input_error("--dim is " + std::to_string(o.dim) + ", but " + o.scene +
                                     " is a scene of dimension " + std::to_string(dim));
    } else if (dim == 0 && !o.shape.empty()) {
        dim = o.shape == "disc" || o.shape == "polygon" ? 2 : 3;
    }
    if (dim != 3) all.push_back(settle<2>(o));
    if (dim != 2) all.push_back(settle<3>(o));
    if (!o.json.empty()) {
        talus::write_file(o.json, all.dump(1) + "\n");
        std::printf("  wrote %s\n", o.json.c_str());
    }
}

}  // namespace pile

int main(int argc, char** argv) {
    try {
        if (const auto options = pile::read_options(argc, argv)) pile::run(*options);
        return 0;
    } catch (const talus::input_error& error) {
        std::fprintf(stderr, "pile: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pile: %s\n", error.what());
        return 1;
    }
}
