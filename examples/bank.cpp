// SPDX-License-Identifier: BSL-1.0
//
// A bank made by avalanches, after section 3.5 and Figure 4 of Moreau's paper. Irregular grains
// fall on the upper end of an incline with grains glued to it; a plate at its foot lets a layer
// build up, which avalanches carry off at the plate's edge. Its surface leans between an angle of
// repose and a limit angle (the paper: some 25 and 29 degrees). In the bank, at rest at the end,
// the force across a cut along the surface is vertical, and that across a vertical cut goes along
// the surface.
//
// Sample runs:  examples/run bank
//               examples/run bank --incline 22 --frames 20
//               examples/run bank --full
#include <talus/feed/inlet.hpp>
#include <talus/feed/sink.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lab/aim.hpp"
#include "lab/command.hpp"
#include "lab/measures/averages.hpp"
#include "lab/measures/surface.hpp"
#include "lab/measures/turning_points.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/grains.hpp"
#include "lab/samples/incline.hpp"
#include "lab/table.hpp"

namespace {

using V = talus::Vector<2>;

struct Options {
    double count = 600, radius = 0.005, ratio = 1.5, mu = 0.4, incline = 25, length = 32, plate = 8,
           rate = 150, rest = 0.5, step = 2e-4, amplitude = 2.0;
};

double degrees(double x) { return x * 180.0 / std::numbers::pi; }

int build(const lab::Command& command, const Options& o) {
    const double d = 2.0 * o.radius, lean = o.incline * std::numbers::pi / 180.0;
    const double smallest = d / (1.0 + o.ratio);
    const talus::UniformRadii radii(smallest, o.ratio * smallest);
    const auto shape = lab::angular_grains<2>(radii);
    const lab::Incline incline(o.length * d, lean, d, o.plate * d);

    talus::Simulation<2> sim({talus::Coulomb<2>{o.mu}},
                             {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}},
                             lab::solver_with_aim<2>(1e-3));
    auto& system = sim.system();
    system.gravity = V(0.0, -9.81);
    incline.add_to(system, shape, command.seed());
    const std::size_t first = system.bodies.count();

    talus::Inlet<2> inlet({.place = incline.source(sim),
                           .shape = shape,
                           .rate = o.rate,
                           .total = static_cast<std::int64_t>(o.count),
                           .seed = command.seed() + 1});
    auto sink = talus::Sink<2>::below(V(0.0, 1.0), -4.0 * d);
    lab::TurningPoints turns(o.amplitude);

    lab::Run<2> run(command, sim, "A bank made by avalanches");
    run.carry("inlet", inlet);
    run.carry("sink", sink);
    run.carry("turns", turns);
    lab::Mark fed;
    run.carry("fed", fed);
    run.begin();
    auto series = run.series("surface.csv", {{"angle", "degrees"}, {"fallen off", "-"}});
    const double from = 0.1 * incline.top()[0], to = 0.75 * incline.top()[0];
    const auto surface = [&] {
        return lab::SurfaceLine(system.bodies, first, from, to,
                                static_cast<std::size_t>(0.5 * (to - from) / d));
    };
    const auto watch = [&] {
        inlet.feed(system, sim.time());
        sink.drain(system);
        if (sim.step_count() % 20 != 0 || sink.count() == 0) return;
        const double angle = degrees(surface().angle());
        turns.add(angle);
        series.add(sim.time(), {angle, static_cast<double>(sink.count())});
    };
    if (!run.until([&] { return inlet.done(); }, o.count / o.rate, "avalanches", watch))
        return run.exit_code();
    fed.time = std::min(fed.time, sim.time());
    // What has fallen off is taken out until shortly before the last step, which is measured.
    const double end = fed.time + o.rest;
    if (!run.until(end, "rest", [&] {
            if (sim.time() < end - 0.1 * o.rest) sink.drain(system);
        }))
        return run.exit_code();

    std::printf("%lld grains came, %lld fell off\n", static_cast<long long>(inlet.count()),
                static_cast<long long>(sink.count()));
    turns.print_avalanches();
    std::vector<lab::Finding> findings = turns.findings();
    const lab::SurfaceLine bank = surface();
    lab::PictureParams look;
    look.title = "A bank made by avalanches";
    look.window = incline.window();
    look.unit = 9.81 * system.bodies.mass(first);
    look.unit_name = "weights";
    if (bank.whole()) {
        const double middle = 0.5 * (from + to);
        const double depth = 0.5 * (bank.height(middle) - middle * std::tan(lean));
        const V along = lab::force_across(sim, bank, from, to, depth, false);
        const V upright = lab::force_across(sim, bank, from, to, depth, true);
        std::printf("at rest the surface leans by %.1f degrees\n", degrees(bank.angle()));
        const double from_vertical = degrees(std::atan2(along[0], -along[1]));
        const double from_surface = degrees(std::atan2(-upright[1], -upright[0]) - bank.angle());
        std::printf(
            "force across cuts along the surface: %.1f degrees from the vertical (0), across "
            "upright cuts %.1f\n    degrees from the surface (0)\n",
            from_vertical, from_surface);
        findings.push_back(
            {"force across cuts along the surface from the vertical", "degrees", from_vertical});
        findings.push_back({"force across upright cuts from the surface", "degrees", from_surface});
        look.lines = lab::drawn_cuts(bank, from, to, depth);
    }
    lab::write_findings(command.out(), findings);
    lab::write_picture<2>(command.out() / "bank.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("bank", [&] {
        Options o;
        lab::Command command("bank",
                             "Grains fall on an incline and form a bank, which avalanches remodel: "
                             "its angles, and the forces across cuts.");
        command.count("--count", o.count, 4000, 10, 1e6, "grains that come");
        command.number("--radius", o.radius, 1e-6, 1e3, "mean radius of grains [m]");
        command.number("--ratio", o.ratio, 1, 10, "largest over smallest radius");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient");
        command.number("--incline", o.incline, 1, 60, "lean of the incline [degrees]");
        command.number("--length", o.length, 60, 10, 1e4, "of the incline, in mean diameters");
        command.number("--plate", o.plate, 16, 1, 1e4, "length of the plate, in mean diameters");
        command.number("--rate", o.rate, 1e-3, 1e6, "grains that come in a second [1/s]");
        command.number("--rest", o.rest, 1e-9, 1e6, "time to rest at the end [s]");
        command.number("--amplitude", o.amplitude, 0.01, 45,
                       "by which the angle falls in what counts as an avalanche [degrees]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        return command.read(argc, argv) ? build(command, o) : 0;
    });
}
