// SPDX-License-Identifier: BSL-1.0
//
// A rotating drum. Turned fast, its grains flow without end, with a surface that leans the more the
// faster; turned slowly, they come down in avalanches: the surface turns with the drum up to the
// angle of start and falls back to that of repose. The angle over time, of discs, balls, polygons
// or polyhedra.
//
// Sample runs:  examples/run drum
//               examples/run drum --shape angular
//               examples/run drum --dim 3
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lab/aim.hpp"
#include "lab/command.hpp"
#include "lab/measures/avalanches.hpp"
#include "lab/measures/reach.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/grains.hpp"
#include "lab/samples/move_on.hpp"
#include "lab/samples/pour.hpp"
#include "lab/samples/round_drum.hpp"

namespace {

constexpr double gravity = 9.81;  // [m/s^2]
constexpr double degree = std::numbers::pi / 180.0;

struct Options {
    double dim = 2, shape = 0, radius = 12, thickness = 5, fill = 0.4, diameter = 0.01, mu = 0.5,
           wall = 1.0, settle = 0.5, fast = 0.1, flow = 4, slow = 0.006, creep = 20,
           threshold = 1.5, step = 2e-3, aim = 1e-3;
};

void report(const lab::Command& command, const Options& o, const lab::Turning& fast,
            const lab::Turning& slow, double interval) {
    lab::write_angles(command.out(), {fast, slow}, interval);
    const double radius = o.radius * o.diameter;
    // The first half of the flow is the way there.
    const std::vector<double> flow(fast.angle.begin() + fast.angle.size() / 2, fast.angle.end());
    std::printf("fast: Froude number %.2g; ", fast.froude(radius, gravity));
    lab::print_mean_angle("the surface leans by", flow, 8);
    std::printf("\nslow: Froude number %.2g; ", slow.froude(radius, gravity));
    lab::print_avalanches(slow.angle, o.threshold);
}

template <int Dim>
int turn(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    const double radius = o.radius * o.diameter, widest = 0.6 * o.diameter;
    const double half = 0.5 * o.thickness * o.diameter;  // of its length, in space [m]
    const talus::Coulomb<Dim> on_wall{o.wall}, on_grain{o.mu}, on_end{0.0};
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(3, {on_end, 0.0, 0.0});
    laws.set(0, 0, {on_grain, 0.0, 0.0});
    laws.set(0, 1, {on_wall, 0.0, 0.0});
    talus::Simulation<Dim> sim(laws,
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}},
                               lab::solver_with_aim<Dim>(o.aim));
    auto& system = sim.system();
    system.gravity = -gravity * V::Unit(Dim - 1);
    const lab::RoundDrum<Dim> drum{radius, half};
    const talus::BodyIndex wall = drum.add_to(system, 1, 2);  // its ends are smooth
    const double grain = std::numbers::pi / (2.0 * Dim) * std::pow(o.diameter, Dim);
    const double solid = Dim == 2 ? 0.82 : 0.6;
    V low = V::Constant(-0.5 * radius), high = V::Constant(0.5 * radius);
    low[Dim - 1] = 0.0;
    if (Dim == 3) low[1] = widest - half, high[1] = half - widest;
    talus::Inlet<Dim> inlet(
        {.place = talus::in_box<Dim>(low, high),
         .shape = lab::grains<Dim>(o.shape == 1, talus::UniformRadii(0.4 * o.diameter, widest)),
         .rate = 1000.0,
         .total = static_cast<std::int64_t>(o.fill * drum.volume() * solid / grain),
         .velocity = -1.0 * V::Unit(Dim - 1),
         .seed = command.seed()});

    lab::Mark full;
    lab::Numbers fast, slow;
    lab::Run<Dim> run(command, sim, "A rotating drum");
    run.carry("inlet", inlet);
    run.carry("full", full);
    run.carry("fast", fast);
    run.carry("slow", slow);
    run.begin();
    const std::int64_t often = std::max(1LL, std::llround(0.02 / o.step));
    const auto watch = [&](lab::Numbers& series) {
        return [&] {
            if (sim.step_count() % often == 0)
                series.values.push_back(lab::lean<Dim>(system) / degree);
        };
    };
    const auto spin_up = [&](double turns) {
        lab::move_on<Dim>(system, wall, talus::drum_twist<Dim>(turns));
    };
    const bool filled = lab::pour(run, sim, inlet, full, 1.0, "filling");
    const double begin = full.time + o.settle, flows = begin + o.flow, end = flows + o.creep;
    if (!filled || !run.until(begin, "settling")) return run.exit_code();
    // Either begins at this very step or did so before a stop.
    if (sim.time() < begin + 0.5 * o.step) spin_up(o.fast);
    if (!run.until(flows, "fast", watch(fast))) return run.exit_code();
    if (sim.time() < flows + 0.5 * o.step) spin_up(o.slow);
    if (!run.until(end, "slow", watch(slow))) return run.exit_code();
    report(command, o, {"fast", o.fast, fast.values}, {"slow", o.slow, slow.values},
           static_cast<double>(often) * o.step);

    const auto look = lab::in_weights("A rotating drum", 2600.0 * grain,
                                      {-1.1 * radius, -1.1 * (Dim == 2 ? radius : half)},
                                      {1.1 * radius, 1.1 * (Dim == 2 ? radius : half)});
    lab::write_picture<Dim>(command.out() / "drum.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("drum", [&] {
        Options o;
        lab::Command command(
            "drum",
            "A drum turns fast, then slowly: how does the surface of the grains in "
            "it lean, and when do they come down?");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.choice("--shape", o.shape, {"round", "angular"}, "of grains");
        command.number("--radius", o.radius, 25, 4, 1e3, "of the drum [diameters of grains]");
        command.number("--thickness", o.thickness, 1.5, 1e3, "in space: its length [diameters]");
        command.number("--fill", o.fill, 0.05, 0.7, "part of the drum that grains fill [-]");
        command.number("--diameter", o.diameter, 1e-6, 1e3, "mean, of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient between grains");
        command.number("--wall", o.wall, 0, 1e3, "friction coefficient of the drum's wall");
        command.number("--settle", o.settle, 1e-3, 1e3, "before it turns [s]");
        command.number("--fast", o.fast, 1e-6, 1e3, "turns per second [1/s]");
        command.number("--flow", o.flow, 0.5, 1e6, "time that it turns fast [s]");
        command.number("--slow", o.slow, 1e-9, 1e3, "turns per second afterwards [1/s]");
        command.number("--creep", o.creep, 60, 0.5, 1e6, "time that it turns slowly [s]");
        command.number("--threshold", o.threshold, 1e-3, 90, "least avalanche [degrees]");
        command.number("--step", o.step, 1e-9, 0.1, "step size [s]");
        command.number("--aim", o.aim, 1e-8, 1e-3, "of the solver, its tolerance at most [-]");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? turn<2>(command, o) : turn<3>(command, o);
    });
}
