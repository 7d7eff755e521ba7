// SPDX-License-Identifier: BSL-1.0
//
// Two houses of cards side by side: pairs that lean on each other, and a flat card over each storey
// but the last. One has a little more friction than the least with which the one-step test finds an
// equilibrium, the other a little less. Which of them stands? For one or two storeys that least
// friction is also known in closed form.
//
// Sample runs:  examples/run card_house
//               examples/run card_house --storeys 1 --apart 0.01
//               examples/run card_house --storeys 3 --frames 50
#include "lab/masonry/card_house.hpp"

#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "lab/command.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"

namespace {

struct Options {
    double storeys = 2, length = 0.088, thickness = 3e-4, lean = 25, gap = 0.5, apart = 0.05,
           duration = 2.0, step = 5e-5;
    lab::CardHouse house() const {
        return {storeys, length, thickness, lean * std::numbers::pi / 180, gap * length};
    }
};

/// Material 0: the table; 1 and 2: cards with the friction of each house.
talus::System<2> table(const std::vector<double>& mu) {
    talus::MaterialTable<talus::DefaultLaw<2>> laws(3, {talus::Coulomb<2>{mu[0]}});
    for (const talus::MaterialIndex other : {0, 1, 2})
        laws.set(2, other, {talus::Coulomb<2>{mu[1]}});
    talus::System<2> system(laws);
    system.gravity = {0.0, -lab::CardHouse::g};
    system.add_obstacle(talus::HalfSpace<2>({0.0, 1.0}, 0.0));
    return system;
}

/// The least friction with which the one-step test finds an equilibrium.
double least_friction(const Options& o) {
    double low = 0.0, high = 2.0;
    for (int k = 0; k < 16; ++k) {
        const double mu = 0.5 * (low + high);
        talus::System<2> system = table({mu, mu});
        o.house().build(system, 0.0, 1);
        const bool stands = talus::equilibrium<2>(system).verdict == talus::Verdict::equilibrium;
        (stands ? high : low) = mu;
    }
    return high;
}

int stand(const lab::Command& command, const Options& o) {
    const double least = least_friction(o), pitch = (o.storeys + 2.0) * (1.0 + o.gap) * o.length;
    const std::vector<double> mu{least * (1 + o.apart), least * (1 - o.apart)};
    talus::System<2> system = table(mu);
    for (const int k : {0, 1}) o.house().build(system, k * pitch, k + 1);
    talus::Simulation<2> sim(std::move(system),
                             {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    const auto& bodies = sim.system().bodies;
    const std::size_t cards = (bodies.count() - 1) / 2;
    const auto top = [&](std::size_t house) { return bodies.position[(house + 1) * cards][1]; };
    const double built = top(0);

    lab::Run<2> run(command, sim, "Houses of cards");
    run.begin();
    if (!run.until(o.duration, "standing")) return run.exit_code();

    std::printf(
        "least friction by the one-step test: %.5f; by statics: %.5f (tan %.4g degrees: %.5f)\n",
        least, o.house().needed_friction(), o.lean, std::tan(o.lean * std::numbers::pi / 180));
    std::printf("friction   of the least   top sank [mm]   speed [m/s]\n");
    talus::CsvSeries rows(command.out() / "houses.csv",
                          {{"friction", "-"}, {"sunk", "m"}, {"speed", "m/s"}});
    for (std::size_t house = 0; house < 2; ++house) {
        const double speed = lab::top_speed(bodies, 1 + house * cards, cards);
        const double sunk = built - top(house);
        std::printf("%8.5f   %12.4f   %13.4f   %11.2e\n", mu[house], mu[house] / least, 1e3 * sunk,
                    speed);
        rows.add(sim.time(), {mu[house], sunk, speed});
    }
    lab::PictureParams look;
    look.title = "Houses of cards: with more friction than statics asks for, and with less";
    look.unit = o.house().weight();
    look.unit_name = "weights of a card";
    look.strongest_width = 0.05;
    look.window = {{-0.5 * pitch, -0.05 * o.length}, {1.5 * pitch, (o.storeys + 0.2) * o.length}};
    lab::write_picture<2>(command.out() / "houses.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("card_house", [&] {
        Options o;
        lab::Command command("card_house",
                             "Two houses of cards in the plane, with a little more and a little "
                             "less friction than statics asks for.");
        command.count("--storeys", o.storeys, 1, 20, "of a house");
        command.number("--length", o.length, 1e-3, 1e3, "of a card [m]");
        command.number("--thickness", o.thickness, 1e-6, 1e-3, "of a card [m]");
        command.number("--lean", o.lean, 1, 60, "of the cards from the upright [degrees]");
        command.number("--gap", o.gap, 1e-3, 1, "between neighbours, of the length [-]");
        command.number("--apart", o.apart, 1e-6, 0.9, "more and less friction by this part [-]");
        command.number("--duration", o.duration, 1e-9, 1e6, "of the run [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        return stand(command, o);
    });
}
