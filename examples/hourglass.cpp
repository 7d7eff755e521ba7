// SPDX-License-Identifier: BSL-1.0
//
// Beverloo's law: grains flow out of a silo through a slit, in space through a round opening, and
// come in again at the top. The flow goes with the width D of the opening as W = C rho sqrt(g) (D -
// k d)^p, p = 3/2 in the plane and 5/2 in space, whatever the height [Beverloo, Leniger, van de
// Velde 1961; Mankoc 2007]. At the end nothing comes in any more, and the height falls.
//
// Sample runs:  examples/run hourglass
//               examples/run hourglass --dim 3 --width 12 --openings 4,5,6,7
//               examples/run hourglass --full
//               examples/run hourglass --dim 3 --full --width 20 --openings 5,6,7,8,9
#include <talus/feed/inlet.hpp>
#include <talus/feed/sink.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

#include "lab/aim.hpp"
#include "lab/command.hpp"
#include "lab/measures/beverloo.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/fill.hpp"
#include "lab/samples/flow.hpp"
#include "lab/samples/vessel.hpp"
#include "lab/table.hpp"

namespace {

constexpr double gravity = 9.81;  // [m/s^2]

struct Options {
    double dim = 2, width = 24, height = 1.4, diameter = 0.01, mu = 0.5, settle = 0.8, lead = 0.4,
           measure = 2, empty = 2, step = 1.5e-3, aim = 1e-3;
    std::vector<double> openings{6, 7, 8, 10};  // [diameters]
    double begin(std::size_t stage) const {     // [s]
        return settle + static_cast<double>(stage) * (lead + measure);
    }
};

template <int Dim>
int let_flow(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    talus::Simulation<Dim> sim({talus::Coulomb<Dim>{o.mu}, 0.0, 0.0},
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}},
                               lab::solver_with_aim<Dim>(o.aim));
    auto& system = sim.system();
    system.gravity = -gravity * up;
    const lab::Vessel<Dim> vessel{o.width * o.diameter, o.diameter};
    vessel.add_planks(system);
    vessel.add_wall(system);
    const double full = o.height * vessel.width;  // [m]
    vessel.scatter(system, vessel.grains(full), 0.0, command.seed());
    talus::Inlet<Dim> inlet({.place = vessel.between(1.1 * full, 1.1 * full + 0.5 * vessel.width),
                             .shape = talus::balls<Dim>(vessel.radii()),
                             .total = 0,
                             .velocity = -1.0 * up,
                             .seed = command.seed() + 1});
    auto sink = talus::Sink<Dim>::below(up, -8.0 * o.diameter);
    lab::Flow flow;
    lab::Numbers density;  // of what has settled: one [kg/m^Dim]
    lab::Run<Dim> run(command, sim, "An hourglass");
    run.carry("inlet", inlet);
    run.carry("sink", sink);
    run.carry("flow", flow);
    run.carry("density", density);
    run.begin();

    const auto fill = [&] { return lab::Fill<Dim>(system, 0.0, vessel.area()); };
    const std::int64_t often = std::max(1LL, std::llround(0.02 / o.step));
    bool again = true;  // what flows out comes in
    const double last = o.begin(o.openings.size()), high = 1.2 * vessel.width;
    const auto let = [&] {
        if (sim.time() > last + o.empty - 0.5 * o.step) return;  // the picture is of this step
        const std::size_t gone = sink.drain(system);
        if (again) inlet.owe(gone);
        inlet.feed(system, sim.time());
        if (sim.step_count() % often != 0) return;
        flow.add(sim.time(), sink.mass(), fill().mass / density.values[0] / vessel.area());
    };
    if (!run.until(o.settle, "settling")) return run.exit_code();
    if (density.values.empty()) density.values = {fill().density};
    for (std::size_t k = 0; k < o.openings.size(); ++k) {
        vessel.open(system, o.openings[k] * o.diameter);
        const std::string label = "opening " + talus::detail::text_of(o.openings[k]);
        if (!run.until(o.begin(k + 1), label, let)) return run.exit_code();
    }
    again = false;
    if (!run.until(last + o.empty, "running empty", let)) return run.exit_code();
    flow.write_csv(command.out() / "flow.csv");
    lab::Beverloo<Dim> law;
    for (std::size_t k = 0; k < o.openings.size(); ++k)
        law.add(o.openings[k], flow.mean(o.begin(k) + o.lead, o.begin(k + 1)));
    law.report(command.out(),
               density.values[0] * std::sqrt(gravity) * std::pow(o.diameter, law.power));
    const double steady = flow.mean(last - o.measure, last).mean();
    const auto above = flow.mean(last, last + o.empty, high),
               below = flow.mean(last, last + o.empty, 0.5 * high, high);
    std::printf(
        "running empty, over the last steady flow: %.3f +- %.3f while higher than 1.2 "
        "widths (reference: 1 +- 0.05), %.3f +- %.3f from there to 0.6\n",
        above.mean() / steady, above.error(4) / steady, below.mean() / steady,
        below.error(4) / steady);
    const bool fitted = law.flowing() >= 3;
    lab::write_findings(command.out(),
                        {{"exponent", "-", fitted ? law.free_fit().exponent : std::nan("")},
                         {"offset", "diameters", fitted ? law.free_fit().offset : std::nan("")},
                         {"flow running empty while high", "steady", above.mean() / steady}});

    const auto look =
        lab::in_weights("An hourglass runs empty", fill().mass / vessel.grains(full),
                        {-0.6 * vessel.width, Dim == 2 ? -8.0 * o.diameter : -0.6 * vessel.width},
                        {0.6 * vessel.width, Dim == 2 ? 1.2 * full : 0.6 * vessel.width});
    lab::write_picture<Dim>(command.out() / "hourglass.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("hourglass", [&] {
        Options o;
        lab::Command command("hourglass",
                             "Grains flow out of a silo and come in again at the top: how does the "
                             "flow go with the width of the opening?");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.number("--width", o.width, 60, 5, 1e3, "of the silo [diameters of grains]");
        command.number("--height", o.height, 0.5, 100, "of the filling [widths]");
        command.list("--openings", o.openings, {8, 10, 12, 16, 20}, 2.5, 1e3,
                     "widths of the opening, ascending [diameters]");
        command.number("--diameter", o.diameter, 1e-6, 1e3, "mean, of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient");
        command.number("--settle", o.settle, 1e-3, 1e3, "before the silo is opened [s]");
        command.number("--lead", o.lead, 0, 1e3, "of each opening before its flow counts [s]");
        command.number("--measure", o.measure, 0.1, 1e6, "the flow of each opening [s]");
        command.number("--empty", o.empty, 0.1, 1e6, "while nothing comes in [s]");
        command.number("--step", o.step, 1e-9, 0.05, "step size [s]");
        command.number("--aim", o.aim, 1e-8, 1e-3, "of the solver, its tolerance at most [-]");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? let_flow<2>(command, o) : let_flow<3>(command, o);
    });
}
