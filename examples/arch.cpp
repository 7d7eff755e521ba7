// SPDX-License-Identifier: BSL-1.0
//
// Semicircular arches of voussoirs without mortar, side by side: one thicker than the least
// thickness with which such an arch stands (0.1075 of the radius), one of that thickness, one
// thinner. Which of them stand, and by which hinges do they fall? Before that the one-step test of
// equilibrium answers for each.
//
// Sample runs:  examples/run arch
//               examples/run arch --dim 3 --voussoirs 10
//               examples/run arch --apart 0.002 --duration 6
#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "lab/command.hpp"
#include "lab/masonry/hinges.hpp"
#include "lab/masonry/sector.hpp"
#include "lab/masonry/upright.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"

namespace {

struct Options {
    double dim = 2, voussoirs = 20, radius = 1.0, apart = 0.02, mu = 1.0, depth = 0.3,
           duration = 3.0, step = 1e-3;
};

template <int Dim>
void add_arch(talus::System<Dim>& system, const Options& o, double thickness, double centre) {
    const double half = 0.5 * std::numbers::pi / o.voussoirs, t = 0.5 * thickness * o.radius;
    const lab::Voussoir<Dim> stone(o.radius - t, o.radius + t, half, o.depth * o.radius, 2400.0);
    for (int k = 0; k < static_cast<int>(o.voussoirs); ++k)
        system.add(stone.shape(), stone.inertia, stone.pose(centre, (2 * k + 1) * half));
}

template <int Dim>
talus::System<Dim> ground(const Options& o) {
    talus::System<Dim> system(talus::DefaultLaw<Dim>{talus::Coulomb<Dim>{o.mu}});
    system.gravity = -9.81 * talus::Vector<Dim>::Unit(Dim - 1);
    system.add_obstacle(talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(Dim - 1), 0.0));
    return system;
}

template <int Dim>
int stand(const lab::Command& command, const Options& o) {
    const auto n = static_cast<std::size_t>(o.voussoirs);
    const double least = lab::least_arch_thickness(static_cast<int>(n)), pitch = 3.0 * o.radius;
    const std::vector<double> thickness{least * (1 + o.apart), least, least * (1 - o.apart)};
    talus::System<Dim> system = ground<Dim>(o);
    std::vector<std::string> verdicts;
    for (std::size_t k = 0; k < thickness.size(); ++k) {
        talus::System<Dim> alone = ground<Dim>(o);
        add_arch<Dim>(alone, o, thickness[k], 0.0);
        verdicts.emplace_back(to_string(talus::equilibrium<Dim>(alone).verdict));
        add_arch<Dim>(system, o, thickness[k], static_cast<double>(k) * pitch);
    }
    talus::Simulation<Dim> sim(std::move(system), {.h = o.step});
    const auto& bodies = sim.system().bodies;
    const auto crown = [&](std::size_t arch) {
        return bodies.position[1 + arch * n + n / 2][Dim - 1];
    };
    std::vector<double> built;
    for (std::size_t k = 0; k < thickness.size(); ++k) built.push_back(crown(k));

    lab::Run<Dim> run(command, sim, "Arches");
    std::vector<lab::Fall> falls(thickness.size());  // by a fiftieth of the radius
    for (std::size_t k = 0; k < falls.size(); ++k) run.carry("fall" + std::to_string(k), falls[k]);
    run.begin();
    const auto draw = [&](const std::string& name, std::size_t from, std::size_t to) {
        const double left = static_cast<double>(from) * pitch, low = Dim == 2 ? 0.1 : 1.2;
        lab::PictureParams look;
        look.title = "Arches of loose stones";
        look.unit = 9.81 * bodies.mass(1);
        look.unit_name = "weights of a voussoir";
        look.window = {{left - 1.2 * o.radius, -low * o.radius},
                       {static_cast<double>(to) * pitch + 1.2 * o.radius, 1.2 * o.radius}};
        lab::write_picture<Dim>(command.out() / (name + ".svg"), sim, look);
    };
    const bool whole = run.until(o.duration, "standing", [&] {
        for (std::size_t k = 0; k < falls.size(); ++k)
            if (falls[k].joints.empty() && crown(k) < built[k] - 0.02 * o.radius) {
                falls[k] = {sim.time(), lab::open_joints<Dim>(bodies, 1 + k * n, n)};
                draw("arch-" + std::to_string(k + 1) + "-falls", k, k);
            }
    });
    if (!whole) return run.exit_code();

    std::printf("least thickness of an arch of %zu voussoirs: %.6f R (of many: 0.107478)\n", n,
                least);
    std::printf(
        "thickness/R   of the least   one-step test   crown sank [mm]   speed [m/s]   fell at "
        "[s]\n");
    talus::CsvSeries table(command.out() / "arches.csv",
                           {{"thickness", "R"}, {"sunk", "m"}, {"speed", "m/s"}, {"fell", "s"}});
    for (std::size_t k = 0; k < thickness.size(); ++k) {
        const double speed = lab::top_speed(bodies, 1 + k * n, n);
        const double sunk = built[k] - crown(k);
        std::printf("%11.6f   %12.4f   %13s   %15.4f   %11.2e   %11.3f\n", thickness[k],
                    thickness[k] / least, verdicts[k].c_str(), 1e3 * sunk, speed, falls[k].time);
        table.add(sim.time(), {thickness[k], sunk, speed, falls[k].time});
        if (!falls[k].joints.empty())
            std::printf("  hinges, in degrees from the right springing: %s\n",
                        lab::hinges(falls[k].joints).c_str());
    }
    draw("arches", 0, 2);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("arch", [&] {
        Options o;
        lab::Command command("arch",
                             "Semicircular arches of voussoirs, thicker than the least thickness "
                             "with which they stand, as thick, and thinner.");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--voussoirs", o.voussoirs, 4, 200, "of an arch, an even number");
        command.number("--radius", o.radius, 1e-3, 1e3, "mean radius [m]");
        command.number("--apart", o.apart, 1e-6, 0.9, "thicker and thinner by this part [-]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient [-]");
        command.number("--depth", o.depth, 1e-3, 1e3, "in space, over the radius [-]");
        command.number("--duration", o.duration, 1e-9, 1e6, "of the run [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        if (std::fmod(o.voussoirs, 2.0) != 0.0)
            throw talus::input_error("--voussoirs must be even, so that a joint is at the crown");
        return o.dim == 2 ? stand<2>(command, o) : stand<3>(command, o);
    });
}
