// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/machine.hpp"

namespace validation {
namespace F06 {

constexpr double slope = 0.08, mu = 10.0;

/// A hub of 1 kg with n spokes of 1 m: place along and above the slope, angle in the sense of
/// rolling down.
struct Wheel {
    static constexpr int dof = 3;
    int n;
    double inertia, gravity = g;

    double half() const { return pi / n; }
    void mass(double, const auto&, auto& a) const { a.diagonal() << 1.0, 1.0, inertia; }
    void force(double, const auto&, const auto&, auto& f) const {
        f << gravity * std::sin(slope), -gravity * std::cos(slope), 0.0;
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        for (int k = 0; k < n; ++k) {
            const double turn = 2 * half() * k;
            contacts.add(q[1] - cos(q[2] + turn), law<2>(mu), "foot").slide[0] =
                q[0] - sin(q[2] + turn);
        }
    }
    double ratio() const { return (inertia + std::cos(2 * half())) / (inertia + 1); }
    /// Spin before the impacts of the steady gait.
    double spin() const {
        const double fed = 4 * g * std::sin(half()) * std::sin(slope) / (inertia + 1);
        return std::sqrt(fed / (1 - ratio() * ratio()));
    }
    /// From one impact of the steady gait to the next.
    double step_time() const {
        const double begin = ratio() * spin(), k = 2 * g / (inertia + 1);
        return gsl::integral(
            [&](double x) {
                return 1 / std::sqrt(begin * begin +
                                     k * (std::cos(slope - half()) - std::cos(slope + x)));
            },
            -half(), half());
    }
};

/// One impact without gravity: the wheel turns about its rear foot, and the front one lands.
void impact(Trial<2>& trial, const Wheel& wheel, double ratio) {
    const double h = 1e-3, spin = 1.3, al = wheel.half();
    const Eigen::Vector3d mid(std::sin(al), std::cos(al), al);
    // About the rear foot, the one of spoke 0, at the origin.
    const Eigen::Vector3d u(spin * std::cos(al), -spin * std::sin(al), spin);
    Machine<Wheel> machine(trial, wheel, mid - 0.5 * h * u - Eigen::Vector3d(0, 1e-13, 0), u,
                           {.h = h});
    const auto& data = machine.step();
    const std::string name = ", n = " + std::to_string(wheel.n);
    trial.within("reference, ratio of spins" + name, wheel.ratio(), ratio, 5e-10, "digits");
    trial.holds("two feet are closed" + name, data.contact_count() == 2);
    trial.within("ratio of spins" + name, data.end[2] / spin, ratio, 5e-10,
                 "digits; the feet are 1e-13 m deep", h);
    trial.rounding("the trailing foot gets nothing" + name, data.impulse_at(0)[0], 0.0, spin);
    trial.holds("and opens by itself" + name,
                data.contacts[0].relative_velocity(data.end)[0] > 0.1);
}

struct Gait {
    double spin = 0.0, step_time = 0.0;  ///< means of six steps after six
    Series path;
};
Gait walk(Trial<2>& trial, const Wheel& wheel, double h) {
    const double al = wheel.half(), begin = wheel.ratio() * wheel.spin();
    Machine<Wheel> machine(trial, wheel, Eigen::Vector3d(-std::sin(al), std::cos(al), -al),
                           Eigen::Vector3d(begin * std::cos(al), begin * std::sin(al), begin),
                           {.h = h, .size = 0.1});
    Gait gait;
    gait.path.name = "h = " + std::to_string(h);
    int impacts = 0;
    double last = 0.0;
    machine.run(14 * wheel.step_time(), [&](const auto& data) {
        gait.path.x.push_back(data.t_end()), gait.path.y.push_back(data.end[2]);
        if (!(data.begin[2] - data.end[2] > 0.05 * wheel.spin())) return true;
        ++impacts;
        if (impacts > 6) {
            gait.spin += data.begin[2] / 6;
            gait.step_time += (data.t_mid - last) / 6;
        }
        last = data.t_mid;
        return impacts < 12;
    });
    if (impacts < 12) gait.spin = std::nan("");
    return gait;
}

void run(Trial<2>& trial) {
    trial.within("reference, massless spokes, spin [rad/s]", Wheel{8, 0.0}.spin(), 1.549218405,
                 5e-10, "digits");
    trial.within("reference, massless spokes, step [s]", Wheel{8, 0.0}.step_time(), 1.034549811,
                 5e-10, "digits");
    impact(trial, {8, 0.3, 0.0}, 0.774697524);
    impact(trial, {6, 0.3, 0.0}, 0.615384615);
    impact(trial, {12, 0.3, 0.0}, 0.896942618);

    const Wheel wheel{8, 0.3};
    const auto steps = halvings(4e-3, 5);
    std::vector<Gait> gaits;
    for (const double h : steps) {
        gaits.push_back(walk(trial, wheel, h));
        trial.within("spin before impacts [rad/s]", gaits.back().spin, wheel.spin(), 6 * h,
                     "order h", h, Class::D1);
        trial.within("time of a step [s]", gaits.back().step_time, wheel.step_time(), 6 * h,
                     "order h", h, Class::D1);
    }
    trial.curves({"spin, twelve steps", "t [s]", "[rad/s]", {gaits.back().path}});
}

const Register f06(
    {.id = "F06",
     .name = "rimless-wheel",
     .title = "A wheel without a rim walks down a slope",
     .gate = 2,
     .setup = "Spokes of 1 m at a hub of 1 kg and 0.3 kg m^2, a slope of 0.08 rad, soft impacts, "
              "friction 10; three coordinates, a contact for each foot.",
     .reference = {"frac{w_+}{w_-} = frac{I + m l^2 cos 2α}{I + m l^2}, α = frac{π}{n}",
                   "w_-^2 = frac{4 m g l sin α sin γ}{(I + m l^2) (1 − (w_+ / w_-)^2)}"},
     .compared =
         "One impact without gravity, for 6, 8 and 12 spokes; spin and time of steps of the "
         "steady gait over steps 7 to 12.",
     .kind = Class::D1,
     .why = "The impact is exact but for 1e-13 m by which both feet are made to touch. The gait "
            "turns about a foot, a curved constraint, and meets the next within a step.",
     .source = "McGeer 1990; Coleman 1998; the gait with inertia from the same balance of energy.",
     .catches = {Fault::pulling_contact, Fault::reaction_lost, Fault::begin_point}},
    run, nullptr, __FILE__);

}  // namespace F06
}  // namespace validation
