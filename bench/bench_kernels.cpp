// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/column.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/spatial/local_frame.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using Law = talus::Coulomb<3>;
using Problem = talus::ContactProblem<3, Law>;
using Vec = talus::Vector<3>;

/// Touching balls of radius 1 and mass 1 in a face-centred lattice of `side`^2 columns on a floor,
/// one step of gravity into them: contacts from the lattice, sorted by pair, every third dropped at
/// random so that there are about three per ball and some turn and slide.
struct Pile {
    explicit Pile(int side, bool scalar_inertia = true) {
        const double d = std::sqrt(2.0);
        std::vector<Vec> centre;
        for (int z = 0; z < side; ++z)
            for (int y = 0; y < 2 * side; ++y)
                for (int x = 0; x < 2 * side; ++x)
                    if ((x + y + z) % 2 == 0) centre.push_back(Vec(x, y, z) * d + Vec(0, 0, 1));
        balls = centre.size();
        problem.inverse_mass.resize(balls + 1);
        const auto floor = static_cast<talus::BodyIndex>(balls);
        for (std::size_t k = 0; k < balls; ++k) {
            problem.inverse_mass.linear[k] = 1.0;
            problem.inverse_mass.angular[k] = talus::Matrix<3>::Identity() * 2.5;
            if (!scalar_inertia) problem.inverse_mass.angular[k](0, 0) *= 1.0 + 1e-15;
        }
        problem.inverse_mass.linear[balls] = 0.0;
        problem.inverse_mass.angular[balls].setZero();
        std::mt19937 random(7);
        for (std::size_t i = 0; i < balls; ++i) {
            for (std::size_t j = i + 1; j < balls && centre[j][2] < centre[i][2] + 1.5; ++j)
                if ((centre[j] - centre[i]).squaredNorm() < 4.001 && random() % 2 == 0)
                    add(static_cast<talus::BodyIndex>(i), static_cast<talus::BodyIndex>(j),
                        (centre[i] - centre[j]) / 2.0);
            if (centre[i][2] < 1.1) add(static_cast<talus::BodyIndex>(i), floor, Vec::UnitZ());
        }
    }

    void add(talus::BodyIndex a, talus::BodyIndex b, const Vec& normal) {
        auto& h = problem.jacobian;
        const bool with_floor = static_cast<std::size_t>(b) == balls;
        h.a.push_back(a);
        h.b.push_back(b);
        h.frame.push_back(talus::local_frame<3>(normal));
        h.arm_a.push_back(-normal);
        h.arm_b.push_back(with_floor ? Vec(Vec::Zero()) : Vec(normal));
        const Vec fall(0.02, 0.01, -0.1);
        problem.free_velocity.push_back(with_floor ? Vec(h.frame.back() * fall) : Vec(Vec::Zero()));
        problem.laws.push_back({.mu = 0.4});
    }

    std::size_t balls = 0;
    Problem problem;
};

/// Reads contacts with the sweeps of a fixed budget, from zero impulses, and reports what it
/// reached.
void sweeps(benchmark::State& state, bool scalar_inertia) {
    const Pile pile(static_cast<int>(state.range(0)), scalar_inertia);
    talus::GaussSeidel<3, Law> solver({.max_sweeps = 200, .tolerance = 0.0});
    std::vector<Vec> r(pile.problem.contact_count());
    double residual = 0.0, sweeps = 0.0;
    for (auto _ : state) {
        std::fill(r.begin(), r.end(), Vec::Zero());
        const auto& report = solver.solve(pile.problem, r);
        residual = report.residual;
        sweeps += report.iterations;
    }
    const double contacts = static_cast<double>(r.size());
    state.counters["updates/s"] =
        benchmark::Counter(contacts * sweeps, benchmark::Counter::kIsRate);
    state.counters["contacts"] = contacts;
    state.counters["per_ball"] = contacts / static_cast<double>(pile.balls);
    state.counters["residual"] = residual;
    // Read or written per visit: the operator's row, the prepared law, two vectors, mu and rho.
    state.counters["bytes/contact"] =
        128.0 + sizeof(talus::CoulombBlock<3>) + 2.0 * sizeof(Vec) + 2.0 * sizeof(double);
}
void sweeps_of_balls(benchmark::State& state) { sweeps(state, true); }
void sweeps_of_any_bodies(benchmark::State& state) { sweeps(state, false); }
BENCHMARK(sweeps_of_balls)->Arg(10)->Arg(14)->Arg(19)->Unit(benchmark::kMillisecond);
BENCHMARK(sweeps_of_any_bodies)->Arg(14)->Unit(benchmark::kMillisecond);

/// One-contact solves of Coulomb's law with blocks that couple normal and tangents, W prepared.
void local_solves(benchmark::State& state) {
    std::mt19937_64 random(13);
    std::normal_distribution<double> normal;
    std::vector<talus::CoulombBlock<3>> blocks;
    std::vector<Vec> b;
    for (int k = 0; k < 1000; ++k) {
        talus::Matrix<3> g;
        for (int i = 0; i < 9; ++i) g.data()[i] = normal(random);
        blocks.emplace_back(g * g.transpose() + talus::Matrix<3>::Identity());
        b.emplace_back();
        for (double& x : b.back()) x = normal(random);
    }
    for (auto _ : state)
        for (std::size_t k = 0; k < b.size(); ++k)
            benchmark::DoNotOptimize(blocks[k].general_solution(0.4, b[k]));
    state.counters["solves/s"] = benchmark::Counter(static_cast<double>(b.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(local_solves);

/// Balls of sizes 1 to `ratio`, equal volume per octave of size, at random in a cube filled to 0.6
/// (overlapping): candidates per body stay the same as the number of bodies grows.
void broad_phase(benchmark::State& state) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const auto ratio = static_cast<double>(state.range(1));
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit;
    std::vector<double> diameter(n);
    double volume = 0.0;
    for (double& d : diameter) {
        const double x = unit(random);
        d = 1.0 / std::cbrt(1.0 - x * (1.0 - std::pow(ratio, -3.0)));
        volume += d * d * d * 0.5236;
    }
    const double side = std::cbrt(volume / 0.6);
    std::vector<talus::Aabb<3>> boxes;
    for (const double d : diameter) {
        Vec low;
        for (double& x : low) x = side * unit(random);
        boxes.push_back({low, low + Vec::Constant(d)});
    }
    talus::HierarchicalGrid<3> grid;
    talus::Column<talus::CandidatePair> pairs;
    for (auto _ : state) grid.find_pairs(boxes, talus::NoObstacles{}, pairs);
    state.counters["pairs_per_body"] = static_cast<double>(pairs.size()) / static_cast<double>(n);
    state.counters["s/body"] =
        benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate |
                                                       benchmark::Counter::kInvert);
}
BENCHMARK(broad_phase)
    ->ArgsProduct({{1000, 10000, 100000}, {1, 20}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
