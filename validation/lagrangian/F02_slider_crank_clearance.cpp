// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/machine.hpp"

namespace validation {
namespace F02 {

constexpr double l1 = 0.153, l2 = 0.306, half_length = 0.05, half_height = 0.025, clearance = 1e-3;
constexpr double m1 = 0.038, m2 = 0.038, m3 = 0.076, j1 = 7.4e-5, j2 = 5.9e-4, j3 = 2.7e-6;

/// Angles of crank, rod and slider; the slider has play in its guide.
struct SliderCrank {
    static constexpr int dof = 3;

    void mass(double, const auto& q, auto& a) const {
        const double m12 = (m2 / 2 + m3) * l1 * l2 * std::cos(q[1] - q[0]);
        a << j1 + (m1 / 4 + m2 + m3) * l1 * l1, m12, 0.0,  //
            m12, j2 + (m2 / 4 + m3) * l2 * l2, 0.0,        //
            0.0, 0.0, j3;
    }
    void force(double, const auto& q, const auto& u, auto& f) const {
        const double k = (m2 / 2 + m3) * l1 * l2 * std::sin(q[1] - q[0]);
        f << k * u[1] * u[1] - (m1 / 2 + m2 + m3) * g * l1 * std::cos(q[0]),
            -k * u[0] * u[0] - (m2 / 2 + m3) * g * l2 * std::cos(q[1]), 0.0;
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        using Real = typename std::decay_t<decltype(contacts)>::Real;
        for (const double up : {1.0, -1.0})
            for (const double along : {-half_length, half_length}) {
                const Real x = l1 * cos(q[0]) + l2 * cos(q[1]) + along * cos(q[2]) -
                               up * half_height * sin(q[2]);
                const Real y = l1 * sin(q[0]) + l2 * sin(q[1]) + along * sin(q[2]) +
                               up * half_height * cos(q[2]);
                contacts.add(half_height + clearance - up * y, law<2>(0.01, 0.4), "corner")
                    .slide[0] = x;
            }
    }
    double energy(const Eigen::Vector3d& q, const Eigen::Vector3d& u) const {
        Eigen::Matrix3d a;
        mass(0.0, q, a);
        return 0.5 * u.dot(a * u) + (m1 / 2 + m2 + m3) * g * l1 * std::sin(q[0]) +
               (m2 / 2 + m3) * g * l2 * std::sin(q[1]);
    }
};

struct Seen {
    std::vector<double> impacts;  ///< times of those from above 1 mm/s
    Eigen::Vector3d q, u;
    double energy = 0.0;  ///< of that at the beginning
    Series path;
};
Seen watch(Trial<2>& trial, double h) {
    const SliderCrank crank;
    const Eigen::Vector3d q(0.0, 0.0, 0.0), u(150.0, -75.0, 0.0);
    Machine<SliderCrank> machine(trial, crank, q, u, {.h = h, .size = half_height});
    Seen seen;
    seen.path.name = "h = " + std::to_string(1e6 * h) + " µs";
    machine.run(0.02, [&](const auto& data) {
        const double middle = l1 * std::sin(data.q_end[0]) + l2 * std::sin(data.q_end[1]);
        seen.path.x.push_back(1e3 * data.t_end()), seen.path.y.push_back(1e3 * middle);
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            if (data.begin_velocity(c)[0] < -1e-3 && data.impulse[c][0] > 0.0 &&
                (seen.impacts.empty() || data.t_mid > seen.impacts.back() + 1e-4))
                seen.impacts.push_back(data.t_mid);
    });
    seen.q = machine.q();
    seen.u = machine.u();
    seen.energy = crank.energy(seen.q, seen.u) / crank.energy(q, u);
    return seen;
}

void run(Trial<2>& trial) {
    const double times[] = {2.70e-3, 5.63e-3, 7.51e-3};
    for (const double h : {2e-5, 1e-5, 5e-6}) {
        const Seen seen = watch(trial, h);
        for (std::size_t k = 0; k < 3; ++k)
            trial.within("impact " + std::to_string(k + 1) + " [s]",
                         k < seen.impacts.size() ? seen.impacts[k] : std::nan(""), times[k],
                         1e-5 + (k < 2 ? 2 : 8) * h, "digits and 2 h; 8 h for the third", h,
                         Class::D1);
        trial.within("angle of the crank at 0.02 s [rad]", seen.q[0], 1.6128, 1e-4 + 200 * h,
                     "digits and order h", h, Class::D1);
        trial.within("angle of the rod at 0.02 s [rad]", seen.q[1], -0.51994, 1e-4 + 200 * h,
                     "digits and order h", h, Class::D1);
        trial.within("angle of the slider at 0.02 s [rad]", seen.q[2], 0.0, 1e-9,
                     "both corners of a side touch", h);
        if (h == 5e-6) {
            trial.within("energy at 0.02 s, of that at the beginning", seen.energy, 0.99273, 5e-5,
                         "an independent stepper at the same step", h);
            trial.curves({"height of the slider",
                          "t [ms]",
                          "[mm]",
                          {seen.path,
                           {"guide", {0, 20}, {1, 1}, true},
                           {"guide, lower", {0, 20}, {-1, -1}, true}}});
        }
        if (h == 1e-5)
            trial.within("energy at 0.02 s, of that at the beginning", seen.energy, 0.99175, 5e-5,
                         "an independent stepper at the same step", h);
    }
    // Differences of successive halvings, against the finest.
    std::vector<Eigen::Vector3d> ends;
    const auto steps = halvings(1.6e-5, 6);
    for (const double h : steps) ends.push_back(watch(trial, h).q);
    const Eigen::Vector3d limit = 2 * ends[5] - ends[4];
    trial.order(
        "angles at 0.02 s", std::span(steps).first(5),
        [&](double h) {
            return (ends[static_cast<std::size_t>(std::find(steps.begin(), steps.end(), h) -
                                                  steps.begin())] -
                    limit)
                .norm();
        },
        first_order_irregular);
}

const Register f02(
    {.id = "F02",
     .name = "slider-crank-clearance",
     .title = "A slider with play in its guide",
     .gate = 2,
     .setup = "A crank at 150 rad/s drives a slider that has 1 mm of play to either side in its "
              "guide; three angles, four corners, restitution 0.4, friction 0.01.",
     .reference = {"impacts at 2.70, 5.63, 7.51 ms",
                   "at 0.02 s: θ_1 = 1.6128, θ_2 = −0.51994, θ_3 = 0"},
     .compared = "The first impacts; angles at 0.02 s, with the order against their limit; the "
                 "energy left, with an independent stepper at the same step.",
     .kind = Class::D1,
     .why = "Coriolis forces at the velocity of the beginning, impacts to a step: order 1.",
     .source = "Flores, Leine and Glocker 2010; numbers by an enumerating stepper.",
     .catches = {Fault::restitution_weight, Fault::gyroscopic_dropped, Fault::loose_contact,
                 Fault::stale_inertia}},
    run, nullptr, __FILE__);

}  // namespace F02
}  // namespace validation
