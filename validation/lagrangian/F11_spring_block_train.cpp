// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/machine.hpp"

namespace validation {
namespace F11 {

constexpr double stiffness = 50.0, coupling = 30.0, belt = 0.2, mu = 0.4;
const double w = std::sqrt(stiffness), stretch = mu * g / stiffness;

/// Two blocks of 1 kg on a belt, each tied to the ground and both to each other: (x, y) of each.
struct Train {
    static constexpr int dof = 4;

    void mass(double, const auto&, auto& a) const { a.setIdentity(); }
    void force(double, const auto& q, const auto&, auto& f) const {
        const double between = coupling * (q[2] - q[0]);
        f << -stiffness * q[0] + between, -g, -stiffness * q[2] - between, -g;
    }
    void gaps(const auto& t, const auto& q, auto& contacts) const {
        for (int k = 0; k < 2; ++k)
            contacts.add(q[2 * k + 1], law<2>(mu), "block").slide[0] = q[2 * k] - belt * t;
    }
};
using Four = Eigen::Vector4d;

/// Both together: carried, then swinging about the stretch that friction holds, and just not
/// carried again.
double together(double t) {
    const double from = stretch / belt;
    return t < from ? belt * t : stretch + belt / w * std::sin(w * (t - from));
}
double error_together(Trial<2>& trial, double h, Series* path = nullptr) {
    Machine<Train> machine(trial, {}, Four::Zero(), Four(belt, 0, belt, 0), {.h = h});
    double worst = 0.0, apart = 0.0;
    machine.run(4.0, [&](const auto& data) {
        worst = std::max(worst, std::abs(data.q_end[0] - together(data.t_end())));
        apart = std::max(apart, std::abs(data.q_end[0] - data.q_end[2]));
        if (path) path->x.push_back(data.t_end()), path->y.push_back(data.q_end[0]);
    });
    trial.rounding("both blocks move alike [m]", apart, 0.0, 4 / h, h);
    return worst;
}

/// Sliding all the time, slower than the belt: two modes of small swings.
double error_apart(Trial<2>& trial, double h) {
    const double u1 = 0.5 * belt, u2 = 0.3 * belt, fast = std::sqrt(stiffness + 2 * coupling);
    Machine<Train> machine(trial, {}, Four(stretch, 0, stretch, 0), Four(u1 + u2, 0, u1 - u2, 0),
                           {.h = h});
    double worst = 0.0;
    machine.run(4.0, [&](const auto& data) {
        const double t = data.t_end();
        const double same = u1 / w * std::sin(w * t), other = u2 / fast * std::sin(fast * t);
        worst = std::max({worst, std::abs(data.q_end[0] - stretch - same - other),
                          std::abs(data.q_end[2] - stretch - same + other)});
    });
    return worst;
}

/// Largest distance of the blocks from moving together, begun 1e-4 m apart where both slide.
double grown(Trial<2>& trial, double h) {
    const double off = 1e-4, speed = 0.9 * belt;
    Machine<Train> machine(trial, {}, Four(stretch + off / 2, 0, stretch - off / 2, 0),
                           Four(speed, 0, speed, 0), {.h = h});
    double largest = 0.0;
    machine.run(4.0, [&](const auto& data) {
        largest = std::max(largest, std::abs(data.q_end[0] - data.q_end[2]));
    });
    return largest / off;
}

void run(Trial<2>& trial) {
    trial.within("reference, begin to slide at [s]", stretch / belt, 0.3924, 1e-12, "exact");
    const auto steps = halvings(1.1e-2, 6);
    Series seen{"talus", {}, {}}, exact{"exact", {}, {}, true};
    error_together(trial, 1e-3, &seen);
    for (int k = 0; k <= 200; ++k)
        exact.x.push_back(4.0 * k / 200), exact.y.push_back(together(exact.x.back()));
    trial.curves({"both together", "t [s]", "x [m]", {seen, exact}});
    for (const double h : {1e-3, 1e-4})
        trial.within("place, moving together, worst [m]", error_together(trial, h), 0.0, 3 * h * h,
                     "catalogue, A16: 1.5 h^2", h, Class::D2);
    trial.order(
        "place, sliding apart", steps, [&](double h) { return error_apart(trial, h); },
        second_order, 3.0);
    trial.within("a small distance grows to, of itself", grown(trial, 1e-3), 1.0, 1e-3,
                 "it swings: leapfrog, h^2", 1e-3);
}

const Register f11(
    {.id = "F11",
     .name = "spring-block-train",
     .title = "Two blocks on a belt, tied to the ground and to each other",
     .gate = 1,
     .setup =
         "Burridge and Knopoff's model with two blocks of 1 kg, springs of 50 and 30 N/m, a "
         "belt of 0.2 m/s, friction 0.4; four coordinates, the belt as a displacement in time.",
     .reference = {"x_s = frac{μ m g}{k}, t_1 = frac{x_s}{V}",
                   "together: x_s + frac{V}{w} sin w(t − t_1), as one block (A16)",
                   "sliding apart: modes of w^2 = frac{k}{m} and frac{k + 2 k_c}{m}"},
     .compared = "Motion together, which grazes the speed of the belt in each period; motion apart "
                 "below that speed; how a small distance grows.",
     .kind = Class::D2,
     .why = "Friction is constant while blocks slide: leapfrog of two oscillators.",
     .source = "Burridge and Knopoff 1967; Den Hartog 1931.",
     .catches = {Fault::friction_off, Fault::obstacle_velocity_forgotten, Fault::force_at_begin,
                 Fault::end_point_drift}},
    run, nullptr, __FILE__);

}  // namespace F11
}  // namespace validation
