// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/convex_polytope.hpp>
#include <talus/io/scene_file.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random_scene.hpp>
#include <talus/stepping/gap_correction.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "../random_grain.hpp"
#include "chosen_solver.hpp"
#include "job.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "recorder.hpp"
#include "stop_request.hpp"

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
    using Solver = ChosenSolver<Dim>;
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
    Pile<Dim> sim({{o.mu.value_or(scene.mu)}, o.restitution, 0.0}, params,
                  ChosenSolver<Dim>(o.solver, {o.tolerance, static_cast<int>(o.max_sweeps)}));
    sim.gap_correction().params.fraction = o.correction;

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

template <int Dim>
class Settling final : public Job {
  public:
    explicit Settling(const Options& o)
        : options_(o), scene_(make_scene<Dim>(o)), sim_(make_simulation(scene_, o)) {}

    std::string title() const override {
        using talus::detail::text_of;
        return std::to_string(Dim) + "D: " + std::to_string(scene_.grains.size()) + " grains, mu " +
               text_of(options_.mu.value_or(scene_.mu)) + ", h = " + text_of(options_.step) +
               " s, " + text_of(options_.duration) + " s to settle";
    }

    Figures run() override {
        Figures start;
        start.scene = options_.scene;
        start.solver = options_.solver;
        start.tolerance = options_.tolerance;
        start.h = options_.step;
        start.mean_radius = scene_.mean_radius;
        Recorder<Dim> recorder(sim_.system(), start);
        Progress progress(std::to_string(Dim) + "D");
        const double all_steps = std::round(options_.duration / options_.step);
        std::string failure;
        try {
            const auto watch = [&](const auto& sim) {
                recorder.record(sim);
                if (!options_.quiet)
                    show(progress, static_cast<double>(sim.step_count()) / all_steps,
                         recorder.last());
                return StopRequest::signal() == 0;
            };
            // The recorder keeps a summary of its own, which an error leaves as it was.
            static_cast<void>(sim_.run(options_.duration, watch));
        } catch (const std::exception& error) {
            if (recorder.empty()) throw;
            failure = talus::detail::printable(error.what());
        }
        Figures figures = recorder.figures();
        figures.seconds = progress.seconds();
        figures.failure = failure;
        figures.stopped = static_cast<double>(figures.steps.size()) < all_steps && failure.empty();
        return figures;
    }

    std::vector<std::string> write_pictures(double mean_grain_weight) const override {
        return pile::write_pictures(sim_, scene_, mean_grain_weight,
                                    picture_files(options_.out, Dim));
    }

  private:
    static void show(Progress& progress, double done, const StepFigures& last) {
        if (!progress.due(done)) return;
        char remark[100];
        std::snprintf(remark, sizeof remark, "%zu contacts, %d sweeps, residual %.0e",
                      last.contacts, last.sweeps, last.residual);
        progress.show(done, remark);
    }

    Options options_;
    talus::Scene<Dim> scene_;
    Pile<Dim> sim_;
};

}  // namespace pile
