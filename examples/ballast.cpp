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
#include <talus/io/series/csv_series.hpp>
#include <talus/measure/force_statistics.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/sample/container.hpp>
#include <talus/stepping/simulation.hpp>
#include <talus/stepping/step_queries.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "lab/command.hpp"
#include "lab/masonry/rail.hpp"
#include "lab/picture.hpp"
#include "lab/plot.hpp"
#include "lab/run.hpp"
#include "lab/samples/grains.hpp"

namespace {

constexpr double g = 9.81;  // [m/s^2]

struct Options {
    double grains = 600, radius = 0.02, sleepers = 5, spacing = 0.6, load = 50e3, bending = 6.4e6,
           pad = 5e7, mu = 0.8, pressure = 5e4, speed = 6.0, rest = 0.3, step = 5e-4;
};

/// Where the wheel is: from the first sleeper, where its load grows, over the last one and back to
/// the middle [m, N].
struct Wheel {
    Options o;
    double begin;  // [s]
    double grown() const { return begin + 0.1; }
    double half() const { return 0.5 * (o.sleepers - 1.0) * o.spacing; }  // of the rail [m]
    double stops() const { return grown() + 3.0 * half() / o.speed; }
    double load(double t) const {
        const double part = std::clamp((t - begin) / (grown() - begin), 0.0, 1.0);
        return o.load * part * part * (3.0 - 2.0 * part);
    }
    double place(double t) const {
        const double way = std::clamp(o.speed * (t - grown()), 0.0, 3.0 * half());
        return half() - std::abs(way - 2.0 * half());
    }
};

talus::Simulation<2> dry_track(const Options& o) {
    const talus::Vector<2> low(-0.5 * o.sleepers * o.spacing, 0.0);
    talus::Simulation<2> sim({talus::Coulomb<2>{o.mu}},
                             {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    // Some steps need it: the wheel weighs as much as thousands of grains.
    sim.solver().params.max_iterations = 200000;
    sim.system().gravity = {0.0, -g};
    for (const auto& wall : talus::container<2>(low, {-low[0], 1.0}))
        sim.system().add_obstacle(wall);
    return sim;
}

/// Sleepers of concrete, each a little above the highest grain under it.
void lay_sleepers(talus::System<2>& system, const Options& o, const std::vector<double>& places) {
    const talus::Vector<2> half(0.15, 0.1);
    const std::size_t below = system.bodies.count();
    for (const double x : places) {
        double top = 0.0;
        for (std::size_t i = 3; i < below; ++i) {
            const auto& at = system.bodies.position[i];
            const double reach = system.bounding_radius()[i];
            if (std::abs(at[0] - x) < half[0] + reach) top = std::max(top, at[1] + reach);
        }
        system.add(talus::Box<2>(half), 2400.0, {{x, top + half[1] + 0.1 * o.radius}, {}});
    }
}

/// What the last step says: of each sleeper how much it presses on the ballast beyond its weight
/// [N], then the force on the ground [N], what gravity and the wheel press less what is being
/// braked [N], and the Gini coefficient of the grains' loads.
std::vector<double> measure(const talus::Simulation<2>& sim, std::size_t first, double load) {
    const auto& bodies = sim.system().bodies;
    const auto& data = sim.data();
    std::vector<double> found;
    double pressing = load;
    for (std::size_t i = 3; i < bodies.count(); ++i) {
        pressing +=
            bodies.mass(i) * (g + (data.end[i].linear[1] - data.begin[i].linear[1]) / data.h);
        if (i >= first)
            found.push_back(
                talus::wrench_impulse_on(data, static_cast<talus::BodyIndex>(i)).force[1] / data.h -
                g * bodies.mass(i));
    }
    const auto ground = talus::impulse_from<2>(data.problem.jacobian, data.impulse,
                                               [](std::size_t i) { return i < 3; });
    found.push_back(ground[1] / data.h);
    found.push_back(pressing);
    const std::vector<double> loads = lab::loads(sim);
    found.push_back(talus::force_statistics(std::span(loads).subspan(3, first - 3)).gini);
    return found;
}

/// What each sleeper takes while the wheel passes, over how far the wheel is from it: the rows of
/// `passage` are the wheel's place and the shares.
void write_passage(const lab::Command& command, const Options& o, const std::vector<double>& places,
                   const std::vector<double>& passage) {
    const std::size_t n = places.size();
    std::vector<talus::CsvSeries::Column> columns;
    for (std::size_t k = 0; k < n; ++k)
        columns.push_back({"share of sleeper " + std::to_string(k + 1), "-"});
    columns.insert(columns.begin(), {"wheel", "m"});
    talus::CsvSeries table(command.out() / "passage.csv", columns);
    lab::Curve middle{"middle sleeper", {}, {}, true}, theory{"Zimmermann", {}, {}};
    for (std::size_t row = 0; row < passage.size(); row += n + 1) {
        table.add(static_cast<double>(row / (n + 1)) * o.step,
                  std::span(passage).subspan(row, n + 1));
        middle.x.push_back(passage[row]);
        middle.y.push_back(passage[row + 1 + n / 2]);
        theory.x.push_back(passage[row]);
        theory.y.push_back(lab::zimmermann_share(passage[row], o.spacing, o.bending, o.pad));
    }
    lab::write_plot(command.out() / "passage.svg",
                    {"Share of the wheel's load", "wheel at [m]", "share [-]", {middle, theory}});
}

/// A plate that goes up and down alone, to be pressed on the bed, which makes it level.
void lay_plate(talus::System<2>& system, const Options& o) {
    const talus::Vector<2> half(0.499 * o.sleepers * o.spacing, 0.05);
    double top = 0.0;
    for (std::size_t i = 3; i < system.bodies.count(); ++i)
        top = std::max(top, system.bodies.position[i][1] + system.bounding_radius()[i]);
    const auto plate = system.add(talus::Box<2>(half), 2400.0, {{0.0, top + half[1]}, {}});
    system.bodies.lock(plate, talus::LockedAxes<2>::all_but_translation(1));
}

int pass(const lab::Command& command, const Options& o) {
    talus::Simulation<2> sim = dry_track(o);
    auto& system = sim.system();
    const auto n = static_cast<std::size_t>(o.sleepers);
    std::vector<double> places;
    for (std::size_t k = 0; k < n; ++k)
        places.push_back((static_cast<double>(k) - 0.5 * (o.sleepers - 1.0)) * o.spacing);
    const double side = 0.5 * o.sleepers * o.spacing - 1.5 * o.radius;
    const double above = 6.0 * o.grains * o.radius * o.radius / (o.sleepers * o.spacing) + 0.2;
    talus::Inlet<2> inlet(
        {.place = talus::in_box<2>({-side, above}, {side, above + 0.2}),
         .shape = lab::angular_grains<2>(talus::UniformRadii(0.7 * o.radius, 1.3 * o.radius)),
         .density = 2700.0,
         .rate = 1000.0,
         .total = static_cast<std::int64_t>(o.grains),
         .velocity = {0.0, -1.0},
         .seed = command.seed()});
    lab::Rail rail(places, o.bending, o.pad);
    const auto heights = [n](const talus::Bodies<2>& bodies) {
        std::vector<double> z;
        for (std::size_t i = bodies.count() - n; i < bodies.count(); ++i)
            z.push_back(bodies.position[i][1]);
        return z;
    };
    lab::Mark poured, levelled, laid, fastened;
    lab::Numbers measured, passage;
    system.forces.push_back(
        [&](double t, const talus::Bodies<2>& bodies, std::span<talus::Wrench<2>> wrenches) {
            if (levelled.time < t && t < laid.time) {
                const double grown = std::min(1.0, 2.0 * (t - levelled.time) / o.rest);
                wrenches.back().force[1] -= grown * o.pressure * o.sleepers * o.spacing;
            }
            if (laid.time < t && !rail.fastened()) {
                // As trains before did: sleepers are pressed in by what they will bear.
                const double part = std::clamp((t - laid.time) / (0.7 * o.rest), 0.0, 1.0);
                const double press = std::sin(std::numbers::pi * part);
                for (std::size_t k = 0; k < n; ++k)
                    wrenches[bodies.count() - n + k].force[1] -= press * press * o.load;
            }
            if (!rail.fastened()) return;
            const Wheel wheel{o, fastened.time};
            const auto force = rail.forces(wheel.load(t), wheel.place(t), heights(bodies));
            for (std::size_t k = 0; k < n; ++k)
                wrenches[bodies.count() - n + k].force[1] += force[k];
        });

    lab::Run<2> run(command, sim, "Railway ballast");
    run.carry("inlet", inlet);
    run.carry("rail", rail);
    run.carry("poured", poured);
    run.carry("levelled", levelled);
    run.carry("laid", laid);
    run.carry("fastened", fastened);
    run.carry("measured", measured);
    run.carry("passage", passage);
    run.begin();
    const auto pour = [&] {
        inlet.feed(system, sim.time());
        if (inlet.done()) poured.time = std::min(poured.time, sim.time());
    };
    if (!run.until([&] { return inlet.done(); }, o.grains / 1000.0, "pouring", pour) ||
        !run.until(poured.time + o.rest, "settling"))
        return run.exit_code();
    if (levelled.time > sim.time()) {
        levelled.time = sim.time();
        lay_plate(system, o);
    }
    if (!run.until(levelled.time + o.rest, "levelling")) return run.exit_code();
    if (laid.time > sim.time()) {
        laid.time = sim.time();
        system.remove(system.bodies.id.back());
        lay_sleepers(system, o, places);
    }
    if (!run.until(laid.time + o.rest, "laying sleepers")) return run.exit_code();
    if (!rail.fastened()) {
        fastened.time = sim.time();
        rail.fasten(heights(system.bodies));
    }
    const Wheel wheel{o, fastened.time};
    const std::size_t first = system.bodies.count() - n;
    const bool whole = run.until(wheel.stops() + o.rest, "the wheel passes", [&] {
        measured.values = measure(sim, first, wheel.load(sim.time() - 0.5 * o.step));
        if (sim.time() < wheel.grown() || sim.time() > wheel.grown() + 2.0 * wheel.half() / o.speed)
            return;
        passage.values.push_back(wheel.place(sim.time()));
        for (std::size_t k = 0; k < n; ++k) passage.values.push_back(measured[k] / o.load);
    });
    if (!whole) return run.exit_code();

    // The wheel rests on the middle of the rail.
    lab::Rail unmoved(places, o.bending, o.pad);
    const auto rigid = unmoved.forces(o.load, 0.0, places);
    const std::vector<double> now = heights(system.bodies);
    const auto moved = rail.forces(o.load, 0.0, now);
    std::printf(
        "share of the load: carried; by the beam on sleepers that have sunk, that have not; "
        "Zimmermann\n");
    std::printf("sleeper at [m]   sank [mm]   carried   beam     unmoved   Zimmermann\n");
    for (std::size_t k = 0; k < n; ++k)
        std::printf("%14.3f   %9.3f   %7.4f   %7.4f   %7.4f   %10.4f\n", places[k],
                    1e3 * (rail.laid()[k] - now[k]), measured[k] / o.load, -moved[k] / o.load,
                    -rigid[k] / o.load,
                    lab::zimmermann_share(places[k], o.spacing, o.bending, o.pad));
    const double ground = measured[n], pressing = measured[n + 1];
    double weight = o.load;
    for (std::size_t i = 3; i < system.bodies.count(); ++i) weight += g * system.bodies.mass(i);
    std::printf("force on the ground over load and weight: %.6f; less what still moves: %.9f\n",
                ground / weight, ground / pressing);
    std::printf("Gini coefficient of the loads of grains: %.3f (G22: above 0.3)\n",
                measured[n + 2]);
    write_passage(command, o, places, passage.values);

    lab::PictureParams look;
    look.title = "Railway ballast: the wheel is on the middle sleeper";
    look.captions = {"Grey by load, the sum of the normal forces."};
    look.unit = o.load;
    look.unit_name = "wheel loads";
    look.window = {{places[0] - 0.5 * o.spacing, -0.03},
                   {places[n - 1] + 0.5 * o.spacing, system.bodies.position[first][1] + 0.2}};
    lab::write_picture<2>(command.out() / "ballast.svg", sim, look);
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
        command.count("--sleepers", o.sleepers, 9, 3, 999, "an odd number");
        command.number("--spacing", o.spacing, 0.3, 100, "of sleepers [m]");
        command.number("--load", o.load, 0, 1e9, "of the wheel [N]");
        command.number("--bending", o.bending, 1e-3, 1e15, "stiffness EI of the rail [N m^2]");
        command.number("--pad", o.pad, 1, 1e12, "stiffness of a pad under the rail [N/m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient [-]");
        command.number("--pressure", o.pressure, 1, 1e9, "by which the bed is made level [N/m]");
        command.number("--speed", o.speed, 1e-3, 100, "of the wheel [m/s]");
        command.number("--rest", o.rest, 1e-3, 1e4, "time to settle after each change [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        if (std::fmod(o.sleepers, 2.0) != 1.0)
            throw talus::input_error("--sleepers must be odd, so that one is in the middle");
        return pass(command, o);
    });
}
