// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "harness/case.hpp"
#include "harness/enumeration.hpp"

/// Painlevé's rod: unit mass and length, its tip on the floor, at an angle with the floor, the rest
/// above and on the + side of the tip. Friction on a tip that slides to the - side presses it down.
namespace validation {

/// Delassus block of the tip at an angle theta with the floor, (normal, tangent), m = L = 1.
struct TipBlock {
    double nn, tt, nt;
    explicit TipBlock(double theta) {
        const double s = std::sin(theta), c = std::cos(theta);
        nn = 1 + 3 * c * c;
        tt = 1 + 3 * s * s;
        nt = -3 * s * c;
    }
};

/// Friction above which the paradox occurs.
inline double critical_friction(double theta) {
    return (std::tan(theta) + 4 / std::tan(theta)) / 3;
}
/// W_nn - mu |W_nt|: what a slip to the - side meets in the normal direction, times P_n.
inline double slip_stiffness(double theta, double mu) {
    const TipBlock w(theta);
    return w.nn - mu * std::abs(w.nt);
}

/// Tip velocity `slide` along the first axis, spin that lifts the far end.
template <int Dim>
World<Dim> sliding_rod(Trial<Dim>& trial, double theta, double mu, double slide, double spin,
                       double h, double contact_tolerance = touching) {
    auto world = trial.world(
        {.h = h, .contact = law<Dim>(mu), .step = {.contact_tolerance = contact_tolerance}});
    world.add_floor();
    const V<Dim> arm = 0.5 * in_plane<Dim>(std::cos(theta), std::sin(theta));
    const W<Dim> w = rolling_spin<Dim>(-spin);
    world.add(Rod<Dim>{1.0}, rod_inertia<Dim>(1.0, 1.0), {arm, tilt<Dim>(theta)},
              {in_plane<Dim>(slide, 0.0) + talus::cross<Dim>(w, arm), w});
    return world;
}

/// Angle with the floor.
template <int Dim>
double floor_angle(const World<Dim>& world) {
    const V<Dim> axis = world.bodies().rotation[1] * V<Dim>(V<Dim>::Unit(0));
    return std::atan2(axis[Dim - 1], axis[0]);
}

/// Impulse on the rod: (normal, along the first axis).
template <int Dim>
V<2> tip_impulse(const StepData<Dim>& data) {
    const V<Dim> on_rod = impulse_on<Dim>(data, 1);
    return {on_rod[Dim - 1], on_rod[0]};
}
/// Velocity of the tip: (normal, along the first axis), begin or end of the step.
template <int Dim>
V<2> tip_velocity(const StepData<Dim>& data, const std::vector<talus::Twist<Dim>>& twists) {
    const V<Dim> u = twists[1].at(data.problem.jacobian.arm_b[0]);
    return {u[Dim - 1], u[0]};
}

/// The step's one-contact problem by hand: tip block at the midpoint angle, and the velocity that
/// the tip would end with under gravity alone.
inline PlanarProblem tip_problem(double theta, double mu, double slide, double spin, double h) {
    const double mid = theta + 0.5 * h * spin;
    const TipBlock w(mid);
    PlanarProblem p;
    p.w.resize(2, 2);
    p.w << w.nn, w.nt, w.nt, w.tt;
    // Velocity of the centre as given at the begin angle, of the tip at the midpoint angle.
    const double centre_x = slide - 0.5 * spin * std::sin(theta);
    const double centre_y = 0.5 * spin * std::cos(theta);
    p.b.resize(2);
    p.b << centre_y - 0.5 * spin * std::cos(mid) - g * h, centre_x + 0.5 * spin * std::sin(mid);
    p.mu = {mu};
    return p;
}

}  // namespace validation
