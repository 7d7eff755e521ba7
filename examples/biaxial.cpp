// SPDX-License-Identifier: BSL-1.0
//
// A biaxial test, after section 3.4 and Figure 3 of Moreau's paper; in space a triaxial one. Walls
// without friction squeeze irregular grains along the first axis at a given rate, while a pressure
// holds the others. In the middle the mean stress of the grains is compared with the forces across
// 31 cuts: is it what the theory of continua calls stress?
//
// Sample runs:  examples/run biaxial
//               examples/run biaxial --dim 3 --count 1500
//               examples/run biaxial --full --frames 25
#include <talus/stepping/step_queries.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lab/command.hpp"
#include "lab/measures/networks.hpp"
#include "lab/measures/probe.hpp"
#include "lab/plot.hpp"
#include "lab/run.hpp"
#include "lab/samples/press.hpp"
#include "lab/table.hpp"

namespace {

struct Options {
    double dim = 2, count = 800, radius = 0.005, ratio = 1.5, mu = 0.4, pressure = 1e4, rate = 0.1,
           strain = 0.08, settle = 0.6, step = 1e-3, probe = 6, grains = 0;
};

template <int Dim>
int squeeze(const lab::Command& command, const Options& o) {
    // Grains with friction, walls without.
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(2, {talus::Coulomb<Dim>{0.0}});
    laws.set(0, 0, {talus::Coulomb<Dim>{o.mu}});
    talus::Simulation<Dim> sim(laws,
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    const auto& bodies = system.bodies;
    const double smallest = 2.0 * o.radius / (1.0 + o.ratio);
    lab::PressedBox<Dim> box(system, static_cast<std::size_t>(o.count),
                             talus::UniformRadii(smallest, o.ratio * smallest), o.grains == 0, 1,
                             command.seed());
    // While the sample is made, the walls across the first axis rest.
    const double soft = 0.05;
    box.add_jaws(system, 0, o.settle, soft, 0.5 * o.rate * box.size()[0]);
    for (int axis = 1; axis < Dim; ++axis) box.add_lid(system, axis, o.pressure, 1.0);

    lab::Run<Dim> run(command, sim, "Biaxial test");
    lab::Real length, volume, hardest;  // [m], [m^Dim] when the squeeze begins; [-]
    run.carry("length", length);
    run.carry("volume", volume);
    run.carry("hardest", hardest);
    run.begin();
    if (!run.until(o.settle, "pressing", [&] {
            length.value = box.extent(bodies, 0);
            volume.value = box.volume(bodies);
        }))
        return run.exit_code();
    auto series =
        run.series("stress.csv", {{"strain", "-"}, {"stress ratio", "-"}, {"volume strain", "-"}});
    const bool whole = run.until(o.settle + soft + o.strain / o.rate, "squeezing", [&] {
        if (sim.step_count() % 10 != 0) return;
        const auto push = talus::wrench_impulse_on(sim.data(), box.ends(0)[0]).force / o.step;
        const double ratio = -push[0] / box.area(bodies, 0) / o.pressure;
        hardest.value = std::max(hardest.value, ratio);
        series.add(sim.time(), {1.0 - box.extent(bodies, 0) / length.value, ratio,
                                box.volume(bodies) / volume.value - 1.0});
    });
    if (!whole) return run.exit_code();

    const talus::Vector<Dim> middle = box.middle(bodies);
    const double reach = o.probe * 2.0 * o.radius;
    const lab::Probe<Dim> probe(sim, middle, reach);
    const lab::CutStudy<Dim> cuts(probe, 31);
    const auto degrees = [](double x) { return x * 180.0 / std::numbers::pi; };
    std::printf("%zu grains, solid fraction %.3f; a region of %g mean diameters, 31 cuts\n",
                box.grains(), box.solid_fraction(bodies), 2.0 * o.probe);
    std::printf("mean pressure there %.3f of that of the lids\n", probe.pressure() / o.pressure);
    std::printf(
        "cuts against the stress tensor: rms deviation %.3f of the mean pressure, mean "
        "normal stress %.3f\n    of the tensor's (the paper: satisfactory; for %g "
        "diameters at most 0.2 and 1 +- 0.05)\n",
        cuts.deviation(), cuts.mean(), 12.0);
    std::printf("largest stress ratio %.2f: friction angle %.1f degrees, of the grains %.1f\n",
                hardest.value, degrees(std::asin((hardest.value - 1.0) / (hardest.value + 1.0))),
                degrees(std::atan(o.mu)));
    const lab::Networks<Dim> networks(sim, box.grains(), o.mu);
    networks.print();
    cuts.write(command.out(), o.pressure);
    std::vector<lab::Finding> findings = networks.findings();
    findings.push_back({"rms deviation of cuts", "mean pressure", cuts.deviation()});
    findings.push_back({"mean normal stress of cuts", "that of the tensor", cuts.mean()});
    findings.push_back({"largest stress ratio", "-", hardest.value});
    lab::write_findings(command.out(), findings);
    lab::PictureParams look;
    look.title = "Biaxial test: a region that was probed, and its principal stresses";
    look.unit = o.pressure * std::pow(2.0 * o.radius, Dim - 1);
    look.unit_name = Dim == 2 ? "p d" : "p d\u00b2";
    const lab::Point edge(4.0 * o.radius, 4.0 * o.radius);
    look.window = {-edge, lab::Point(box.size()[0], box.extent(bodies, 1)) + edge};
    if constexpr (Dim == 2) look.lines = lab::drawn_probe(middle, reach, probe.stress());
    lab::write_picture<Dim>(command.out() / "biaxial.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("biaxial", [&] {
        Options o;
        lab::Command command(
            "biaxial",
            "Grains are squeezed along one axis under a pressure along the others; "
            "the stress tensor is compared with forces across cuts.");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--count", o.count, 2000, 10, 1e6, "grains");
        command.choice("--grains", o.grains, {"angular", "round"}, "shape of the grains");
        command.number("--radius", o.radius, 1e-6, 1e3, "mean radius of grains [m]");
        command.number("--ratio", o.ratio, 1, 10, "largest over smallest radius");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient of grains");
        command.number("--pressure", o.pressure, 1e-9, 1e12, "of the lids [N/m; in space Pa]");
        command.number("--rate", o.rate, 1e-9, 1e3, "of the squeeze [1/s]");
        command.number("--strain", o.strain, 1e-6, 0.5, "at the end");
        command.number("--settle", o.settle, 1e-6, 1e6, "time to make the sample [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        command.number("--probe", o.probe, 1, 1e4, "radius of the region, in mean diameters");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? squeeze<2>(command, o) : squeeze<3>(command, o);
    });
}
