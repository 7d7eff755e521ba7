// SPDX-License-Identifier: BSL-1.0
//
// Rows of dominoes, the first of each pushed over: how fast does the wave run? Rows of several
// spacings, and one of dominoes twice as high, against J. M. J. van Leeuwen's steady wave for
// dominoes without friction between them (lab/masonry/domino_wave.hpp). By dimensions alone the
// speed is sqrt(g h) times a number of the row's proportions. In that theory the edge on which a
// plate turns stays where it is; beyond a spacing of 0.4 h the ground would have to pull it down
// before the hit, which may be why waves are a little slower than it says.
//
// Sample runs:  examples/run dominoes
//               examples/run dominoes --dim 3 --count 30
//               examples/run dominoes --mu 0.2 --frames 50
#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lab/command.hpp"
#include "lab/masonry/domino_row.hpp"
#include "lab/masonry/domino_wave.hpp"
#include "lab/picture.hpp"
#include "lab/plot.hpp"
#include "lab/run.hpp"

namespace {

constexpr double g = 9.81;  // [m/s^2]

struct Options {
    double dim = 2, count = 30, height = 0.048, thickness = 0.15, narrow = 0.35, wide = 0.65,
           rows = 3, mu = 0.0, floor_mu = 10.0, push = 1.0, step = 1e-4;
};

template <int Dim>
int topple(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(2, {talus::Coulomb<Dim>{o.floor_mu}});
    laws.set(1, 1, {talus::Coulomb<Dim>{o.mu}});
    talus::Simulation<Dim> sim(laws, {.h = o.step});
    auto& system = sim.system();
    system.gravity = -g * V::Unit(Dim - 1);
    system.add_obstacle(talus::HalfSpace<Dim>(V::Unit(Dim - 1), 0.0));

    std::vector<lab::DominoRow> rows;
    double begin = 0.0, duration = 0.0;
    const int different = static_cast<int>(o.rows);
    for (int k = 0; k <= different; ++k) {  // the last one: the middle one at twice the size
        const bool twice = k == different;
        const double share = (twice ? different / 2 : k) / std::max(1.0, o.rows - 1.0);
        const double h = twice ? 2.0 * o.height : o.height;
        const double spacing = (o.narrow + share * (o.wide - o.narrow)) * h;
        const auto count = static_cast<std::size_t>(o.count);
        rows.push_back({h, o.thickness * h, spacing, begin, count});
        rows.back().add_to(system, -o.push * std::sqrt(g / h), 1);
        const double length = o.count * (spacing + o.thickness * h);
        begin += length + 3.0 * h;
        duration = std::max(duration, 1.2 * length / std::sqrt(g * h) + 20.0 * std::sqrt(h / g));
    }
    // When each body had turned by its first 2 degrees [s].
    lab::Numbers times{std::vector<double>(system.bodies.count(), lab::Mark{}.time)};

    lab::Run<Dim> run(command, sim, "Dominoes");
    run.carry("times", times);
    run.begin();
    const auto all_down = [&] {
        for (const lab::DominoRow& row : rows)
            if (!(times[row.last()] <= sim.time())) return sim.time() > 3.0 * duration;
        return true;
    };
    const bool whole = run.until(all_down, duration, "falling", [&] {
        for (std::size_t i = 1; i < system.bodies.count(); ++i) {
            if (times[i] <= sim.time()) continue;
            const V up = system.bodies.pose(i).rotation * V::Unit(Dim - 1);
            if (up[Dim - 1] < std::cos(0.035)) times[i] = sim.time();
        }
    });
    if (!whole) return run.exit_code();

    lab::Curve measured{"measured", {}, {}, true}, theory{"theory, no friction between", {}, {}};
    talus::CsvSeries table(
        command.out() / "speed.csv",
        {{"spacing over height", "-"}, {"speed over sqrt(gh)", "-"}, {"theory", "-"}});
    std::printf("height [mm]   spacing/height   speed [m/s]   speed/sqrt(gh)   theory\n");
    double reference = 0.0, twice = 0.0;
    for (const lab::DominoRow& row : rows) {
        const double speed = row.speed(times.values), unit = std::sqrt(g * row.height);
        const double s = row.spacing / row.height, law = lab::domino_wave(s, o.thickness);
        std::printf("%11.4g   %14.4f   %11.4f   %14.4f   %6.4f\n", 1e3 * row.height, s, speed,
                    speed / unit, law);
        table.add(sim.time(), {s, speed / unit, law});
        measured.x.push_back(s), measured.y.push_back(speed / unit);
        if (&row == &rows.back()) twice = speed / unit;
        if (&row == &rows[static_cast<std::size_t>(different / 2)]) reference = speed / unit;
    }
    std::printf("twice the size: speed/sqrt(gh) is %.4f times that of the same row; law: 1\n",
                twice / reference);
    for (int k = 0; k <= 60; ++k) {
        theory.x.push_back(o.narrow + k / 60.0 * (o.wide - o.narrow));
        theory.y.push_back(lab::domino_wave(theory.x.back(), o.thickness));
    }
    lab::write_plot(command.out() / "speed.svg", {"Speed of a wave of dominoes",
                                                  "spacing / height",
                                                  "speed / sqrt(g h)",
                                                  {measured, theory}});
    lab::PictureParams look;
    look.title = "Dominoes";
    look.unit = g * system.bodies.mass(1);
    look.unit_name = "weights";
    const double length = rows[1].begin;
    look.window = {{-2.0 * o.height, Dim == 2 ? -0.3 * o.height : -2.0 * o.height},
                   {length, Dim == 2 ? 4.0 * o.height : 2.0 * o.height}};
    lab::write_picture<Dim>(command.out() / "dominoes.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("dominoes", [&] {
        Options o;
        lab::Command command("dominoes",
                             "Rows of dominoes of several spacings, the first of each pushed over, "
                             "and a row twice as high: speed of the wave.");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--count", o.count, 100, 6, 1e4, "dominoes in a row");
        command.number("--height", o.height, 1e-6, 1e3, "of a domino [m]");
        command.number("--thickness", o.thickness, 1e-3, 0.5, "of a domino, of its height [-]");
        command.number("--narrow", o.narrow, 1e-3, 0.95, "smallest spacing, of the height [-]");
        command.number("--wide", o.wide, 1e-3, 0.95, "largest spacing, of the height [-]");
        command.count("--rows", o.rows, 1, 100, "rows of different spacing");
        command.number("--mu", o.mu, 0, 1e3, "friction between dominoes [-]");
        command.number("--floor-mu", o.floor_mu, 0, 1e3, "friction on the floor [-]");
        command.number("--push", o.push, 0, 100, "speed of the first one's top, of sqrt(g h) [-]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? topple<2>(command, o) : topple<3>(command, o);
    });
}
