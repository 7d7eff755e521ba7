// SPDX-License-Identifier: BSL-1.0
//
// Janssen's silo: grains between two plates, in space in a tube, carried by the wall as much as by
// what is below. Once it is full its floor sinks slowly, so that all grains slide down along the
// wall, and the weight that goes through cuts at many heights is measured. What is carried of the
// mass m above is m_a = m_inf (1 - exp(-m / m_inf)) [Janssen 1895; Ovarlez, Fond, Clement 2003].
//
// Sample runs:  examples/run silo
//               examples/run silo --dim 3 --width 7
//               examples/run silo --full            (in space: --dim 3 --full --width 10)
#include <talus/stepping/step_queries.hpp>

#include "lab/aim.hpp"
#include "lab/command.hpp"
#include "lab/measures/janssen.hpp"
#include "lab/picture.hpp"
#include "lab/run.hpp"
#include "lab/samples/fill.hpp"
#include "lab/samples/move_on.hpp"
#include "lab/samples/pour.hpp"
#include "lab/samples/vessel.hpp"
#include "lab/table.hpp"

namespace {

constexpr double gravity = 9.81;  // [m/s^2]

struct Options {
    double dim = 2, width = 10, height = 5, diameter = 0.01, mu = 0.5, wall = 0.5, rate = 400,
           sink = 1, speed = 0.01, rest = 0.3, step = 1e-3, aim = 1e-3;
};

template <int Dim>
int fill_and_sink(const lab::Command& command, const Options& o) {
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    const talus::Coulomb<Dim> on_wall{o.wall}, on_grain{o.mu};
    talus::MaterialTable<talus::DefaultLaw<Dim>> laws(2, {on_wall, 0.0, 0.0});
    laws.set(0, 0, {on_grain, 0.0, 0.0});
    talus::Simulation<Dim> sim(laws,
                               {.h = o.step, .step = {.scheme = talus::Scheme::gap_anticipating}},
                               lab::solver_with_aim<Dim>(o.aim));
    auto& system = sim.system();
    system.gravity = -gravity * up;
    const lab::Vessel<Dim> vessel{o.width * o.diameter, o.diameter};
    vessel.add_wall(system, 1);
    const auto floor = system.add_obstacle(talus::HalfSpace<Dim>(up, 0.0), {}, 1);

    const double top = o.height * vessel.width, grains = vessel.grains(top);
    talus::Inlet<Dim> inlet({.place = vessel.between(1.2 * top, 1.3 * top),
                             .shape = talus::balls<Dim>(vessel.radii()),
                             .rate = o.rate,
                             .total = static_cast<std::int64_t>(grains),
                             .velocity = -1.0 * up,
                             .seed = command.seed()});
    lab::Mark full;
    lab::Numbers pouring;
    lab::ForceProfile<Dim> profile(20);
    lab::Run<Dim> run(command, sim, "A silo");
    run.carry("inlet", inlet);
    run.carry("full", full);
    run.carry("pouring", pouring);
    run.carry("profile", profile);
    run.begin();

    const auto contents = [&] {
        return lab::Fill<Dim>(system, system.bodies.position[floor][Dim - 1], vessel.area());
    };
    const auto weigh = [&] {
        if (sim.step_count() % 50 != 0) return;
        const auto force = talus::wrench_impulse_on(sim.data(), floor).force / o.step;
        pouring.values.insert(pouring.values.end(), {contents().mass, -force[Dim - 1] / gravity});
    };
    if (!lab::pour(run, sim, inlet, full, grains / o.rate, "pouring", weigh) ||
        !run.until(full.time + o.rest, "resting"))
        return run.exit_code();
    // Begins at this very step, or did before a stop.
    const double begin = full.time + o.rest, end = begin + o.sink * o.diameter / o.speed;
    if (sim.time() < begin + 0.5 * o.step)
        lab::move_on<Dim>(system, floor, {-o.speed * up, talus::AngularVector<Dim>::Zero()});
    const bool whole = run.until(end, "sinking", [&] {
        if (sim.time() > 0.5 * (begin + end) && sim.step_count() % 5 == 0)
            profile.record(sim, contents());
    });
    if (!whole) return run.exit_code();
    const lab::Janssen<Dim> law(contents(), profile, gravity);
    law.print(vessel, o.wall);
    law.write(command.out(), pouring);
    lab::write_findings(command.out(), law.findings(vessel, o.wall));

    const double side = Dim == 2 ? 0.6 * top : 0.55 * vessel.width;
    const auto look = lab::in_weights("A silo whose floor sinks", contents().mass / grains,
                                      {-side, Dim == 2 ? -0.3 * vessel.width : -side},
                                      {side, Dim == 2 ? 1.1 * top : side});
    lab::write_picture<Dim>(command.out() / "silo.svg", sim, look);
    return run.finish();
}

}  // namespace

int main(int argc, char** argv) {
    return lab::run_program("silo", [&] {
        Options o;
        lab::Command command("silo",
                             "Grains fill a silo, whose floor then sinks slowly: how much of their "
                             "weight is carried by what is below, and how much by the wall?");
        command.count("--dim", o.dim, 2, 3, "dimension");
        command.number("--width", o.width, 20, 3, 1e3, "width or diameter [diameters of grains]");
        command.number("--height", o.height, 0.5, 100, "to which it is filled [widths]");
        command.number("--diameter", o.diameter, 1e-6, 1e3, "mean, of grains [m]");
        command.number("--mu", o.mu, 0, 1e3, "friction coefficient between grains");
        command.number("--wall", o.wall, 1e-3, 1e3, "friction coefficient of the wall");
        command.number("--rate", o.rate, 1e-3, 1e6, "grains that come in a second [1/s]");
        command.number("--sink", o.sink, 1e-3, 1e3,
                       "way of the floor, measured in the second half [diameters]");
        command.number("--speed", o.speed, 1e-9, 1e3, "of the floor [m/s]");
        command.number("--rest", o.rest, 0, 1e6, "before the floor sinks [s]");
        command.number("--step", o.step, 1e-9, 1, "step size [s]");
        command.number("--aim", o.aim, 1e-8, 1e-3, "of the solver, its tolerance at most [-]");
        if (!command.read(argc, argv)) return 0;
        return o.dim == 2 ? fill_and_sink<2>(command, o) : fill_and_sink<3>(command, o);
    });
}
