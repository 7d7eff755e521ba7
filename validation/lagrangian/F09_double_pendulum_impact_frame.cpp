// SPDX-License-Identifier: BSL-1.0
#include <Eigen/LU>

#include "harness/enumeration.hpp"
#include "harness/machine.hpp"

namespace validation {
namespace F09 {

/// Kane's double pendulum: two uniform rods of 1 kg and 1 m, the tip over a rough floor.
struct Rods {
    static constexpr int dof = 2;
    double floor;  ///< below the hinge [m]
    Law<2> contact;

    void mass(double, const auto& q, auto& a) const {
        const double c = std::cos(q[0] - q[1]) / 2;
        a << 4.0 / 3, c, c, 1.0 / 3;
    }
    void force(double, const auto& q, const auto& u, auto& f) const {
        const double s = std::sin(q[0] - q[1]) / 2;
        f << -s * u[1] * u[1] - 1.5 * g * std::sin(q[0]),
            s * u[0] * u[0] - 0.5 * g * std::sin(q[1]);
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        contacts.add(floor - cos(q[0]) - cos(q[1]), contact, "tip").slide[0] =
            sin(q[0]) + sin(q[1]);
    }
};

struct Impact {
    Eigen::Vector2d end, by_enumeration;
    double gained;  ///< by the contact [J]
    std::size_t solutions;
    std::string status;
};
/// One step from where the tip touches at the midpoint.
Impact hit(Trial<2>& trial, const Eigen::Vector2d& mid, const Eigen::Vector2d& u,
           const Law<2>& contact) {
    const double h = 1e-3;
    const Rods rods{std::cos(mid[0]) + std::cos(mid[1]) - 1e-13, contact};
    Machine<Rods> machine(trial, rods, mid - 0.5 * h * u, u, {.h = h});
    const auto& data = machine.step();
    Eigen::Matrix2d a, rows;
    Eigen::Vector2d f;
    rods.mass(0, mid, a);
    rods.force(0, mid, u, f);
    rows << std::sin(mid[0]), std::sin(mid[1]), std::cos(mid[0]), std::cos(mid[1]);
    const Eigen::Matrix2d inverse = a.inverse();
    const Eigen::Vector2d free = u + h * inverse * f, before = rows * u;
    PlanarProblem problem{rows * inverse * rows.transpose(), rows * free, {contact.law.mu}};
    problem.b[0] += contact.restitution_normal * before[0];
    problem.b[1] += contact.restitution_tangential * before[1];
    const Enumeration all(problem);
    Impact impact{machine.u(), free, data.contact_work(), all.velocities().size(), "none"};
    if (all.solutions().empty()) return impact;
    impact.status = all.solutions()[0].status;
    impact.by_enumeration = free + inverse * rows.transpose() * all.solutions()[0].r;
    return impact;
}

void run(Trial<2>& trial) {
    auto rng = trial.rng();
    std::uniform_real_distribution<double> angle(-1.5, 1.5), speed(-2.0, 2.0), unit(0.05, 0.95);
    Worst equal, unequal, most;
    int stuck = 0, slid = 0, gains = 0;
    const int count = trial.full() ? 4000 : 400;
    for (int k = 0; k < count; ++k) {
        const Eigen::Vector2d q(angle(rng), angle(rng)), u(speed(rng), speed(rng));
        const double mu = unit(rng), e = unit(rng);
        if (std::sin(q[0]) * u[0] + std::sin(q[1]) * u[1] > -0.1) continue;
        const Impact same = hit(trial, q, u, law<2>(mu, e, e));
        if (same.solutions != 1) continue;
        equal.see(same.end, same.by_enumeration);
        most.see(std::max(0.0, same.gained), 0.0);
        (same.status == "s" ? stuck : slid) += 1;
        const Impact other = hit(trial, q, u, law<2>(mu, e, 0.0));
        if (other.solutions != 1) continue;
        unequal.see(other.end, other.by_enumeration);
        gains += other.gained > 1e-6 ? 1 : 0;
    }
    // Spins of up to 10 rad/s come of impulses on arms that nearly vanish.
    trial.rounding("spins after, e_t = e_n, worst of all [rad/s]", equal, 10.0);
    trial.rounding("spins after, e_t = 0, worst of all [rad/s]", unequal, 10.0);
    trial.within("energy gained, e_t = e_n, worst of all [J]", most, 1e-12, "none, to rounding");
    trial.holds("tips that stick and tips that slide are among them", stuck > 10 && slid > 10);
    trial.holds("with e_t = 0 some gain energy, a property of the law", gains > 0);
    trial.note(std::to_string(stuck) + " stuck, " + std::to_string(slid) + " slid; with e_t = 0 " +
               std::to_string(gains) + " gained energy (Kane's paradox)");
    // Kane and Levinson's: a restitution that is not the same in both directions may create energy.
    const Impact paradox = hit(trial, {pi / 9, pi / 6}, {-0.1, -0.2}, law<2>(0.5, 0.5, 0.0));
    trial.rounding("Kane's configuration [rad/s]", Eigen::Vector2d(paradox.end),
                   paradox.by_enumeration, 1.0);
}

const Register f09(
    {.id = "F09",
     .name = "double-pendulum-impact-frame",
     .title = "Kane's double pendulum strikes the floor",
     .gate = 1,
     .setup = "Two uniform rods with the tip on a rough floor, 400 random configurations, speeds, "
              "coefficients of friction and restitution; one step.",
     .reference = {"W = G A^{−1} G^T, every status tried", "e_t = e_n: energy gained ≤ 0"},
     .compared = "Spins after the step with an enumeration of open, stuck and sliding by dense "
                 "linear algebra; the work of the contact.",
     .kind = Class::R,
     .why = "One contact is solved exactly.",
     .source = "Kane and Levinson 1985.",
     .catches = {Fault::friction_off, Fault::tilted_normal, Fault::restitution_weight,
                 Fault::friction_on_end_velocity, Fault::gyroscopic_dropped, Fault::short_arm}},
    run, nullptr, __FILE__);

}  // namespace F09
}  // namespace validation
