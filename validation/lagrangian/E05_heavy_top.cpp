// SPDX-License-Identifier: BSL-1.0
#include "harness/machine.hpp"

namespace validation {
namespace E05 {

constexpr double i1 = 1.0, i3 = 0.5, weight = 2.943;  // about the fixed point; m g l

using Angles = Eigen::Vector3d;

/// A symmetric top with a fixed point, by precession, nutation (from the vertical) and spin.
struct Top {
    static constexpr int dof = 3;

    void mass(double, const auto& q, auto& a) const {
        const double s = std::sin(q[1]), c = std::cos(q[1]);
        a << i1 * s * s + i3 * c * c, 0, i3 * c, 0, i1, 0, i3 * c, 0, i3;
    }
    void force(double, const auto& q, const auto& u, auto& f) const {
        const double s = std::sin(q[1]), c = std::cos(q[1]);
        const double of_precession = 2 * (i1 - i3) * s * c, of_both = -i3 * s;  // dA by nutation
        f << -u[1] * (of_precession * u[0] + of_both * u[2]),
            (0.5 * of_precession * u[0] + of_both * u[2]) * u[0] + weight * s,
            -u[1] * of_both * u[0];
    }
    void contacts(double, const auto&, auto&) const {}
};

/// Precession and nutation at a time, from momenta that are constant.
std::vector<double> exact(double tilt, double precession, double axial, double time) {
    const double p_axis = i3 * axial;
    const double p_up = i1 * std::pow(std::sin(tilt), 2) * precession + p_axis * std::cos(tilt);
    const auto rhs = [&](double, std::span<const double> y, std::span<double> dy) {
        const double s = std::sin(y[1]), c = std::cos(y[1]);
        dy[0] = (p_up - p_axis * c) / (i1 * s * s);
        dy[1] = y[2];
        dy[2] = (i1 * dy[0] * dy[0] * s * c - p_axis * dy[0] * s + weight * s) / i1;
    };
    return gsl::ode(rhs, {0.0, tilt, 0.0}, std::vector{0.0, time}).back();
}

void run(Trial<2>& trial) {
    const double tilt = 30 * degree, axial = 20.0, c = std::cos(tilt);
    const auto steady = gsl::quadratic_roots(i1 * c, -i3 * axial, weight);
    trial.within("reference, slow precession [rad/s]", steady[0], 0.302209458, 5e-10, "digits");
    trial.within("reference, fast precession [rad/s]", steady[1], 11.244795926, 5e-9, "digits");
    trial.within("reference, least axial spin [rad/s]", 2 * std::sqrt(i1 * weight * c) / i3,
                 6.385875, 5e-7, "digits");
    const auto top = [&](double precession, double h, talus::VelocityForces forces) {
        return Machine<Top>(trial, {}, Angles(0.0, tilt, 0.0),
                            Angles(precession, 0.0, axial - precession * c),
                            {.h = h, .velocity_forces = forces});
    };
    // Steady precession has no acceleration in these coordinates: it is one of the steps too.
    for (const double precession : steady)
        for (const auto forces :
             {talus::VelocityForces::explicit_begin, talus::VelocityForces::implicit_midpoint}) {
            const double h = 1e-3, time = 2.0;
            auto machine = top(precession, h, forces);
            Worst nutation;
            machine.run(time, [&](const auto& data) { nutation.see(data.q_end[1], tilt); });
            const std::string name = ", " + std::to_string(precession) + " rad/s";
            trial.within("nutation of steady precession [rad]" + name, nutation, 1e-9,
                         "rounding, which free nutation at 10 rad/s magnifies", h);
            trial.within("angle of precession [rad]" + name, machine.q()[0], precession * time,
                         1e-8, "the same", h);
        }
    // Let go without precession it nutates.
    const double time = 1.0;
    const auto end = exact(tilt, 0.0, axial, time);
    const auto off = [&](talus::VelocityForces forces) {
        return [&, forces](double h) {
            auto machine = top(0.0, h, forces);
            machine.run(time);
            return std::hypot(machine.q()[0] - end[0], machine.q()[1] - end[1]);
        };
    };
    trial.order("nutating, F at the velocity of the beginning", halvings(1e-3, 5),
                off(talus::VelocityForces::explicit_begin), first_order);
    trial.order("nutating, F at the mean velocity", halvings(4e-3, 5),
                off(talus::VelocityForces::implicit_midpoint), second_order);
}

const Register e05(
    {.id = "E05",
     .name = "heavy-top-precession",
     .title = "A heavy top precesses",
     .gate = 1,
     .setup = "A symmetric top with a fixed point at 30° to the vertical, its spin about its axis "
              "20 rad/s in all; by Euler's angles.",
     .reference = {"I_1 Ω^2 cos θ − I_3 w_3 Ω + m g l = 0",
                   "p_φ and p_ψ are constant: one equation for θ"},
     .compared = "Both steady precessions, in which nutation shall be none; precession and "
                 "nutation of a top let go without, by both treatments of velocities in F.",
     .kind = Class::D2,
     .why = "Coriolis forces at the velocity of the beginning are of order 1, at the mean velocity "
            "of order 2. Steady precession is one of the discrete motions.",
     .source = "Lagrange; Goldstein.",
     .catches = {Fault::gyroscopic_dropped, Fault::stale_inertia, Fault::end_point_drift}},
    run, nullptr, __FILE__);

}  // namespace E05
}  // namespace validation
