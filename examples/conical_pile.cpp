// SPDX-License-Identifier: BSL-1.0
//
// A heap from a point source on a rough floor, after section 3.5 of Moreau's paper: 14,000 spheres
// with --full. Where does it press on the ground, and is that less under the summit? The pressure
// by rings, and the slope. --rain 1 lets the same grains fall evenly on a disc, for comparison.
//
// Sample runs:  examples/run conical_pile
//               examples/run conical_pile --dim 2 --count 2000
//               examples/run conical_pile --full --out cone
#include <talus/feed/inlet.hpp>
#include <talus/measure/rings.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "lab/command.hpp"
#include "lab/measures/heap_cuts.hpp"
#include "lab/measures/ring_profile.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/pour.hpp"
#include "lab/samples/rough_floor.hpp"
#include "lab/table.hpp"

namespace {

constexpr double degree = 180.0 / std::numbers::pi;

struct Options {
    double dim = 3, count = 1500, radius = 0.005, mu = 0.5, rate = 1000, step = 1e-3, rest = 2.0,
           rain = 0;
};

/// Half the width that a heap of that many grains will have, at a slope of 20 degrees [m].
template <int Dim>
double expected_radius(double count, double radius) {
    const double slope = std::tan(20.0 * std::numbers::pi / 180.0), solid = Dim == 2 ? 0.8 : 0.6;
    return Dim == 2 ? std::sqrt(count * std::numbers::pi * radius * radius / solid / slope)
                    : radius * std::cbrt(4.0 * count / solid / slope);
}

template <int Dim>
int pile_up(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    constexpr int up = Dim - 1;
    const double reach = 1.5 * expected_radius<Dim>(o.count, o.radius);
    const talus::UniformRadii radii(0.8 * o.radius, 1.2 * o.radius);

    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}, 0.0, 0.0},
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}});
    auto& system = sim.system();
    system.gravity = -9.81 * V::Unit(up);
    lab::add_rough_floor<Dim>(system, radii, reach, command.seed() + 1);
    const std::size_t ground = system.bodies.count();

    V source = V::Zero();
    source[up] = 0.5 * reach + 10.0 * o.radius;
    talus::Inlet<Dim> inlet({.place = talus::in_disc<Dim>(
                                 source, o.rain != 0 ? 0.6 * reach : 4.0 * o.radius, V::Unit(up)),
                             .shape = talus::balls<Dim>(radii),
                             .rate = o.rate,
                             .total = static_cast<std::int64_t>(o.count),
                             .velocity = -0.5 * V::Unit(up),
                             .seed = command.seed()});
    const std::size_t rings = 12;
    talus::GroundPressure<Dim> pressure(talus::Rings<Dim>(V::Zero(), reach / 1.5 / rings, 18));

    lab::Run<Dim> run(command, sim, "A heap from a point source");
    lab::Mark poured;
    run.carry("inlet", inlet);
    run.carry("poured", poured);
    run.carry("pressure", pressure);
    run.begin();
    if (!lab::pour(run, sim, inlet, poured, o.count / o.rate, "pouring")) return run.exit_code();
    std::vector<V> forces;
    const bool whole = run.until(poured.time + o.rest, "resting", [&] {
        if (sim.time() < poured.time + 0.5 * o.rest) return;  // until it has come to rest
        const auto& jacobian = sim.data().problem.jacobian;
        talus::contact_forces<Dim>(jacobian, sim.data().impulse, o.step, forces);
        pressure.record(jacobian, forces, system.bodies, [&](std::size_t i) { return i < ground; });
    });
    if (!whole) return run.exit_code();

    // The profile, against the weight of what is above each ring.
    double weight = 0.0, grain = 0.0;
    for (std::size_t i = ground; i < system.bodies.count(); ++i)
        weight += 9.81 * system.bodies.mass(i);
    grain = weight / static_cast<double>(system.bodies.count() - ground);
    const auto heights =
        talus::surface_heights(pressure.rings(), system.bodies, system.half_thickness(),
                               [&](std::size_t i) { return i >= ground; });
    const lab::RingProfile<Dim> profile(pressure, heights);
    profile.print();
    profile.write(command.out());
    std::printf("%lld grains; the ground carries %.4f of their weight\n",
                static_cast<long long>(inlet.count()), pressure.force() / weight);
    std::vector<lab::Finding> findings;
    if (profile.sloped()) {
        const talus::LineFit& slope = profile.slope();
        std::printf("slope %.1f degrees; pressure under the summit over the largest: %.2f\n",
                    slope.angle() * degree, profile.under_summit());
        // Half-way down the flank, three grains deep, over six.
        const lab::HeapCuts<Dim> cuts(sim, slope, 0.5 * profile.radius(), 6.0 * o.radius,
                                      6.0 * o.radius, o.radius);
        cuts.print(weight);
        findings = cuts.findings();
        findings.push_back({"pressure under the summit", "largest", profile.under_summit()});
    }
    findings.push_back({"carried by the ground", "weight", pressure.force() / weight});
    lab::write_findings(command.out(), findings);

    lab::PictureParams look;
    look.title = "A heap from a point source on a rough floor";
    look.unit = grain;
    look.unit_name = "mean weights";
    const double shown = 0.8 * reach, floor = Dim == 2 ? -2.0 * o.radius : -shown;
    look.window = {{-shown, floor}, {shown, Dim == 2 ? 0.45 * shown : shown}};
    lab::write_picture<Dim>(command.out() / "heap.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("conical_pile", [&] {
        Options o;
        lab::Command command("conical_pile",
                             "Grains fall from a point source onto a rough floor and form a heap, "
                             "whose weight on the ground is measured by rings.");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.count("--count", o.count, 14000, 10, 1e6, "grains");
        command.number("--radius", o.radius, 1e-6, 1e3, "mean radius of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient");
        command.number("--rate", o.rate, 1e-3, 1e6, "grains that fall in a second [1/s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        command.number("--rest", o.rest, 1e-9, 1e6,
                       "time to rest, and be measured in the second half [s]");
        command.count("--rain", o.rain, 0, 1,
                      "1: an even rain on a disc instead of a point source");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? pile_up<2>(command, o) : pile_up<3>(command, o);
    });
}
