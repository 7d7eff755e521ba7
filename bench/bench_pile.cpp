// SPDX-License-Identifier: BSL-1.0
//
// Whole steps of piles of balls: discs in the plane, spheres in space, 1,000 to 14,000 grains. Each
// pile first settles for 0.3 s; then steps are timed with the default solver and its settings, warm
// (the usual step) and cold (impulses forgotten: a hard solve). Beside the time: contacts, double
// sweeps, contact updates per second of the whole step (two per contact and double sweep), the mean
// and the worst residual, and the bytes that a grain takes in all. Then warm steps of piles of
// spheres that have come to rest, with Gauss-Seidel to residuals from 1e-3 to 1e-6.
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random_scene.hpp>
#include <talus/stepping/simulation.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <malloc.h>
#include <map>
#include <memory>

#include "deposited_pile.hpp"

namespace {

constexpr double h = 1e-3;        // [s]
constexpr double settling = 0.3;  // [s]

std::size_t bytes_in_use() {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

template <int Dim>
struct Pile {
    std::unique_ptr<talus::Simulation<Dim>> sim;
    double bytes_per_grain = 0.0;
};

/// A pile about as high as wide, settled; made once per size.
template <int Dim>
Pile<Dim>& settled_pile(std::int64_t grains) {
    static std::map<std::int64_t, Pile<Dim>> piles;
    Pile<Dim>& pile = piles[grains];
    if (pile.sim) return pile;
    using namespace talus;
    const UniformRadii radii(0.004, 0.006);
    RandomSceneParams params;
    params.grain_count = static_cast<std::size_t>(grains);
    params.width = 2.2 * radii.mean() * std::pow(static_cast<double>(grains), 1.0 / Dim);
    const auto scene = random_scene<Dim>(params, radii);
    const std::size_t before = bytes_in_use();
    SimulationParams settings;
    settings.h = h;
    settings.step.scheme = Scheme::gap_anticipating;
    pile.sim = std::make_unique<Simulation<Dim>>(DefaultLaw<Dim>{{scene.mu}}, settings);
    auto& system = pile.sim->system();
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    system.gravity = -scene.gravity * up;
    system.add_obstacle(HalfSpace<Dim>(up, 0.0));
    for (int axis = 0; axis + 1 < Dim; ++axis) {
        system.add_obstacle(HalfSpace<Dim>(Vector<Dim>::Unit(axis), 0.0));
        system.add_obstacle(HalfSpace<Dim>(-Vector<Dim>::Unit(axis), -scene.box_size[axis]));
    }
    for (const auto& grain : scene.grains)
        system.add(Ball<Dim>{grain.radius}, scene.density, {grain.position, {}});
    static_cast<void>(pile.sim->run(settling));
    pile.bytes_per_grain =
        static_cast<double>(bytes_in_use() - before) / static_cast<double>(grains);
    return pile;
}

template <int Dim, bool warm>
void step(benchmark::State& state) {
    Pile<Dim>& pile = settled_pile<Dim>(state.range(0));
    double contacts = 0.0, sweeps = 0.0, updates = 0.0, residuals = 0.0, worst = 0.0;
    for (auto _ : state) {
        if (!warm) pile.sim->impulse_cache().clear();
        const auto& data = pile.sim->step();
        contacts += static_cast<double>(data.contact_count());
        sweeps += data.report.iterations;
        updates += 2.0 * static_cast<double>(data.contact_count()) * data.report.iterations;
        residuals += data.report.residual;
        worst = std::max(worst, data.report.residual);
    }
    using benchmark::Counter;
    state.counters["contacts"] = Counter(contacts, Counter::kAvgIterations);
    state.counters["sweeps"] = Counter(sweeps, Counter::kAvgIterations);
    state.counters["updates/s"] = Counter(updates, Counter::kIsRate);
    state.counters["residual"] = Counter(residuals, Counter::kAvgIterations);
    state.counters["worst"] = worst;
    state.counters["bytes/grain"] = pile.bytes_per_grain;
}

/// Warm steps of a pile at rest to the residual 10^-k.
template <int Dim>
void step_at_rest(benchmark::State& state) {
    using Simulation = talus::Simulation<Dim, bench::Types<Dim>>;
    static std::map<std::int64_t, std::unique_ptr<Simulation>> piles;
    auto& sim = piles[state.range(0)];
    if (!sim) {
        constexpr std::uint64_t seed = 1;
        talus::SimulationParams settings;
        settings.h = bench::step_length;
        settings.step.scheme = talus::Scheme::gap_anticipating;
        const auto contacts = static_cast<std::size_t>(Dim * state.range(0));
        const auto& scene = bench::resting_scene<Dim>(contacts, seed);
        sim = std::make_unique<Simulation>(bench::boxed(scene, true), settings);
        sim->solver().params.max_sweeps = 2000;
        // The first step starts from nothing, and the second from impulses of the same pile.
        sim->solver().params.tolerance = 1e-6;
        for (int k = 0; k < 10; ++k) sim->step();
    }
    sim->solver().params.tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
    sim->step();
    double sweeps = 0.0, residual = 0.0;
    for (auto _ : state) {
        const auto& data = sim->step();
        sweeps += data.report.iterations;
        residual = std::max(residual, data.report.residual);
        state.counters["contacts"] = static_cast<double>(data.contact_count());
    }
    state.counters["sweeps"] = benchmark::Counter(sweeps, benchmark::Counter::kAvgIterations);
    state.counters["residual"] = residual;
}

BENCHMARK(step<2, true>)->Arg(1000)->Arg(4000)->Arg(14000)->Unit(benchmark::kMillisecond);
BENCHMARK(step<3, true>)->Arg(1000)->Arg(4000)->Arg(14000)->Unit(benchmark::kMillisecond);
BENCHMARK(step<2, false>)
    ->Arg(1000)
    ->Arg(4000)
    ->Arg(14000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK(step<3, false>)
    ->Arg(1000)
    ->Arg(4000)
    ->Arg(14000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

BENCHMARK(step_at_rest<3>)
    ->ArgNames({"grains", "digits"})
    ->ArgsProduct({{4000, 14000}, {3, 4, 6}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

}  // namespace

BENCHMARK_MAIN();
