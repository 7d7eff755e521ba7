// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/energy_ledger.hpp>

#include "walled_box.hpp"

namespace validation {
namespace B15 {

constexpr double h = 2e-3, mu = 0.3, amplitude = 0.03, rate = 2 * pi * 3;

/// The floor's height and velocity when it is shaken.
double floor_height(double t) { return amplitude * (1 - std::cos(rate * t)); }
double floor_velocity(double t) { return amplitude * rate * std::sin(rate * t); }

template <int Dim>
void falling_heap(Trial<Dim>& trial, bool shaken, double e) {
    const WalledBox<Dim> box{Dim == 2 ? 4 : 3, Dim == 2 ? 5 : 3};
    auto world = trial.world({.h = h,
                              .contact = law<Dim>(mu, e, e),
                              .solver = {.max_sweeps = 50000, .tolerance = 1e-6}});
    if (shaken)
        world.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0},
                           talus::PrescribedMotion<Dim>::shifted(
                               {}, [](double t) { return V<Dim>(floor_height(t) * up<Dim>()); },
                               [](double t) { return V<Dim>(floor_velocity(t) * up<Dim>()); }));
    else
        world.add_floor();
    box.add_sides(world);
    box.add_balls(world, trial.rng(shaken ? 1 : 0));

    const double start = energy<Dim>(world);
    EnergyScale scale(start);
    talus::EnergyLedger<Dim> ledger(world.bodies(), world.params().gravity);
    double contacts = 0.0, walls = 0.0;
    long closed = 0;
    Series state{"E − E_0", {0}, {0}}, work{"Σ P · (U_i + U_f) / 2", {0}, {0}, true};
    world.run(trial.full() ? 6.0 : 1.5, [&](const auto& w) {
        const StepData<Dim>& data = w.data();
        const auto& j = data.problem.jacobian;
        for (std::size_t c = 0; c < data.contact_count(); ++c, ++closed) {
            // What each body receives, on the mean velocity of its own point.
            for (const auto& [body, arm] :
                 {std::pair{j.a[c], j.arm_a[c]}, std::pair{j.b[c], j.arm_b[c]}}) {
                const auto i = static_cast<std::size_t>(body);
                const V<Dim> p = impulse_on<Dim>(data, body, c);
                if (w.bodies().is_obstacle(i)) {
                    // The prescribed velocity of walls, by its formula; what they give is what
                    // the bodies get: minus the work on the wall.
                    if (shaken && i == 0) walls -= p[Dim - 1] * floor_velocity(data.t_mid());
                    continue;
                }
                contacts += p.dot(V<Dim>(0.5 * (data.begin[i].at(arm) + data.end[i].at(arm))));
            }
        }
        ledger.record(data, w.bodies());
        scale.see(energy<Dim>(w));
        state.x.push_back(w.time());
        state.y.push_back(energy<Dim>(w) - start);
        work.x.push_back(w.time());
        work.y.push_back(contacts);
    });
    const std::string name =
        std::string(shaken ? "shaken floor" : "fixed walls") + ", e = " + std::to_string(e);
    const double change = energy<Dim>(world) - start;
    const std::string reason = "catalogue: relative 1e-11, to the largest energy of the run";
    trial.within("work of contacts [J], " + name, contacts, change, 1e-11 * scale.value(), reason);
    trial.within("the library's ledger closes, " + name, ledger.closure(), 0.0, 1e-11, reason);
    const auto& flows = ledger.flows();
    trial.within("the ledger's flows [J], " + name, flows.sum(), change, 1e-11 * scale.value(),
                 reason);
    trial.holds("contacts were at work, " + name, closed > 1000,
                std::to_string(closed) + " contacts over all steps");
    trial.holds("friction dissipates, " + name, flows.friction < 0.0);
    trial.holds("impacts dissipate, " + name, flows.restitution < 0.0);
    if (shaken) {
        trial.within("work of the floor [J], " + name, flows.walls, walls, 1e-11 * scale.value(),
                     reason);
        trial.holds("the floor gives energy, " + name, walls > 0.1 * std::abs(change));
        // Without the velocity of the floor it is the contacts' own loss: U − W for U.
        trial.within("loss in contacts [J], " + name, flows.friction + flows.restitution,
                     contacts - walls, 1e-11 * scale.value(), reason);
    }
    trial.curves({"energy, " + name, "t [s]", "E − E_0 [J]", {state, work}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    falling_heap<Dim>(trial, false, 0.0);
    falling_heap<Dim>(trial, false, 0.4);
    falling_heap<Dim>(trial, true, 0.0);
}

const Register b15(
    {.id = "B15",
     .name = "carnot-loss-ledger",
     .title = "The energy of a run is booked to the last digit",
     .gate = 2,
     .setup = "20 discs (27 spheres) of different sizes fall in a box and come to lie; friction "
              "0.3, restitution 0 and 0.4 in all directions, h = 2 ms, 1.5 s (6 s with --full). "
              "Then again on a floor that is shaken at 3 Hz.",
     .reference = {"E_{end} − E_0 = Σ_{steps} Σ_{contacts} P · frac{U_i + U_f}{2}, U of the bodies",
                   "with a moving floor: Σ P · (frac{U_i + U_f}{2} − W) is the loss, Σ P · W the "
                   "work of the floor"},
     .compared = "The change of kinetic and potential energy with the work of all contact "
                 "impulses, summed here, and with the flows of the library's ledger; the work of "
                 "the shaken floor with its prescribed velocity.",
     .kind = Class::T,
     .why =
         "An identity of the midpoint rule for constant mass and gravity, whatever the "
         "impulses: nothing but rounding may be missing. So the solver may stop at a residual of "
         "1e-6.",
     .source = "Carnot 1803; Moreau 1988. Follows from the step by algebra.",
     .catches = {Fault::end_point_drift, Fault::reaction_lost, Fault::obstacle_velocity_forgotten}},
    run<2>, run<3>, __FILE__);

}  // namespace B15
}  // namespace validation
