// SPDX-License-Identifier: BSL-1.0
//
// Columns of grains collapse: grains settle between walls, in space in a tube, on a rough floor;
// the walls vanish, and the grains spread. How far, and how high is what remains, by the aspect
// ratio a = H0 / L0 of the column [Lube 2004, 2005; Lajeunesse 2005; Staron and Hinch 2005]?
//
// Sample runs:  examples/run column
//               examples/run column --dim 3
//               examples/run column --full
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lab/aim.hpp"
#include "lab/command.hpp"
#include "lab/measures/collapses.hpp"
#include "lab/measures/reach.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/fill.hpp"
#include "lab/samples/rough_floor.hpp"
#include "lab/samples/vessel.hpp"
#include "lab/table.hpp"

namespace {

constexpr double gravity = 9.81;  // [m/s^2]

struct Options {
    double dim = 2, count = 500, diameter = 0.01, mu = 0.5, restitution = 0.0, settle = 1,
           falls = 5, step = 1e-3, aim = 1e-3;
    std::vector<double> aspects{0.5, 1, 2, 4, 8};
};

/// In which that many grains stand up to an aspect ratio, the height over half the width.
template <int Dim>
lab::Vessel<Dim> vessel_of(const Options& o, double aspect) {
    const double grains = lab::Vessel<Dim>{1.0, o.diameter}.grains(0.5 * aspect);
    return {std::pow(o.count / grains, 1.0 / Dim), o.diameter};
}

/// One collapse, in a folder of its own; its exit code, from `stopped` on if it was.
template <int Dim>
int collapse(const lab::Command& command, const Options& o, double aspect, lab::Collapses& found,
             talus::RunSummary& summary) {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    const auto vessel = vessel_of<Dim>(o, aspect);
    const double half = 0.5 * vessel.width;
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}, o.restitution, 0.0},
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}},
                               lab::solver_with_aim<Dim>(o.aim));
    auto& system = sim.system();
    system.gravity = -gravity * up;
    vessel.add_wall(system);
    const std::size_t walls = system.bodies.count();
    const double spread = Dim == 2 ? 4.0 * std::min(aspect, std::pow(aspect, 0.7))
                                   : 2.5 * std::min(aspect, std::sqrt(aspect));
    lab::add_rough_floor<Dim>(system, vessel.radii(), (1.5 + spread) * half, command.seed() + 1);
    vessel.scatter(system, o.count, vessel.largest_radius(), command.seed());

    lab::Mark released;
    lab::Numbers column, length;  // height of the column; how far grains are each 10 ms [m]
    lab::Run<Dim> run(command, sim, "A column collapses", "a" + talus::detail::text_of(aspect));
    run.carry("released", released);
    run.carry("column", column);
    run.carry("length", length);
    run.begin();
    const std::string label = "a = " + talus::detail::text_of(aspect);
    if (!run.until(o.settle, label + ", settling")) return run.exit_code();
    const auto top = [&] { return lab::Fill<Dim>(system, 0.0, 1.0).top; };
    if (column.values.empty()) {
        column.values = {top()};
        released.time = sim.time();
        system.remove_if([&](std::size_t i) { return i < walls; });
    }
    const double fall = std::sqrt(2.0 * column.values[0] / gravity);
    const std::int64_t often = std::max(1LL, std::llround(0.01 / o.step));
    if (!run.until(released.time + o.falls * fall, label, [&] {
            if (sim.step_count() % often == 0)
                length.values.push_back(lab::reach<Dim>(system, half, o.diameter));
        }))
        return run.exit_code();
    summary.add(run.summary());

    found.add(run.folder(), length.values, often, o.step, half, column[0], top(), fall);
    const double end = length.values.back();
    const auto look =
        lab::in_weights("A column has collapsed", lab::Fill<Dim>(system, 0.0, 1.0).mass / o.count,
                        {-1.1 * end, Dim == 2 ? -o.diameter : -1.1 * end},
                        {1.1 * end, Dim == 2 ? 1.2 * top() : 1.1 * end});
    lab::write_picture<Dim>(run.folder() / "heap.svg", sim, look);
    return run.finish();
}

template <int Dim>
int collapse_all(const lab::Command& command, const Options& o) {
    lab::Collapses all;
    talus::RunSummary summary;
    std::printf("    a   run-out / L0   height / L0   time / sqrt(2 H0 / g)\n");
    for (const double aspect : o.aspects) {
        const int code = collapse<Dim>(command, o, aspect, all, summary);
        if (code >= lab::stopped) return code;
        all.print();
    }
    std::printf(
        "references for the run-out: in experiments 1.2 a up to a = 2 and 1.9 a^(2/3) beyond, "
        "in space 1.24 a up to 1.7 and 1.6 a^(1/2) [Lube 2004, 2005]; discs 2.5 a, 3.25 a^0.7 "
        "[Staron and Hinch 2005]; time 2.2 to 2.6\n");
    const double bend = Dim == 2 ? 2.0 : 1.7;
    all.print_exponents(0.0, 1.15 * bend, "reference: 1.0 +- 0.15");
    all.print_exponents(0.85 * bend, 1e9,
                        Dim == 2 ? "reference: 0.65 to 0.75" : "reference: 0.5 +- 0.1");
    std::printf("%s\n", to_string(summary).c_str());

    all.write(command.out());
    lab::write_findings(
        command.out(),
        {{"exponent of the run-out of wide columns", "-", all.exponent(0.0, 1.15 * bend)},
         {"exponent of the run-out of tall columns", "-", all.exponent(0.85 * bend, 1e9)},
         {"time to spread", "free fall", std::ranges::max(all.time)},
         {"shortest time to spread", "free fall", std::ranges::min(all.time)}});
    return summary.certified() ? lab::certified : lab::not_certified;
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("column", [&] {
        Options o;
        lab::Command command("column",
                             "Columns of grains collapse on a rough floor: how far do they reach, "
                             "by their aspect ratio?");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--count", o.count, 2000, 20, 1e6, "grains of each column");
        command.list("--aspects", o.aspects, {0.5, 1, 2, 4, 8, 16}, 0.1, 100,
                     "height of the column over its half width or radius");
        command.number("--diameter", o.diameter, 1e-6, 1e3, "mean, of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient");
        command.number("--restitution", o.restitution, 0, 1, "of impacts [-]");
        command.number("--settle", o.settle, 1e-3, 1e3, "before the walls vanish [s]");
        command.number("--falls", o.falls, 1, 1e3, "to spread [sqrt(2 H0 / g)]");
        command.number("--step", o.step, 1e-9, 0.01, "step size [s]");
        command.number("--aim", o.aim, 1e-8, 1e-3, "of the solver, its tolerance at most [-]");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? collapse_all<2>(command, o) : collapse_all<3>(command, o);
    });
}
