// SPDX-License-Identifier: BSL-1.0
//
// Columns of grains collapse: grains settle between walls, in space in a tube, on a rough floor;
// the walls vanish, and the grains spread. How far, and how high is what remains, by the aspect
// ratio a = H0 / L0 of the column [Lube 2004, 2005; Lajeunesse 2005; Staron and Hinch 2005]?
//
// Sample runs:  examples/run column
//               examples/run column --dim 3
//               examples/run column --full
#include <talus/io/series/csv_series.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lab/command.hpp"
#include "lab/fill.hpp"
#include "lab/fits.hpp"
#include "lab/picture.hpp"
#include "lab/plot.hpp"
#include "lab/rough_floor.hpp"
#include "lab/run.hpp"
#include "lab/table.hpp"
#include "lab/vessel.hpp"

namespace {

constexpr double gravity = 9.81;  // [m/s^2]

struct Options {
    double dim = 2, count = 600, diameter = 0.01, mu = 0.5, restitution = 0.0, settle = 1,
           falls = 5, step = 5e-4;
    std::vector<double> aspects{0.5, 1, 2, 4, 8};
};

/// In which that many grains stand up to an aspect ratio, the height over half the width.
template <int Dim>
lab::Vessel<Dim> vessel_of(const Options& o, double aspect) {
    const double grains = lab::Vessel<Dim>{1.0, o.diameter}.grains(0.5 * aspect);
    return {std::pow(o.count / grains, 1.0 / Dim), o.diameter};
}

/// How far a heap reaches, in the mean over 2 or 12 directions: as far as grains follow each other
/// by less than two diameters; what ran ahead is not of it. [m]
template <int Dim>
double reach(const talus::System<Dim>& system, double half_width, double diameter) {
    constexpr std::size_t sectors = Dim == 2 ? 2 : 12;
    std::array<std::vector<double>, sectors> far;
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        if (system.bodies.is_obstacle(i)) continue;
        talus::Vector<Dim> x = system.bodies.position[i];
        x[Dim - 1] = 0.0;
        const double angle = std::atan2(x[Dim - 2], x[0]) / (2.0 * std::numbers::pi) + 0.5;
        const double sector = Dim == 2 ? (x[0] < 0.0 ? 0.0 : 1.0) : angle * sectors;
        far[std::min(static_cast<std::size_t>(sector), sectors - 1)].push_back(x.norm());
    }
    double sum = 0.0;
    for (auto& distances : far) {
        double at = 0.9 * half_width;
        std::sort(distances.begin(), distances.end());
        for (const double d : distances)
            if (d > at && d < at + 2.0 * diameter) at = d;
        sum += at + 0.5 * diameter;
    }
    return sum / sectors;
}

/// What a column becomes.
struct Collapse {
    double aspect = 0.0;                 ///< H0 / L0 of the settled column
    double run_out = 0.0, height = 0.0;  ///< (L - L0) / L0, H / L0
    double time = 0.0;                   ///< until 0.98 of L is reached, over sqrt(2 H0 / g)
};

/// One collapse, in a folder of its own; its exit code, from `stopped` on if it was.
template <int Dim>
int collapse(const lab::Command& command, const Options& o, double aspect, Collapse& result,
             talus::RunSummary& summary) {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    const auto vessel = vessel_of<Dim>(o, aspect);
    const double half = 0.5 * vessel.width;
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}, o.restitution, 0.0},
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -gravity * up;
    vessel.add_wall(system);
    const std::size_t walls = system.bodies.count();
    const double spread = Dim == 2 ? 4.0 * std::min(aspect, std::pow(aspect, 0.7))
                                   : 2.5 * std::min(aspect, std::sqrt(aspect));
    lab::add_rough_floor<Dim>(system, vessel.radii(), (1.5 + spread) * half, command.seed() + 1);
    vessel.scatter(system, o.count, vessel.largest_radius(), command.seed());

    lab::Mark released;
    lab::Series column, length;  // height of the column; how far grains are each 10 ms [m]
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
                length.values.push_back(reach<Dim>(system, half, o.diameter));
        }))
        return run.exit_code();
    summary.add(run.summary());

    const double end = length.values.back();
    result = {column.values[0] / half, end / half - 1.0, top() / half, 0.0};
    talus::CsvSeries table(run.folder() / "length.csv", {{"length", "m"}});
    for (std::size_t k = 0; k < length.values.size(); ++k) {
        const double t = static_cast<double>((k + 1) * often) * o.step;
        table.add(t, {length.values[k]});
        if (result.time == 0.0 && length.values[k] >= 0.98 * end) result.time = t / fall;
    }
    lab::PictureParams look;
    look.title = "A column of aspect ratio " + talus::detail::text_of(aspect) + " has collapsed";
    look.unit = gravity * lab::Fill<Dim>(system, 0.0, 1.0).mass / o.count;
    look.unit_name = "mean weights";
    const double shown = 1.1 * end, floor = Dim == 2 ? -o.diameter : -shown;
    look.window = {{-shown, floor}, {shown, Dim == 2 ? 1.2 * top() : shown}};
    if (run.stepped()) lab::write_picture<Dim>(run.folder() / "heap.svg", sim, look);
    return run.exit_code();
}

/// The exponents of run-out and height over columns from `low` to `high`, beside what was found.
void print_exponents(const std::vector<Collapse>& all, double low, double high,
                     const char* reference) {
    std::vector<double> aspect, run_out, height;
    for (const Collapse& c : all) {
        if (c.aspect < low || c.aspect > high || !(c.run_out > 0.0)) continue;
        aspect.push_back(c.aspect);
        run_out.push_back(c.run_out);
        height.push_back(c.height);
    }
    if (aspect.size() < 2) return;
    const auto far = lab::fit_power(aspect, run_out), high_fit = lab::fit_power(aspect, height);
    std::printf("a from %.2f to %.2f: run-out %.2f a^%.2f (%s); height %.2f a^%.2f\n",
                aspect.front(), aspect.back(), far.factor, far.exponent, reference, high_fit.factor,
                high_fit.exponent);
}

template <int Dim>
int collapse_all(const lab::Command& command, const Options& o) {
    std::vector<Collapse> all;
    talus::RunSummary summary;
    std::printf("    a   run-out / L0   height / L0   time / sqrt(2 H0 / g)\n");
    for (const double aspect : o.aspects) {
        Collapse& c = all.emplace_back();
        const int code = collapse<Dim>(command, o, aspect, c, summary);
        if (code >= lab::stopped) return code;
        std::printf("%5.2f   %12.3f   %11.3f   %21.2f\n", c.aspect, c.run_out, c.height, c.time);
    }
    std::printf(
        "references for the run-out: in experiments 1.2 a up to a = 2 and 1.9 a^(2/3) beyond, "
        "in space 1.24 a up to 1.7 and 1.6 a^(1/2) [Lube 2004, 2005]; discs 2.5 a, 3.25 a^0.7 "
        "[Staron and Hinch 2005]; time 2.2 to 2.6\n");
    const double bend = Dim == 2 ? 2.0 : 1.7;
    print_exponents(all, 0.0, 1.15 * bend, "reference: 1.0 +- 0.15");
    print_exponents(all, 0.85 * bend, 1e9,
                    Dim == 2 ? "reference: 0.65 to 0.75" : "reference: 0.5 +- 0.1");
    std::printf("%s\n", to_string(summary).c_str());

    lab::Column aspect{"aspect ratio", {}}, run_out{"run-out / L0", {}}, height{"height / L0", {}},
        time{"time / sqrt(2 H0 / g)", {}};
    for (const Collapse& c : all) {
        aspect.values.push_back(c.aspect);
        run_out.values.push_back(c.run_out);
        height.values.push_back(c.height);
        time.values.push_back(c.time);
    }
    lab::write_table(command.out() / "columns.csv", {aspect, run_out, height, time});
    lab::write_plot(command.out() / "columns.svg",
                    {"Collapse of columns",
                     "aspect ratio H0 / L0",
                     "over L0",
                     {{"run-out", aspect.values, run_out.values, true},
                      {"height", aspect.values, height.values, true}},
                     true});
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
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? collapse_all<2>(command, o) : collapse_all<3>(command, o);
    });
}
