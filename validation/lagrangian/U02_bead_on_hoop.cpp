// SPDX-License-Identifier: BSL-1.0
#include "harness/machine.hpp"

namespace validation {
namespace U02 {

constexpr double radius = 1.0;

/// A bead in a tube bent to a circle that turns about its vertical diameter: the angle from the
/// bottom.
struct Bead {
    static constexpr int dof = 1;
    double turning;

    void mass(double, const auto&, auto& a) const { a << radius * radius; }
    void force(double, const auto& q, const auto&, auto& f) const {
        f << (turning * turning * radius * radius * std::cos(q[0]) - g * radius) * std::sin(q[0]);
    }
    void contacts(double, const auto&, auto&) const {}
    double rest() const {
        const double c = g / (turning * turning * radius);
        return c < 1.0 ? std::acos(c) : 0.0;
    }
};

void run(Trial<2>& trial) {
    Series branch{"exact", {}, {}, true}, seen{"talus, mean of a damped search", {}, {}};
    for (const double turning : {2.0, 3.0, 3.5, 4.0, 6.0, 10.0}) {
        const Bead bead{turning};
        const double rest = bead.rest(), h = 1e-3;
        const std::string name = ", " + std::to_string(turning) + " rad/s";
        Machine<Bead> still(trial, bead, One(rest), One(0.0), {.h = h});
        still.run(2.0);
        trial.within("stays where it rests [rad]" + name, still.q()[0], rest, 1e-12 * 100,
                     "rounding of 2000 steps", h);
        seen.x.push_back(turning), seen.y.push_back(still.q()[0] / degree);
        // Small swings about it, of the frequency that leapfrog gives them.
        const double square =
            rest > 0.0 ? std::pow(turning * std::sin(rest), 2) : g / radius - turning * turning;
        const double w = 2 / h * std::asin(std::sqrt(square) * h / 2), off = 1e-6;
        Machine<Bead> swing(trial, bead, One(rest + off), One(0.0), {.h = h});
        Worst worst;
        swing.run(1.0, [&](const auto& data) {
            worst.see((data.q_end[0] - rest) / off, std::cos(w * data.t_end()));
        });
        trial.within("small swings, of their size" + name, worst, 1e-4,
                     "swings of 1e-6 rad are not quite linear", h);
        // Upside down it falls to one side, and at the bottom of a fast hoop it leaves.
        Machine<Bead> bottom(trial, bead, One(off), One(0.0), {.h = h});
        double farthest = 0.0;
        bottom.run(12.0, [&](const auto& data) {
            farthest = std::max(farthest, std::abs(data.q_end[0]));
        });
        trial.holds("leaves the bottom of a fast hoop, stays in a slow one" + name,
                    (farthest > 1e-2) == (rest > 0.0), {}, h);
    }
    for (int k = 0; k <= 90; ++k) {
        branch.x.push_back(1.5 + 0.1 * k);
        branch.y.push_back(Bead{branch.x.back()}.rest() / degree);
    }
    trial.curves({"where it rests", "spin of the hoop [rad/s]", "[degrees]", {branch, seen}});
    // A wide swing, against its energy: leapfrog is of second order.
    const Bead bead{4.0};
    const auto energy = [&](double q, double u) {
        return u * u / 2 - std::pow(bead.turning * std::sin(q), 2) / 2 - g * std::cos(q);
    };
    trial.order(
        "energy in the turning frame", halvings(1e-2, 5),
        [&](double h) {
            Machine<Bead> swing(trial, bead, One(0.2), One(1.0), {.h = h});
            double worst = 0.0;
            swing.run(2.0, [&](const auto& data) {
                worst = std::max(worst,
                                 std::abs(energy(data.q_end[0], data.end[0]) - energy(0.2, 1.0)));
            });
            return worst;
        },
        second_order);
}

const Register u02(
    {.id = "U02",
     .name = "bead-on-hoop",
     .title = "A bead on a hoop that turns",
     .gate = 1,
     .setup = "A bead on a circular wire of 1 m that turns about its vertical diameter at 2 to 10 "
              "rad/s: one coordinate, no contact.",
     .reference = {"rests at the bottom, and at cos θ = frac{g}{Ω^2 R} if Ω^2 > frac{g}{R}",
                   "small swings there: w = Ω sin θ"},
     .compared = "Rest at the equilibria, small swings about them step by step, which bottom is "
                 "left; the order of the energy in the turning frame.",
     .kind = Class::D2,
     .why = "Leapfrog: an equilibrium is one to rounding, a linear oscillator has a known discrete "
            "frequency, the rest is h^2.",
     .source = "Elementary mechanics.",
     .catches = {Fault::force_at_begin, Fault::end_point_drift}},
    run, nullptr, __FILE__);

}  // namespace U02
}  // namespace validation
