// SPDX-License-Identifier: BSL-1.0
//
// A railway track in the plane, after section 3.2 and Figure 1 of Moreau's paper: a layer of
// polygons, 2000 with --full, sleepers on it, and an elastic rail that hands the weight of a
// passing wheel to the sleepers near it. How is the load shared, and by which grains does it go
// down?
//
// Sample runs:  examples/run ballast
//               examples/run ballast --sleepers 7 --frames 100
//               examples/run ballast --full --out track
#include <talus/feed/inlet.hpp>
#include <talus/sample/container.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>

#include "lab/command.hpp"
#include "lab/masonry/track.hpp"
#include "lab/measures/passage.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/grains.hpp"
#include "lab/samples/pour.hpp"
#include "lab/table.hpp"

namespace {

constexpr double g = 9.81;  // [m/s^2]

struct Options {
    double grains = 600, radius = 0.02, mu = 0.8, step = 5e-4;
    lab::TrackParams track;
    double width() const { return track.sleepers * track.spacing; }  // of the bed [m]
};

talus::Simulation<2> empty_bed(const Options& o) {
    talus::Simulation<2> sim({talus::Coulomb<2>{o.mu}},
                             {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    // Some steps need it: the wheel weighs as much as thousands of grains.
    sim.solver().params.max_iterations = 200000;
    sim.system().gravity = {0.0, -g};
    const talus::Vector<2> low(-0.5 * o.width(), 0.0), high(0.5 * o.width(), 1.0);
    for (const auto& wall : talus::container<2>(low, high)) sim.system().add_obstacle(wall);
    return sim;
}

talus::Inlet<2> rain(const Options& o, std::uint64_t seed) {
    const double side = 0.5 * o.width() - 1.5 * o.radius;
    const double above = 6.0 * o.grains * o.radius * o.radius / o.width() + 0.2;
    return talus::Inlet<2>(
        {.place = talus::in_box<2>({-side, above}, {side, above + 0.2}),
         .shape = lab::angular_grains<2>(talus::UniformRadii(0.7 * o.radius, 1.3 * o.radius)),
         .density = 2700.0,
         .rate = 1000.0,
         .total = static_cast<std::int64_t>(o.grains),
         .velocity = {0.0, -1.0},
         .seed = seed});
}

int pass(const lab::Command& command, const Options& o) {
    talus::Simulation<2> sim = empty_bed(o);
    auto& system = sim.system();
    talus::Inlet<2> inlet = rain(o, command.seed());
    lab::Track track(o.track);
    system.forces.push_back(
        [&](double t, const talus::Bodies<2>& bodies, std::span<talus::Wrench<2>> wrenches) {
            track.press(t, bodies, wrenches);
        });

    lab::Run<2> run(command, sim, "Railway ballast");
    lab::Mark poured;
    lab::TrackLoads measured;
    lab::Numbers passage;  // of each step the wheel's place [m] and the shares of the sleepers
    run.carry("inlet", inlet);
    run.carry("poured", poured);
    run.carry("measured", measured);
    run.carry("passage", passage);
    track.carry(run);
    run.begin();
    if (!lab::pour(run, sim, inlet, poured, o.grains / 1000.0, "pouring") ||
        !run.until(poured.time + o.track.rest, "settling") ||
        !run.until(track.level(system), "levelling") ||
        !run.until(track.lay(system, 0.1 * o.radius), "laying sleepers"))
        return run.exit_code();
    const lab::Wheel wheel = track.fasten(system);
    const bool whole = run.until(wheel.stops() + o.track.rest, "the wheel passes", [&] {
        measured = {sim, track.count(), wheel.load(sim.time() - 0.5 * o.step)};
        if (sim.time() < wheel.grown() || sim.time() > wheel.crossed()) return;
        passage.values.push_back(wheel.place(sim.time()));
        for (const double force : measured.sleepers) passage.values.push_back(force / wheel.weight);
    });
    if (!whole) return run.exit_code();

    // The wheel rests on the middle of the rail.
    lab::print_shares(track, system.bodies, measured.sleepers, wheel.weight);
    double weight = wheel.weight;
    for (std::size_t i = system.obstacles.size(); i < system.bodies.count(); ++i)
        weight += g * system.bodies.mass(i);
    std::printf("force on the ground over load and weight: %.6f; less what still moves: %.9f\n",
                measured.ground / weight, measured.ground / measured.pressing);
    std::printf("Gini coefficient of the loads of grains: %.3f (G22: above 0.3)\n", measured.gini);
    lab::write_passage(command.out(), track, passage.values, o.step);
    lab::write_findings(command.out(), {{"force on the ground", "what presses",
                                         measured.ground / measured.pressing},
                                        {"gini coefficient of the loads", "-", measured.gini}});

    const double edge = track.places().back() + 0.5 * o.track.spacing;
    const double high = track.heights(system.bodies).front() + 0.2;
    lab::write_picture<2>(command.out() / "ballast.svg", sim,
                          {.title = "Railway ballast: the wheel is on the middle sleeper",
                           .captions = {"Grey by load, the sum of the normal forces."},
                           .window = {{-edge, -0.03}, {edge, high}},
                           .unit = wheel.weight,
                           .unit_name = "wheel loads"});
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("ballast", [&] {
        Options o;
        lab::Command command("ballast",
                             "A railway track in the plane: a wheel passes along an elastic rail "
                             "on sleepers on a layer of irregular polygons.");
        command.count("--grains", o.grains, 2000, 10, 1e6, "of ballast");
        command.number("--radius", o.radius, 1e-4, 1, "mean reach of a grain from its centre [m]");
        command.count("--sleepers", o.track.sleepers, 9, 3, 999, "an odd number");
        command.number("--spacing", o.track.spacing, 0.3, 100, "of sleepers [m]");
        command.number("--load", o.track.load, 0, 1e9, "of the wheel [N]");
        command.number("--bending", o.track.bending, 1e-3, 1e15,
                       "stiffness EI of the rail [N m^2]");
        command.number("--pad", o.track.pad, 1, 1e12, "stiffness of a pad under the rail [N/m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient [-]");
        command.number("--pressure", o.track.pressure, 1, 1e9,
                       "by which the bed is made level [N/m]");
        command.number("--speed", o.track.speed, 1e-3, 100, "of the wheel [m/s]");
        command.number("--rest", o.track.rest, 1e-3, 1e4, "time to settle after each change [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        if (std::fmod(o.track.sleepers, 2.0) != 1.0)
            throw talus::input_error("--sleepers must be odd, so that one is in the middle");
        return pass(command, o);
    });
}
