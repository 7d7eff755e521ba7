// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Eigenvalues>

#include "harness/machine.hpp"

namespace validation {
namespace U03 {

/// Points of 1 kg on massless links of 1 m, angles from the vertical; as many as q has. A wall
/// x = 0 may be met by every point.
struct Chain {
    static constexpr int dof = Eigen::Dynamic;
    double gravity = g;
    bool wall = false;

    static double below(Eigen::Index i, Eigen::Index j, Eigen::Index n) {
        return static_cast<double>(n - std::max(i, j));
    }
    void mass(double, const auto& q, auto& a) const {
        for (Eigen::Index i = 0; i < q.size(); ++i)
            for (Eigen::Index j = 0; j < q.size(); ++j)
                a(i, j) = below(i, j, q.size()) * std::cos(q[i] - q[j]);
    }
    void force(double, const auto& q, const auto& u, auto& f) const {
        for (Eigen::Index i = 0; i < q.size(); ++i) {
            f[i] = -gravity * below(i, i, q.size()) * std::sin(q[i]);
            for (Eigen::Index j = 0; j < q.size(); ++j)
                f[i] -= below(i, j, q.size()) * std::sin(q[i] - q[j]) * u[j] * u[j];
        }
    }
    void contacts(double, const auto& q, auto& contacts) const {
        double x = 0.0;
        for (Eigen::Index k = 0; wall && k < q.size(); ++k) {
            x += std::sin(q[k]);
            auto& c = contacts.add(x, law<2>(0.0, 1.0), "point");
            for (Eigen::Index i = 0; i <= k; ++i) c.rows(0, i) = std::cos(q[i]);
        }
    }
    double energy(const Eigen::VectorXd& q, const Eigen::VectorXd& u) const {
        Eigen::MatrixXd a(q.size(), q.size());
        mass(0.0, q, a);
        double energy = 0.5 * u.dot(a * u);
        for (Eigen::Index i = 0; i < q.size(); ++i)
            energy -= gravity * below(i, i, q.size()) * std::cos(q[i]);
        return energy;
    }
};

void run(Trial<2>& trial) {
    constexpr Eigen::Index n = 5;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), k = a;
    Chain{}.mass(0.0, Eigen::VectorXd::Zero(n), a);
    for (Eigen::Index i = 0; i < n; ++i) k(i, i) = g * Chain::below(i, i, n);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, a);
    const double zeros[] = {0.263560319718, 1.413403059107, 3.596425771041, 7.085810005859,
                            12.640800844276};
    for (Eigen::Index m = 0; m < n; ++m) {
        const std::string name = ", mode " + std::to_string(m + 1);
        trial.within("reference, w^2 l / g is a zero of Laguerre's polynomial" + name,
                     modes.eigenvalues()[m] / g, zeros[m], 1e-10, "twelve digits");
        // A small swing in this mode alone, as leapfrog makes it.
        const double h = 1e-3, off = 1e-6, w = 2 / h * std::asin(std::sqrt(zeros[m] * g) * h / 2);
        const Eigen::VectorXd shape = modes.eigenvectors().col(m);
        Machine<Chain> chain(trial, {}, off * shape, Eigen::VectorXd::Zero(n), {.h = h});
        Worst worst;
        chain.run(3.0, [&](const auto& data) {
            worst.see(Eigen::VectorXd(data.q_end / off),
                      Eigen::VectorXd(std::cos(w * data.t_end()) * shape));
        });
        trial.within("small swing, of its size" + name, worst, 1e-6, "what is not linear in it", h);
    }
    // A wide swing.
    Eigen::VectorXd q(n), u = Eigen::VectorXd::Zero(n);
    q << 1.0, 1.1, 1.2, 1.3, 1.4;
    const Chain chain;
    for (const auto forces :
         {talus::VelocityForces::explicit_begin, talus::VelocityForces::implicit_midpoint}) {
        const bool implicit = forces == talus::VelocityForces::implicit_midpoint;
        trial.order(
            std::string("energy after 1 s, Coriolis forces ") +
                (implicit ? "at the mean velocity" : "at the beginning"),
            halvings(4e-3, 5),
            [&](double h) {
                Machine<Chain> machine(trial, chain, q, u, {.h = h, .velocity_forces = forces});
                machine.run(1.0);
                return chain.energy(machine.q(), machine.u()) - chain.energy(q, u);
            },
            implicit ? second_order : first_order);
    }
    // Whipped against a wall without gravity and without loss: energy is that of before.
    Machine<Chain> whip(trial, {0.0, true}, q, Eigen::VectorXd::Constant(n, -2.0),
                        {.h = 1e-4, .velocity_forces = talus::VelocityForces::implicit_midpoint});
    const double before = Chain{0.0, true}.energy(q, whip.u());
    Worst work;
    int impacts = 0;
    whip.run(1.5, [&](const auto& data) {
        work.see(data.contact_work() / before, 0.0);
        for (const auto& r : data.impulse) impacts += r[0] > 0.0 ? 1 : 0;
    });
    trial.rounding("work of elastic impacts, worst step, of the energy", work, 10.0, 1e-4);
    trial.holds("the chain has hit the wall", impacts > 0);
}

const Register u03(
    {.id = "U03",
     .name = "hanging-chain",
     .title = "A chain swings, and whips a wall",
     .gate = 1,
     .setup = "Five points of 1 kg on links of 1 m, by the angles of the links: a full A(q), whose "
              "size is known at run time.",
     .reference = {"small swings: w^2 = x_m frac{g}{l}, L_5(x_m) = 0",
                   "energy is constant; elastic impacts do no work"},
     .compared = "Small swings of each mode step by step; the order of the energy of a wide swing, "
                 "with F as the paper takes it and at the mean velocity; the work of impacts.",
     .kind = Class::D2,
     .why =
         "Leapfrog of a linear oscillator has a known frequency. Coriolis forces at the velocity "
         "of the beginning are of order 1, at the mean of order 2. With e = 1 the mean velocity "
         "vanishes where there is an impulse.",
     .source = "Bernoulli 1738: Laguerre's polynomials.",
     .catches = {Fault::force_at_begin, Fault::end_point_drift, Fault::stale_inertia,
                 Fault::restitution_weight, Fault::reaction_lost}},
    run, nullptr, __FILE__);

}  // namespace U03
}  // namespace validation
