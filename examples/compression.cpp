// SPDX-License-Identifier: BSL-1.0
//
// Grains pressed from all sides, in the plane and in space by the same text, without friction and
// with it. Without, a packing of balls at rest has as many contacts that bear as it has degrees of
// freedom, not one more [Moukarzel 1998]: counted here. With friction it is looser, with fewer
// contacts. And what do oversized grains change, as section 3.1 of Moreau's paper asks? The same
// box is filled with grains of up to 2.25 times the size.
//
// Sample runs:  examples/run compression
//               examples/run compression --count 300 --mu 0.3
//               examples/run compression --full
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lab/command.hpp"
#include "lab/measures/packing_study.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/packing.hpp"
#include "lab/samples/press.hpp"

namespace {

struct Options {
    double count = 300, radius = 0.005, ratio = 1.4, mu = 0.5, pressure = 1e4, press = 1.0,
           rest = 0.2, step = 5e-4, fine = 1e-7, dim = 0;
    std::vector<double> sizes{2.25, 1.5, 1.0};  ///< over that of the finest grains
};

/// Presses grains `size` times as large as the finest into a box; false if the user stopped it.
template <int Dim>
bool compress(const lab::Command& command, const Options& o, double mu, double size,
              lab::Packing& p, talus::RunSummary& all, int& code) {
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(2, {talus::Coulomb<Dim>{0.0}});
    laws.set(0, 0, {talus::Coulomb<Dim>{mu}});
    talus::Simulation<Dim> sim(laws,
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    const double smallest = 2.0 * size * o.radius / (1.0 + o.ratio);
    const auto count = static_cast<std::size_t>(o.count / std::pow(size, Dim));
    lab::PressedBox<Dim> box(sim.system(), std::max<std::size_t>(count, 2),
                             talus::UniformRadii(smallest, o.ratio * smallest), false, 1,
                             command.seed());
    for (int axis = 0; axis < Dim; ++axis) box.add_lid(sim.system(), axis, o.pressure, 0.05);
    char part[40];
    std::snprintf(part, sizeof part, "%dd-mu-%g-size-%g", Dim, mu, size);
    lab::Run<Dim> run(command, sim, "Grains pressed from all sides", part);
    lab::Real loosened;
    run.carry("loosened", loosened);
    run.begin();
    bool whole = run.until(o.press, std::string(part) + " pressing");
    if (whole && loosened.value == 0.0) {
        // Overlaps left by the way here would close more contacts than a rigid packing has.
        box.loosen(sim.system(), 1e-4);
        loosened.value = 1.0;
    }
    if (whole) {
        // Which contacts bear without friction is told apart at rest, and solved accurately.
        if (mu == 0.0)
            sim.solver() = talus::AcceleratedGaussSeidel<Dim, talus::DefaultLaw<Dim>>(
                {.max_iterations = 200000,
                 .tolerance = o.fine,
                 .acceleration = talus::Acceleration::nesterov});
        whole = run.until(o.press + o.rest, std::string(part) + " resting");
    }
    if (whole) {
        p = lab::measure_packing(sim, box, mu);
        lab::PictureParams look;
        look.title = mu > 0.0 ? "Grains pressed from all sides" : "The same without friction";
        look.unit = o.pressure * std::pow(2.0 * o.radius, Dim - 1);
        look.unit_name = Dim == 2 ? "p d" : "p d\u00b2";
        const auto end = [&](int axis) { return box.extent(sim.system().bodies, axis); };
        const lab::Point edge(4.0 * o.radius, 4.0 * o.radius);
        look.window = {-edge, lab::Point(end(0), end(1)) + edge};
        lab::write_picture<Dim>(run.folder() / "packing.svg", sim, look);
    }
    all.add(run.summary());
    code = std::max(code, whole ? run.finish() : run.exit_code());
    return whole;
}

template <int Dim>
bool compare_sizes(const lab::Command& command, const Options& o, double mu,
                   std::vector<lab::PackingStudy>& studies, talus::RunSummary& all, int& code) {
    lab::PackingStudy study(Dim, mu);
    for (const double size : o.sizes) {
        lab::Packing p;
        if (!compress<Dim>(command, o, mu, size, p, all, code)) return false;
        study.add(size, p);
    }
    study.print();
    studies.push_back(study);
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("compression", [&] {
        Options o;
        lab::Command command(
            "compression",
            "Balls are pressed from all sides, in the plane and in space, without "
            "friction and with it, of three sizes: contacts and degrees of freedom "
            "are counted.");
        command.choice("--dim", o.dim, {"both", "2", "3"}, "dimensions");
        command.list("--sizes", o.sizes, {2.25, 1.5, 1.0}, 0.5, 10,
                     "of grains in turn, over that of the finest");
        command.count("--count", o.count, 4000, 100, 1e6, "of the finest grains");
        command.number("--radius", o.radius, 1e-6, 1e3, "mean radius of the finest grains [m]");
        command.number("--ratio", o.ratio, 1, 10, "largest over smallest radius");
        command.number("--mu", o.mu, 1e-3, 1e3, "friction coefficient of grains, where there is");
        command.number("--pressure", o.pressure, 1e-9, 1e12, "of the lids [N/m; in space Pa]");
        command.number("--press", o.press, 1e-6, 1e6, "time to press [s]");
        command.number("--rest", o.rest, 1e-6, 1e6, "time to rest, solved accurately [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        command.number("--fine", o.fine, 1e-12, 1e-3, "tolerance at rest without friction");
        if (!command.read(argc, argv)) return 0;
        std::vector<lab::PackingStudy> studies;
        talus::RunSummary all;
        int code = 0;
        for (const double mu : {0.0, o.mu}) {
            if (o.dim != 2 && !compare_sizes<2>(command, o, mu, studies, all, code)) return code;
            if (o.dim != 1 && !compare_sizes<3>(command, o, mu, studies, all, code)) return code;
        }
        lab::write_packings(command.out(), studies);
        std::printf("%s\n", to_string(all).c_str());
        return code;
    });
}
