// SPDX-License-Identifier: BSL-1.0
//
// A dry-stone wall, a running bond of boxes, on ground that shakes as a record says, and then in a
// gust of wind. In space it is shaken across its face, in the plane along its length. How far is
// each course from where it was built, and does the wall stand? As one block it would not slide,
// nor tip, below accelerations and pressures in closed form, and slip as Newmark's block beyond
// them; a wall of one stone (--courses 1 --stones 1) is that block.
//
// Sample runs:  examples/run stone_wall
//               examples/run stone_wall --dim 2 --peak 0.7 --courses 1 --stones 1
//               examples/run stone_wall --record elcentro.txt --gust 1500
#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/simulation.hpp>

#include <cstdio>
#include <string>
#include <vector>

#include "lab/command.hpp"
#include "lab/masonry/ground_record.hpp"
#include "lab/masonry/running_bond.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"

namespace {

constexpr double g = 9.81, density = 2500.0;  // [m/s^2], [kg/m^Dim]

struct Options {
    double dim = 3, courses = 6, stones = 5, length = 0.4, height = 0.2, depth = 0.4, mu = 0.6,
           peak = 0.3, quake = 10.0, gust = 500.0, blow = 2.0, step = 1e-3;
    std::string record;
};

template <int Dim>
int shake(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    lab::GroundRecord record = o.record.empty()
                                   ? lab::made_up_earthquake(o.quake, o.peak * g, command.seed())
                                   : lab::read_ground_record(o.record);
    if (!o.record.empty() && o.peak > 0.0) record.scale_to(o.peak * g);
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}}, {.h = o.step});
    auto& system = sim.system();
    system.gravity = -g * V::Unit(Dim - 1);
    // In space across the wall.
    const auto ground =
        system.add_obstacle(talus::HalfSpace<Dim>(V::Unit(Dim - 1), 0.0),
                            lab::ground_motion<Dim>(record, lab::RunningBond<Dim>::across));
    lab::RunningBond<Dim> wall(o.courses, o.stones, o.length, o.height, o.depth, density);
    wall.build(system);
    const double begin = record.time.back() + 1.0;
    system.forces.push_back(wall.gust(system, o.gust, begin, o.blow));

    lab::Run<Dim> run(command, sim, "A dry-stone wall");
    lab::Numbers after_quake;
    run.carry("after_quake", after_quake);
    run.begin();
    const auto residual = [&] {
        return wall.residual(system.bodies, system.bodies.position[ground]);
    };
    if (!run.until(begin, "shaking")) return run.exit_code();
    if (after_quake.empty()) after_quake.values = residual();
    if (!run.until(begin + o.blow + 1.0, "blowing")) return run.exit_code();
    const std::vector<double> end = residual();

    const double across = Dim == 2 ? o.stones * o.length : o.depth, tall = o.courses * o.height;
    const double tips = across / tall, peak = record.peak() / g;
    std::printf("as one block it slides above %.3f g and rocks above %.3f g; the ground: %.3f g\n",
                o.mu, tips, peak);
    std::printf("as one block it slides above %.0f Pa and tips above %.0f Pa; the gust: %.0f Pa\n",
                o.mu * density * g * across, density * g * across * tips, o.gust);
    const double newmark = lab::newmark_slip(record, o.mu, g);
    std::printf("slip of Newmark's block in the earthquake: %.3f mm; of the base course: %.3f mm\n",
                1e3 * newmark, 1e3 * after_quake[0]);
    std::printf("course   after the earthquake [mm]   after the gust [mm]\n");
    talus::CsvSeries table(command.out() / "courses.csv",
                           {{"course", "-"}, {"after earthquake", "m"}, {"after gust", "m"}});
    for (std::size_t k = 0; k + 1 < end.size(); ++k) {
        std::printf("%6zu   %25.3f   %19.3f\n", k + 1, 1e3 * after_quake[k], 1e3 * end[k]);
        table.add(sim.time(), {static_cast<double>(k + 1), after_quake[k], end[k]});
    }
    // A stone that has come down by half its height has lost its place.
    const auto verdict = [&](double fall) {
        return fall > 0.5 * o.height ? "collapsed" : "stands";
    };
    std::printf("after the earthquake it %s, after the gust it %s\n",
                verdict(after_quake.values.back()), verdict(end.back()));

    lab::PictureParams look;
    look.title = "A dry-stone wall after an earthquake and a gust";
    look.unit = g * system.bodies.mass(1);
    look.unit_name = "stone weights";
    look.strongest_width = 0.1;
    // In space: all of it is behind the cut.
    const double shown = 0.5 * o.stones * o.length + tall;
    look.window = {{-shown, Dim == 2 ? -o.height : -shown - tall},
                   {shown, Dim == 2 ? 1.3 * tall : shown - tall}};
    lab::write_picture<Dim>(command.out() / "wall.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("stone_wall", [&] {
        Options o;
        lab::Command command("stone_wall",
                             "A dry-stone wall in an earthquake, from a record or made up, and "
                             "then in a gust of wind.");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--courses", o.courses, 1, 200, "of stones");
        command.count("--stones", o.stones, 1, 1000, "in a course");
        command.number("--length", o.length, 1e-3, 1e3, "of a stone [m]");
        command.number("--height", o.height, 1e-3, 1e3, "of a stone [m]");
        command.number("--depth", o.depth, 1e-3, 1e3, "of a stone, in space [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient [-]");
        command.file("--record", o.record,
                     "times [s] and accelerations [m/s^2], for a made-up one");
        command.number("--peak", o.peak, 0, 100,
                       "largest acceleration; 0: as the record has it [g]");
        command.number("--quake", o.quake, 0.1, 1e4, "duration of a made-up earthquake [s]");
        command.number("--gust", o.gust, 0, 1e9, "largest pressure of the gust [N/m^(dim-1)]");
        command.number("--blow", o.blow, 1e-3, 1e4, "duration of the gust [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        if (o.record.empty() && o.peak == 0.0)
            throw talus::input_error("--peak is 0, but must be positive without a --record");
        return o.dim == 2 ? shake<2>(command, o) : shake<3>(command, o);
    });
}
