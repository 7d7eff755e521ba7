// SPDX-License-Identifier: BSL-1.0
#include "harness/case.hpp"

namespace validation {
namespace B13 {

constexpr double m = 1.0, length = 1.0, v = 1.0, h = 1e-3;

struct Impact {
    double impulse, spin, speed;  ///< speed of the centre, upwards
};

/// Reference: the end has the effective mass m / (1 + 3 cos^2).
Impact exact(double angle, double e) {
    const double c = std::cos(angle), p = (1 + e) * m * v / (1 + 3 * c * c);
    return {p, 6 * c * p / (m * length), -v + p / m};
}

/// Turns the plane of the rod about the vertical.
template <int Dim>
talus::Rotation<Dim> turned(double azimuth) {
    if constexpr (Dim == 2)
        return {};
    else
        return talus::Rotation<3>::exp({0, 0, azimuth});
}

/// The rod falls without turning; its lower end is on the floor at the midpoint of the step.
template <int Dim>
World<Dim> falling(Trial<Dim>& trial, double angle, double e, double azimuth) {
    auto world = trial.world({.h = h, .contact = law<Dim>(0.0, e), .gravity = V<Dim>::Zero()});
    world.add_floor();
    const V<Dim> centre = (0.5 * length * std::sin(angle) + 0.5 * h * v) * up<Dim>();
    world.add(Rod<Dim>{length}, rod_inertia<Dim>(m, length),
              {centre, turned<Dim>(azimuth) * tilt<Dim>(-angle)}, {-v * up<Dim>()});
    return world;
}

template <int Dim>
double energy(const World<Dim>& world) {
    const auto twist = world.bodies().twist(1);
    return 0.5 * m * twist.linear.squaredNorm() +
           m * length * length / 24 * twist.angular.squaredNorm();
}

template <int Dim>
void compare(Trial<Dim>& trial, double angle, double e, double azimuth) {
    const std::string name = std::to_string(angle / degree) + " degrees, e = " + std::to_string(e) +
                             (Dim == 3 ? ", azimuth " + std::to_string(azimuth) : "");
    const Impact reference = exact(angle, e);
    auto world = falling<Dim>(trial, angle, e, azimuth);
    const auto& data = world.step();
    trial.holds("one contact, " + name, data.contact_count() == 1);
    trial.rounding("impulse [N s], " + name, impulse_on<Dim>(data, 1),
                   V<Dim>(reference.impulse * up<Dim>()), 2 * m * v);
    const auto twist = world.bodies().twist(1);
    trial.rounding("velocity of the centre, " + name, twist.linear,
                   V<Dim>(reference.speed * up<Dim>()), v);
    const auto back = turned<Dim>(azimuth);
    const W<Dim> spin = rolling_spin<Dim>(-reference.spin);
    W<Dim> expected = spin;
    if constexpr (Dim == 3) expected = back * spin;
    trial.rounding("spin [1/s], " + name, twist.angular, expected, 12 * v / length);
    if (e == 0.0) {
        const double c = std::cos(angle);
        trial.rounding("energy kept, " + name, energy<Dim>(world) / (0.5 * m * v * v),
                       1 - 1 / (1 + 3 * c * c), 1.0);
    }
    if (e == 1.0)
        trial.rounding("energy kept, " + name, energy<Dim>(world) / (0.5 * m * v * v), 1.0, 1.0);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double digits[4][3] = {{0.0, 0.25, 1.5},
                                 {30.0, 0.307692308, 1.598816130},
                                 {60.0, 0.571428571, 1.714285714},
                                 {80.0, 0.917043284, 0.955457371}};
    for (const auto& [angle, impulse, spin] : digits) {
        const Impact reference = exact(angle * degree, 0.0);
        const std::string name = std::to_string(angle) + " degrees";
        trial.within("reference, impulse, " + name, reference.impulse, impulse, 6e-10,
                     "digits of the catalogue");
        trial.within("reference, spin, " + name, reference.spin, spin, 1e-9,
                     "digits of the catalogue");
        for (const double e : {0.0, 0.5, 1.0})
            for (const double azimuth : {0.0, 0.7}) {
                if (Dim == 2 && azimuth > 0.0) continue;
                compare<Dim>(trial, angle * degree, e, azimuth);
            }
    }
    Series impulse{"P", {}, {}}, spin{"w", {}, {}};
    Series exact_impulse{"P, exact", {}, {}, true}, exact_spin{"w, exact", {}, {}, true};
    for (int k = 0; k <= 34; ++k) {
        const double angle = 2.5 * k;
        auto world = falling<Dim>(trial, angle * degree, 0.0, 0.0);
        const auto& data = world.step();
        const Impact reference = exact(angle * degree, 0.0);
        for (Series* s : {&impulse, &spin, &exact_impulse, &exact_spin}) s->x.push_back(angle);
        impulse.y.push_back(impulse_on<Dim>(data, 1)[Dim - 1]);
        spin.y.push_back(tilting_spin<Dim>(world.bodies().twist(1)));
        exact_impulse.y.push_back(reference.impulse);
        exact_spin.y.push_back(reference.spin);
    }
    trial.curves({"soft impact of an end",
                  "angle [degrees]",
                  "P [N s], w [1/s]",
                  {impulse, spin, exact_impulse, exact_spin}});
}

const Register b13(
    {.id = "B13",
     .name = "rod-end-impact",
     .title = "A rod strikes the floor with one end",
     .gate = 2,
     .setup = "A uniform slender rod of 1 kg and 1 m falls at 1 m/s without turning and strikes a "
              "smooth floor with one end, at 0, 30, 60 and 80 degrees to it; restitution 0, 0.5 "
              "and 1. In space in two vertical planes. At 0 degrees only one end is given to "
              "the contact.",
     .reference = {"P = frac{(1 + e) m v}{1 + 3 cos^2 θ}", "w = frac{6 cos θ P}{m L}",
                   "energy kept at e = 0: 1 − frac{1}{1 + 3 cos^2 θ}"},
     .compared = "Impulse, velocity of the centre, spin and energy after the step.",
     .kind = Class::R,
     .why = "One contact without friction, solved in closed form at the geometry of the midpoint, "
            "at which the rod has its angle because it does not turn before.",
     .source = "Any mechanics text; the 30 degree case also by enumeration.",
     .catches = {Fault::short_arm, Fault::restitution_weight, Fault::stale_inertia}},
    run<2>, run<3>, __FILE__);

}  // namespace B13
}  // namespace validation
