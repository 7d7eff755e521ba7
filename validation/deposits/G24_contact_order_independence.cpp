// SPDX-License-Identifier: BSL-1.0
#include "deposit.hpp"

namespace validation {
namespace G24 {

/// All orders in which the contacts are visited.
struct Order {
    std::string name;
    talus::SweepOrder order;
    std::uint64_t seed;
};
std::vector<Order> orders() {
    std::vector<Order> list{{"forward", talus::SweepOrder::forward, 1},
                            {"backward", talus::SweepOrder::backward, 1},
                            {"symmetric", talus::SweepOrder::symmetric, 1}};
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        list.push_back({"random " + std::to_string(seed), talus::SweepOrder::random, seed});
    return list;
}

/// Largest differences of end velocities and of impulses between the orders, relative to the
/// largest ones.
struct Spread {
    double velocity = 0.0, impulse = 0.0;
};

/// One step of the bodies placed as in `settled`, moving as `velocity` says, in every order.
template <int Dim>
Spread spread(Trial<Dim>& trial, const Deposit<Dim>& deposit, const World<Dim>& settled, double mu,
              double tolerance, bool moving) {
    std::vector<std::vector<talus::Twist<Dim>>> ends;
    std::vector<std::vector<V<Dim>>> impulses;
    for (const Order& order : orders()) {
        auto params = settled.params();
        params.contact = law<Dim>(mu);
        params.prepares = false;
        params.solver = {
            .max_sweeps = 200000, .tolerance = tolerance, .order = order.order, .seed = order.seed};
        auto world = deposit.make(trial, params, 0);
        world.bodies().position = settled.bodies().position;
        world.bodies().rotation = settled.bodies().rotation;
        if (moving)
            for (std::size_t i = Deposit<Dim>::walls; i < world.bodies().count(); ++i)
                world.bodies().velocity[i] =
                    V<Dim>::Unit(0) * 0.1 * std::sin(static_cast<double>(i));
        world.step();
        ends.push_back(world.data().end);
        impulses.push_back(world.data().impulse);
    }
    Spread result;
    double fastest = g * settled.params().h, strongest = 0.0;
    for (const auto& t : ends[0]) fastest = std::max(fastest, t.linear.norm());
    for (const auto& r : impulses[0]) strongest = std::max(strongest, r.norm());
    for (std::size_t k = 1; k < ends.size(); ++k) {
        for (std::size_t i = 0; i < ends[k].size(); ++i)
            result.velocity =
                std::max(result.velocity, (ends[k][i].linear - ends[0][i].linear).norm() / fastest);
        for (std::size_t c = 0; c < impulses[k].size(); ++c)
            result.impulse =
                std::max(result.impulse, (impulses[k][c] - impulses[0][c]).norm() / strongest);
    }
    return result;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const Deposit<Dim> deposit{Dim == 2 ? 40 : 48, Dim == 2 ? 8 : 4};
    auto settled = deposit.make(trial,
                                {.h = 4e-4,
                                 .contact = law<Dim>(0.3),
                                 .solver = {.max_sweeps = 2000, .tolerance = 1e-6},
                                 .prepares = true},
                                0);
    settled.run(1.0);

    const double tolerance = 1e-10;
    // Velocities answer to the residual through the softest motion of the heap.
    const double softness = 1e3;
    const Spread smooth = spread<Dim>(trial, deposit, settled, 0.0, tolerance, false);
    trial.solver("end velocities, no friction, from rest", smooth.velocity, 0.0, softness,
                 tolerance);
    const Spread struck = spread<Dim>(trial, deposit, settled, 0.0, tolerance, true);
    trial.solver("end velocities, no friction, shaken", struck.velocity, 0.0, softness, tolerance);
    const Spread rough = spread<Dim>(trial, deposit, settled, 0.3, tolerance, false);
    trial.solver("end velocities, friction 0.3, from rest", rough.velocity, 0.0, softness,
                 tolerance);
    trial.note("Impulses with friction differ by up to " + std::to_string(rough.impulse) +
               " of the largest: self-stress, chosen by start and order.");
}

const Register g24(
    {.id = "G24",
     .name = "contact-order-independence",
     .title = "The order of contacts does not matter",
     .gate = 2,
     .setup = "One step of a settled heap of 40 discs (48 spheres), solved with the contacts "
              "visited forward, backward, in turn and in five random orders; without friction from "
              "rest and shaken, with friction from rest.",
     .reference = {"the end velocities are the same in every order"},
     .compared = "End velocities of all bodies between the orders. Impulses of the hyperstatic "
                 "heap may differ by a self-stress and are only noted.",
     .kind = Class::S,
     .why = "Without friction the end velocity is the solution of a convex problem, hence one; at "
            "rest with friction it is zero where the heap holds. Velocities answer to the residual "
            "by a factor of the heap's softest motion, a thousand here.",
     .source = "Moreau 1988; derived.",
     .catches = {Fault::residual_ignored},
     .midpoint_because = "In space the pile that the other scheme leaves takes Gauss-Seidel more "
                         "than its 200,000 sweeps."},
    run<2>, run<3>, __FILE__);

}  // namespace G24
}  // namespace validation
