// SPDX-License-Identifier: BSL-1.0
#include "free_motion/tops.hpp"

namespace validation {
namespace E04 {

const V<3> moments(1, 1, 2), start(0.3, 0, 1.5);
constexpr double h = 0.01;
constexpr int steps = 500;
constexpr double om = (2.0 - 1.0) * 1.5 / 1.0;

/// Angle by which the implicit update turns the transverse spin in a step. Both turns by half a
/// step carry the momentum to the same axes: exp(h/2 w_end) I w_end = exp(-h/2 w) I w. By symmetry
/// the transverse spin turns by an angle a between mirror images, so that the condition is that the
/// momentum after the half turn lies in the plane of the axis and the bisector.
double implicit_angle() {
    const double p = start[0], s = start[2];
    const auto out_of_plane = [&](double a) {
        // w_end at +a/2 from the bisector along axis 1: the momentum carried has no part along 2.
        const V<3> w(p * std::cos(a / 2), p * std::sin(a / 2), s);
        const V<3> momentum = moments.cwiseProduct(w);
        const double angle = h / 2 * w.norm();
        const V<3> axis = w.normalized();
        const V<3> turned = std::cos(angle) * momentum + std::sin(angle) * axis.cross(momentum) +
                            (1 - std::cos(angle)) * axis.dot(momentum) * axis;
        return turned[1];
    };
    return gsl::root(out_of_plane, -0.5 * h * om - 0.5 * h, 1.5 * h * om + 0.5 * h);
}

void run(Trial<3>& trial) {
    using talus::Gyroscopic;
    trial.within("reference, growth given", std::pow(1 + h * h * om * om, steps / 2.0), 1.057855423,
                 5e-10, "digits given");
    for (const auto option : {Gyroscopic::explicit_term, Gyroscopic::momentum_preserving}) {
        const bool kept = option == Gyroscopic::momentum_preserving;
        const double factor = kept ? 1.0 : std::sqrt(1 + h * h * om * om);
        const double angle = kept ? implicit_angle() : std::atan(h * om);
        if (kept)
            trial.within("reference, angle of a step against h Om", angle, h * om,
                         std::pow(h * om, 3), "third order", h);
        auto world = free_top(trial, moments, start, h, option);
        const V<3> momentum = angular_momentum(world, moments);
        Worst size, turned, axial, drift;
        Series seen{"measured", {}, {}}, curve{"exact of the method", {}, {}, true};
        for (int n = 1; n <= steps; ++n) {
            world.step();
            const V<3>& w = world.bodies().spin[0];
            const double transverse = std::hypot(w[0], w[1]);
            size.see(transverse, start[0] * std::pow(factor, n));
            const V<3> reference =
                start[0] * std::pow(factor, n) * V<3>(std::cos(n * angle), std::sin(n * angle), 0) +
                V<3>(0, 0, start[2]);
            turned.see(w, reference);
            axial.see(w[2], start[2]);
            drift.see(angular_momentum(world, moments), momentum);
            seen.x.push_back(n * h), seen.y.push_back(transverse);
            curve.x.push_back(n * h), curve.y.push_back(start[0] * std::pow(factor, n));
        }
        // 500 steps in numbers of order 1.
        trial.rounding("size of the transverse spin, " + name_of(option), size, 1.0, h);
        trial.rounding("spin in body axes, " + name_of(option), turned, 10.0, h);
        trial.rounding("axial spin, " + name_of(option), axial, 1.0, h);
        if (kept) trial.rounding("angular momentum in space", drift, 10.0, h);
        trial.curves({"size of the transverse spin, " + name_of(option),
                      "t [s]",
                      "ω [rad/s]",
                      {seen, curve}});
    }
}

const Register e04(
    {.id = "E04",
     .name = "symmetric-top-discrete",
     .title = "A symmetric top, step by step",
     .gate = 1,
     .setup = "A body of moments 1, 1 and 2 kg m^2 turns without torque, from (0.3, 0, 1.5) rad/s, "
              "for 500 steps of 0.01 s; with both updates of the gyroscopic term.",
     .reference = {"Ω = frac{(I_3 − I_1) ω_3}{I_1} = 1.5 rad/s",
                   "explicit: |ω_⊥| grows by √{1 + h^2 Ω^2} in a step and turns by atan(h Ω)",
                   "momentum kept: |ω_⊥| stays; the angle is the root of a scalar equation"},
     .compared = "Size and direction of the transverse spin and the axial spin at every step; the "
                 "angular momentum in space for the update that keeps it.",
     .kind = Class::R,
     .why = "Both updates are known in closed form for a symmetric top.",
     .source = "Derived here.",
     .catches = {Fault::gyroscopic_dropped}},
    nullptr, run, __FILE__);

}  // namespace E04
}  // namespace validation
