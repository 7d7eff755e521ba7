// SPDX-License-Identifier: BSL-1.0
#include "cradle.hpp"

namespace validation {
namespace B05 {

/// One step, against velocities along the line.
template <int Dim>
void collide(Trial<Dim>& trial, const std::string& name, const Cradle& cradle,
             const std::vector<double>& after) {
    const auto exact = along_line<Dim>(after);
    const auto enumerated = cradle.reference<Dim>().moreau();
    auto world = cradle.make<Dim>(trial);
    world.step();
    Worst reference, seen;
    for (std::size_t i = 0; i < after.size(); ++i) {
        reference.see(enumerated.velocity[i], exact[i]);
        seen.see(world.bodies().velocity[i], exact[i]);
    }
    trial.rounding("reference, " + name + ": enumeration", reference, 1.0);
    trial.rounding(name + ": velocities", seen, 1.0);
}

/// Newton's and Poisson's laws for the same collision, reference against reference.
template <int Dim>
void other_laws(Trial<Dim>& trial, const Cradle& cradle, const std::string& name) {
    const auto collision = cradle.reference<Dim>();
    const auto moreau = collision.moreau(), newton = collision.newton(),
               poisson = collision.poisson();
    Worst by_newton, by_poisson;
    for (std::size_t i = 0; i < cradle.count(); ++i) {
        by_newton.see(newton.velocity[i], moreau.velocity[i]);
        by_poisson.see(poisson.velocity[i], moreau.velocity[i]);
    }
    trial.rounding("reference, Newton gives the same, " + name, by_newton, 1.0);
    trial.rounding("reference, Poisson gives the same, " + name, by_poisson, 1.0);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (std::size_t n = 2; n <= 5; ++n)
        for (const double e : {0.0, 0.5, 1.0}) {
            const std::string name = "n = " + std::to_string(n) + ", e = " + std::to_string(e);
            const auto cradle = Cradle::equal(n, e);
            std::vector<double> after(n, (1 + e) / static_cast<double>(n));
            after[0] -= e;
            collide<Dim>(trial, name, cradle, after);
            other_laws<Dim>(trial, cradle, name);
            if (e == 1.0) {
                auto world = cradle.make<Dim>(trial);
                world.step();
                double energy = 0.0;
                for (const auto& v : world.bodies().velocity) energy += 0.5 * v.squaredNorm();
                trial.rounding(name + ": energy [J]", energy, 0.5, 1.0);
            }
        }
    collide<Dim>(trial, "two onto three", {{1, 1, 1, 1, 1}, {1, 1, 0, 0, 0}, {1, 1, 1, 1}},
                 {-.2, -.2, .8, .8, .8});
    collide<Dim>(trial, "masses 1, 2, 3", {{1, 2, 3}, {1, 0, 0}, {1, 1}},
                 {-2. / 3, 1. / 3, 1. / 3});
    collide<Dim>(trial, "struck from both sides", {{1, 1, 1}, {1, 0, -1}, {.5, .5}}, {-.5, 0, .5});

    // Unequal restitutions part the laws.
    const Cradle unequal{{1, 1, 1}, {1, 0, 0}, {0, 1}};
    collide<Dim>(trial, "e = (0, 1)", unequal, {1. / 3, 1. / 3, 1. / 3});
    const auto poisson = unequal.reference<Dim>().poisson();
    const auto exact = along_line<Dim>({1. / 6, 1. / 6, 2. / 3});
    for (std::size_t i = 0; i < 3; ++i)
        trial.rounding("reference, Poisson with e = (0, 1), ball " + std::to_string(i + 1),
                       poisson.velocity[i], exact[i], 1.0);

    Series first{"ball 1", {}, {}}, others{"balls 2 and 3", {}, {}};
    Series first_exact{"ball 1, exact", {0, 1}, {1. / 3, -1. / 3}, true};
    Series others_exact{"balls 2 and 3, exact", {0, 1}, {1. / 3, 2. / 3}, true};
    for (int k = 0; k <= 10; ++k) {
        const double e = 0.1 * k;
        auto world = Cradle::equal(3, e).make<Dim>(trial);
        world.step();
        first.x.push_back(e);
        first.y.push_back(world.bodies().velocity[0].dot(slanted<Dim>()));
        others.x.push_back(e);
        others.y.push_back(world.bodies().velocity[2].dot(slanted<Dim>()));
    }
    trial.curves({"three balls", "e", "v [m/s]", {first, others, first_exact, others_exact}});
}

const Register b05(
    {.id = "B05",
     .name = "cradle-touching",
     .title = "Newton's cradle with balls in touch",
     .gate = 1,
     .setup = "Two to five equal balls touch on a line of no special direction; the first arrives "
              "at 1 m/s, without gravity or friction; restitution 0, 0.5 and 1 at all contacts. "
              "Also: two balls onto three; masses 1, 2, 3; the middle of three struck from both "
              "sides; restitutions 0 and 1 at the two contacts of three balls.",
     .reference = {"u_1 = frac{1 + e}{n} − e,  u_k = frac{1 + e}{n} for k ≥ 2",
                   "u_{end} = (1 + e) u_{soft} − e u_{begin},  u_{soft} the projection on the "
                   "admissible velocities in the kinetic metric",
                   "e = (0, 1): Moreau and Newton (1/3, 1/3, 1/3), Poisson (1/6, 1/6, 2/3)"},
     .compared = "The velocities after one step; at e = 1 the energy. The formulas themselves with "
                 "an enumeration of the statuses, and with Newton's and Poisson's laws, which "
                 "agree for equal restitutions.",
     .kind = Class::R,
     .why = "One step of a well-posed problem whose solver runs to rounding. The (0, …, 0, 1) of "
            "the textbook is no solution of this state: it needs gaps (B06).",
     .source = "Moreau 1988; Glocker 2001; Pfeiffer and Glocker 1996.",
     .catches = {Fault::restitution_weight, Fault::reaction_lost, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace B05
}  // namespace validation
