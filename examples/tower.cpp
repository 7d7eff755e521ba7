// SPDX-License-Identifier: BSL-1.0
//
// A tower of planks, laid in layers crosswise. It stands; then a plank is pulled out of a layer, or
// the floor is shaken. How hard must be pulled, against the friction of what bears on the plank,
// and does the tower stand afterwards? With two planks in a layer (--planks 2) it cannot.
//
// Sample runs:  examples/run tower
//               examples/run tower --planks 2 --layers 14
//               examples/run tower --then shake --peak 0.3
#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>

#include "lab/command.hpp"
#include "lab/masonry/ground_record.hpp"
#include "lab/masonry/plank_tower.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"

namespace {

constexpr double g = 9.81, density = 600.0;  // [m/s^2], [kg/m^3]: pine
using V = talus::Vector<3>;

struct Options {
    double layers = 10, planks = 3, length = 0.117, width = 0.0234, height = 0.0078, mu = 0.4,
           stand = 2.0, then = 0, layer = 4, rate = 0.2, peak = 0.3, quake = 5.0, after = 2.0,
           step = 1e-3;
};

/// The floor rests while the tower is to stand, and then shakes along axis 0.
talus::PrescribedMotion<3> floor_motion(const Options& o, std::uint64_t seed) {
    if (o.then == 0) return {};
    const lab::GroundRecord record = lab::made_up_earthquake(o.quake, o.peak * g, seed);
    return lab::ground_motion<3>(record, 0, o.stand);
}

/// A pull along the plank that grows in time, until the plank has gone its length.
talus::ForceField<3> pull(const Options& o, const lab::PlankTower& tower, std::size_t plank,
                          const V& along) {
    return [=](double t, const talus::Bodies<3>& bodies, std::span<talus::Wrench<3>> wrenches) {
        if (t < o.stand || tower.way(bodies, plank).dot(along) > o.length) return;
        wrenches[plank].force += o.rate * (t - o.stand) * along;
    };
}

int stand(const lab::Command& command, const Options& o) {
    talus::Simulation<3> sim({talus::Coulomb<3>{o.mu}},
                             {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -g * V::Unit(2);
    system.add_obstacle(talus::HalfSpace<3>(V::Unit(2), 0.0), floor_motion(o, command.seed()));
    lab::PlankTower tower(o.layers, o.planks, {o.length, o.width, o.height});
    tower.build(system, density);
    const auto& bodies = system.bodies;
    const std::size_t plank = tower.middle_of(o.layer);
    const V along = bodies.pose(plank).rotation * V::Unit(0);
    if (o.then == 0) system.forces.push_back(pull(o, tower, plank, along));

    lab::Run<3> run(command, sim, "A tower of planks");
    // How far it sank while it was to stand [m]; of the moment when the plank slipped the sum of
    // the normal forces on it and the pull [N].
    lab::Numbers found{{0.0, std::nan(""), std::nan("")}};
    run.carry("found", found);
    run.begin();
    if (!run.until(o.stand, "standing", [&] { found[0] = tower.sunk(bodies, plank); }))
        return run.exit_code();
    const double weight = g * bodies.mass(plank), above = (o.layers - o.layer) * o.planks * weight;
    const double most = o.mu * (2.0 * above + weight);  // if this plank alone carries all
    const double time = o.then == 0 ? most / o.rate : o.quake;
    const bool whole =
        run.until(o.stand + time + o.after, o.then == 0 ? "pulling" : "shaking", [&] {
            const double way = tower.way(bodies, plank).dot(along);
            if (!std::isnan(found[2]) || o.then != 0 || way < 1e-3 * o.length) return;
            found[1] = lab::loads(sim)[plank];
            found[2] = o.rate * (sim.time() - o.stand);
        });
    if (!whole) return run.exit_code();

    std::printf("after %.4g s of standing the tower had sunk by %.6f mm\n", o.stand,
                1e3 * found[0]);
    if (o.then == 0) {
        std::printf(
            "the plank slipped at a pull of %.4f N; mu times the forces on it then: %.4f N; if it "
            "bore its part of what is above: %.4f N\n",
            found[2], o.mu * found[1], o.mu * (2.0 * above / o.planks + weight));
    } else {
        std::printf(
            "the floor: %.3f g; as one block it would slide above %.3f g and rock above "
            "%.3f g\n",
            o.peak, o.mu, o.length / (o.layers * o.height));
    }
    const double end = tower.sunk(bodies, plank);  // without the plank
    std::printf("then it sank by %.4f mm and %s\n", 1e3 * end,
                end > 0.5 * o.height ? "fell" : "stands");
    talus::CsvSeries table(command.out() / "tower.csv",
                           {{"sunk standing", "m"}, {"pull", "N"}, {"sunk", "m"}});
    table.add(sim.time(), {found[0], found[2], end});
    lab::PictureParams look;
    look.title = "A tower of planks";
    look.unit = weight;
    look.unit_name = "weights of a plank";
    look.strongest_width = 0.1;
    // All of it is behind the cut.
    look.window = {{-1.5 * o.length, -3.0 * o.length}, {1.5 * o.length, o.length}};
    lab::write_picture<3>(command.out() / "tower.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("tower", [&] {
        Options o;
        lab::Command command("tower",
                             "A tower of planks, laid crosswise, from which a plank is pulled, or "
                             "whose floor is shaken.");
        command.count("--layers", o.layers, 25, 1, 1000, "of planks");
        command.count("--planks", o.planks, 2, 100, "in a layer");
        command.number("--length", o.length, 1e-3, 1e3, "of a plank [m]");
        command.number("--width", o.width, 1e-3, 1e3, "of a plank [m]");
        command.number("--height", o.height, 1e-3, 1e3, "of a plank [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient [-]");
        command.number("--stand", o.stand, 60, 1e-3, 1e6, "time for which it is to stand [s]");
        command.choice("--then", o.then, {"pull", "shake"}, "what comes then");
        command.count("--layer", o.layer, 1, 1000, "from which a plank is pulled");
        command.number("--rate", o.rate, 1e-6, 1e6, "by which the pull grows [N/s]");
        command.number("--peak", o.peak, 1e-6, 100, "largest acceleration of the floor [g]");
        command.number("--quake", o.quake, 0.1, 1e4, "for which it is shaken [s]");
        command.number("--after", o.after, 1e-3, 1e4, "time for it to fall [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        if (o.layer > o.layers)
            throw talus::input_error("--layer is above the tower, but must be one of --layers");
        if (o.planks * o.width > o.length)
            throw talus::input_error("--planks do not find room side by side on --length");
        return stand(command, o);
    });
}
