// SPDX-License-Identifier: BSL-1.0
//
// Directions of contact in deposits, after section 3.3 and Figure 2 of Moreau's paper. Grains rain
// under gravity into three bins with a flat floor: round ones, and two kinds of irregular ones with
// corners, of sizes that differ little and much. When all has come to rest, one asks which contact
// normals are most frequent: not the vertical one, but two directions on both sides of it.
//
// Sample runs:  examples/run deposit
//               examples/run deposit --dim 3 --count 1000 --mu 0.4
//               examples/run deposit --full --out rain
#include <talus/feed/inlet.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lab/command.hpp"
#include "lab/measures/oblique.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/bins.hpp"
#include "lab/samples/grains.hpp"
#include "lab/table.hpp"

namespace {

struct Options {
    double dim = 2, count = 500, radius = 0.005, mu = 0.4, width = 25, fall = 10, step = 5e-4,
           rest = 0.5, near = 3;
};

struct Sample {
    const char* name;
    bool angular;
    double size_ratio;  ///< of the largest to the smallest radius
};
constexpr std::array<Sample, 3> samples{{{"round, sizes 1 : 1.5", false, 1.5},
                                         {"angular, sizes 1 : 1.5", true, 1.5},
                                         {"angular, sizes 1 : 3", true, 3.0}}};

template <int Dim>
int rain(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    constexpr int up = Dim - 1;
    const double d = 2.0 * o.radius, width = o.width * d;
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}},
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * V::Unit(up);
    const double grain = std::pow(d, Dim), floor_area = std::pow(width, Dim - 1);
    const double top = o.count * grain / floor_area + o.fall * d;
    const lab::Bins<Dim> bins(samples.size(), width, top);
    bins.add_to(system);

    lab::Run<Dim> run(command, sim, "Rain of grains");
    std::vector<talus::Inlet<Dim>> clouds;
    const double rate = 0.25 * floor_area / std::pow(d, Dim - 1) * std::sqrt(9.81 / d);
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const Sample& s = samples[k];
        const double smallest = 2.0 * o.radius / (1.0 + s.size_ratio);
        const auto [low, high] = bins.inside(k, s.size_ratio * smallest);
        // The cloud rises with the layer below it.
        const auto place = [&, k, low = low, high = high](talus::Random& random) {
            V x = talus::in_box<Dim>(low, high)(random);
            const double layer = static_cast<double>(clouds[k].count()) * grain / floor_area;
            x[up] = layer + o.fall * d * random.uniform(0.8, 1.0);
            return x;
        };
        clouds.push_back(talus::Inlet<Dim>(
            {.place = place,
             .shape = lab::grains<Dim>(s.angular,
                                       talus::UniformRadii(smallest, s.size_ratio * smallest)),
             .rate = rate,
             .total = static_cast<std::int64_t>(o.count),
             .seed = command.seed() + k}));
    }
    for (std::size_t k = 0; k < samples.size(); ++k)
        run.carry("rain-" + std::to_string(k), clouds[k]);
    lab::Mark fallen;
    run.carry("fallen", fallen);
    run.begin();
    const auto all_came = [&] {
        return std::ranges::all_of(clouds, [](const auto& c) { return c.done(); });
    };
    if (!run.until(all_came, o.count / rate, "rain", [&] {
            for (auto& cloud : clouds) cloud.feed(system, sim.time());
            if (all_came()) fallen.time = sim.time();
        }))
        return run.exit_code();
    if (!run.until(fallen.time + o.rest, "rest")) return run.exit_code();

    // All points of contact that bear, away from floor, walls and surface.
    std::printf(
        "Contact normals; the paper (section 3.3) finds two oblique directions preferred.\n");
    lab::ObliqueStudy<Dim> study;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        auto [low, high] = bins.inside(k, o.near * d);
        low[up] = o.near * d;
        study.begin(samples[k].name);
        for (std::size_t c = 0; c < sim.data().contact_count(); ++c) {
            const auto& contacts = sim.data().contacts;
            const V& x = contacts.point[c];
            if ((x - low).minCoeff() < 0.0 || (high - x).minCoeff() < 0.0) continue;
            if (sim.data().impulse[c][0] > 0.0) study.add(contacts.normal[c]);
        }
        study.print();
    }
    study.write(command.out());
    lab::write_findings(command.out(), study.findings());
    lab::PictureParams look;
    look.title = "Grains that have rained";
    look.window = bins.window();
    lab::write_picture<Dim>(command.out() / "deposit.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("deposit", [&] {
        Options o;
        lab::Command command("deposit",
                             "Grains rain into three bins: round ones, and angular ones of two "
                             "distributions of sizes. Which directions of contact are preferred?");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--count", o.count, 3000, 10, 1e6, "grains in each bin");
        command.number("--radius", o.radius, 1e-6, 1e3, "mean radius of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient");
        command.number("--width", o.width, 5, 1e4, "of a bin, in mean diameters");
        command.number("--fall", o.fall, 5, 1e4, "height of the fall, in mean diameters");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        command.number("--rest", o.rest, 1e-9, 1e6, "time to rest [s]");
        command.number("--near", o.near, 0, 1e3,
                       "walls and floor are left out up to here, in mean diameters");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? rain<2>(command, o) : rain<3>(command, o);
    });
}
