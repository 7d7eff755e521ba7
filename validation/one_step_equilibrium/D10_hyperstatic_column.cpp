// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D10 {

constexpr int blocks = 10;
constexpr double mu = 0.5;
/// Forces of up to ten weights, through which the errors of up to ten interfaces add up.
constexpr double scale = blocks * blocks;

template <int Dim>
V<Dim> block() {
    return half_extents<Dim>(0.3, 0.1, 0.2);
}

/// Floor (body 0) and blocks of unit weight 1, 2, ... upwards.
template <int Dim>
World<Dim> column(Trial<Dim>& trial, double h, std::uint64_t shuffle = 0) {
    auto params = statics_params<Dim>(h, mu);
    if (shuffle > 0) {
        params.solver.order = talus::SweepOrder::random;
        params.solver.seed = shuffle;
    }
    auto world = trial.world(params);
    world.add_floor();
    const V<Dim> half = block<Dim>();
    for (int k = 0; k < blocks; ++k)
        world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0 / g, half),
                  {half[Dim - 1] * (2 * k + 1) * up<Dim>(), {}});
    return world;
}

/// What interface k (0: floor) has to carry, whatever corner carries how much.
template <int Dim>
void check_interfaces(Trial<Dim>& trial, const Equilibrium<Dim>& report, const std::string& how) {
    Worst force, moment;
    for (int k = 0; k < blocks; ++k) {
        const V<Dim> centre = 2 * block<Dim>()[Dim - 1] * k * up<Dim>();
        const auto sum = resultant<Dim>(report, k, k + 1, centre);
        force.see(V<Dim>(sum.force), V<Dim>((blocks - k) * up<Dim>()));
        moment.see(W<Dim>(sum.torque), W<Dim>(W<Dim>::Zero()));
    }
    trial.solver("force through each interface / W, " + how, force, scale, statics_tolerance);
    trial.solver("moment through each interface / (W m), " + how, moment, scale, statics_tolerance);
}

/// A block without weight between a fixed wall (body 0) and a plate (2) that is pushed against it
/// with force 1.
template <int Dim>
World<Dim> pressed(Trial<Dim>& trial, double h) {
    auto params = statics_params<Dim>(h, mu);
    params.gravity = V<Dim>::Zero();
    auto world = trial.world(params);
    world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(0));
    const V<Dim> half = block<Dim>();
    world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0 / g, half),
              {half[0] * V<Dim>::Unit(0), {}});
    const V<Dim> plate = half_extents<Dim>(0.05, 0.3, 0.3);
    const auto body = world.add(talus::Box<Dim>(plate), box_inertia<Dim>(1.0 / g, plate),
                                {(2 * half[0] + plate[0]) * V<Dim>::Unit(0), {}});
    push<Dim>(world, body, V<Dim>::Zero(), -V<Dim>::Unit(0));
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const auto report =
        expect<Dim>(trial, "column", true, [&](double h) { return column<Dim>(trial, h); });
    check_interfaces<Dim>(trial, report, "forward sweeps");
    for (const std::uint64_t seed : {1u, 2u, 3u})
        check_interfaces<Dim>(trial, column<Dim>(trial, 1e-2, seed).equilibrium(),
                              "shuffled contacts, seed " + std::to_string(seed));
    if constexpr (Dim == 2) {
        Worst share;
        for (std::size_t c = 0; c < report.data.contact_count(); ++c) {
            const auto upper = report.data.contacts.key[c].b;
            share.see(force_on<2>(report, upper, c)[1], 0.5 * (blocks + 1 - upper));
        }
        trial.solver("normal force of each corner / W", share, scale, statics_tolerance);
    }

    talus::ImpulseCache<Dim> found;
    found.store(report.data.contacts, report.data.problem.jacobian, report.data.impulse);
    const int warm = column<Dim>(trial, 1e-2).equilibrium(found).data.report.iterations;
    trial.note("Cold start: " + std::to_string(report.data.report.iterations) + " sweeps.");
    trial.within("sweeps from the impulses found", warm, 0.0, 1.0,
                 "they are the answer; rounding may cost one sweep");

    const auto held =
        expect<Dim>(trial, "pressed block", true, [&](double h) { return pressed<Dim>(trial, h); });
    const V<Dim> x = V<Dim>::Unit(0);
    for (const auto& [from, side] : {std::pair{0, "fixed"}, std::pair{2, "pushed"}}) {
        const V<Dim> face = from == 0 ? V<Dim>::Zero() : V<Dim>(2 * block<Dim>()[0] * x);
        const auto sum = resultant<Dim>(held, from, 1, face);
        trial.solver(std::string("force of the ") + side + " side", V<Dim>(sum.force),
                     V<Dim>(from == 0 ? x : V<Dim>(-x)), 1.0, statics_tolerance);
        trial.solver(std::string("moment of the ") + side + " side", W<Dim>(sum.torque),
                     W<Dim>(W<Dim>::Zero()), 1.0, statics_tolerance);
    }
}

const Register d10(
    {.id = "D10",
     .name = "hyperstatic-column",
     .title = "A column of ten blocks",
     .gate = 1,
     .setup = "Ten blocks of weight W (0.6 m by 0.2 m by 0.4 m) stacked flat with friction 0.5; "
              "and a block without weight pressed between a wall and a plate.",
     .reference = {"interface below k blocks: force k W upwards, moment 0",
                   "in the plane: N_{left} = N_{right} = frac{k W}{2}"},
     .compared = "Resultants at every interface, with the contacts visited in order and in three "
                 "random orders; in the plane every normal force. Started from its own answer the "
                 "solver needs no sweeps.",
     .kind = Class::S,
     .why = "Friction forces and, in space, corner forces are not unique and are not compared. "
            "Resultants reach 10 W, and the errors of ten interfaces add up in them.",
     .source = "Elementary statics.",
     .catches = {Fault::wrong_warm_start, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace D10
}  // namespace validation
