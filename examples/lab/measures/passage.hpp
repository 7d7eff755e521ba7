// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/series/csv_series.hpp>
#include <talus/measure/force_statistics.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/stepping/step_queries.hpp>

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "../masonry/track.hpp"
#include "../picture.hpp"
#include "../plot.hpp"

namespace lab {

/// What the last step says of a track whose sleepers are the last bodies, under a wheel of that
/// load [N]. Obstacles are the first bodies, of which the ground is one. To be carried along.
struct TrackLoads {
    std::vector<double> sleepers;  ///< press on the ballast beyond their weight [N]
    double ground = 0.0;           ///< force on the obstacles, downwards [N]
    double pressing = 0.0;         ///< gravity and the wheel, less what is being braked [N]
    double gini = 0.0;             ///< of the grains' loads [-]

    TrackLoads() = default;
    TrackLoads(const talus::Simulation<2>& sim, std::size_t count, double load) : pressing(load) {
        const auto& bodies = sim.system().bodies;
        const auto& data = sim.data();
        const double g = -sim.system().gravity[1];
        const std::size_t walls = sim.system().obstacles.size(), first = bodies.count() - count;
        for (std::size_t i = walls; i < bodies.count(); ++i)
            pressing +=
                bodies.mass(i) * (g + (data.end[i].linear[1] - data.begin[i].linear[1]) / data.h);
        for (std::size_t i = first; i < bodies.count(); ++i)
            sleepers.push_back(
                talus::wrench_impulse_on(data, static_cast<talus::BodyIndex>(i)).force[1] / data.h -
                g * bodies.mass(i));
        ground = talus::impulse_from<2>(data.problem.jacobian, data.impulse,
                                        [walls](std::size_t i) { return i < walls; })[1] /
                 data.h;
        const std::vector<double> all = loads(sim);
        gini = talus::force_statistics(std::span(all).subspan(walls, first - walls)).gini;
    }

    void write(talus::NumberRecord& out) const {
        out.integer(sleepers.size() + 3);
        for (const double x : sleepers) out.real(x);
        for (const double x : {ground, pressing, gini}) out.real(x);
    }
    static TrackLoads read(talus::NumberRecordReader& in) {
        TrackLoads loads;
        for (std::size_t left = in.count(1, 0); left > 3; --left)
            loads.sleepers.push_back(in.real());
        for (double* x : {&loads.ground, &loads.pressing, &loads.gini}) *x = in.real();
        return loads;
    }
};

/// With the wheel over the middle of the rail: what each sleeper carries [N], and what it would by
/// theory.
inline void print_shares(const Track& track, const talus::Bodies<2>& bodies,
                         const std::vector<double>& carried, double load) {
    const Rail& rail = track.rail();
    const std::vector<double> now = track.heights(bodies);
    const auto moved = rail.forces(load, 0.0, now), unmoved = rail.forces(load, 0.0, rail.laid());
    std::printf(
        "share of the load: carried; by the beam on sleepers that have sunk, that have not; "
        "Zimmermann\n");
    std::printf("sleeper at [m]   sank [mm]   carried   beam     unmoved   Zimmermann\n");
    for (std::size_t k = 0; k < track.count(); ++k)
        std::printf("%14.3f   %9.3f   %7.4f   %7.4f   %7.4f   %10.4f\n", track.places()[k],
                    1e3 * (rail.laid()[k] - now[k]), carried[k] / load, -moved[k] / load,
                    -unmoved[k] / load, track.zimmermann(track.places()[k]));
}

/// What each sleeper takes while the wheel passes, over how far the wheel is from it: the rows of
/// `passage`, one for each step [s], are the wheel's place [m] and the shares.
inline void write_passage(const std::filesystem::path& folder, const Track& track,
                          const std::vector<double>& passage, double step) {
    const std::size_t count = track.count();
    std::vector<talus::CsvSeries::Column> columns{{"wheel", "m"}};
    for (std::size_t k = 0; k < count; ++k)
        columns.push_back({"share of sleeper " + std::to_string(k + 1), "-"});
    talus::CsvSeries table(folder / "passage.csv", columns);
    Curve middle{"middle sleeper", {}, {}, true}, theory{"Zimmermann", {}, {}};
    for (std::size_t row = 0; row < passage.size(); row += count + 1) {
        table.add(static_cast<double>(row / (count + 1)) * step,
                  std::span(passage).subspan(row, count + 1));
        middle.x.push_back(passage[row]);
        middle.y.push_back(passage[row + 1 + count / 2]);
        theory.x.push_back(passage[row]);
        theory.y.push_back(track.zimmermann(passage[row]));
    }
    write_plot(folder / "passage.svg",
               {"Share of the wheel's load", "wheel at [m]", "share [-]", {middle, theory}});
}

}  // namespace lab
