// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/simulation.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_motion)

using namespace machines;
using talus::LagrangianParams;
using talus::LagrangianSimulation;
using talus::VelocityForces;

namespace {

/// Where a free double pendulum is after 1 s, and how much energy it has gained.
struct End {
    Two q;
    double gained;
};
End swing(double h, VelocityForces forces) {
    const DoublePendulum pendulum;
    LagrangianSimulation sim(pendulum, Two(1.2, -0.4), Two(1.0, 2.0), 0.0,
                             {.h = h, .velocity_forces = forces});
    const double start = pendulum.energy(sim.position(), sim.velocity());
    BOOST_TEST(sim.run(1.0).certified());
    return {sim.position(), pendulum.energy(sim.position(), sim.velocity()) - start};
}
/// Observed order between h and h / 2.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

}  // namespace

BOOST_AUTO_TEST_CASE(free_double_pendulum_has_the_order_that_is_promised) {
    const End exact = swing(1.0 / 16384, VelocityForces::implicit_midpoint);
    for (const auto& [forces, wanted] : {std::pair{VelocityForces::explicit_begin, 1.0},
                                         std::pair{VelocityForces::implicit_midpoint, 2.0}}) {
        const End coarse = swing(1.0 / 512, forces), fine = swing(1.0 / 1024, forces);
        BOOST_CHECK_SMALL(order(coarse.gained, fine.gained) - wanted, 0.05);
        BOOST_CHECK_SMALL(order((coarse.q - exact.q).norm(), (fine.q - exact.q).norm()) - wanted,
                          0.05);
    }
}

BOOST_AUTO_TEST_CASE(an_implicit_midpoint_step_is_its_own_mirror_in_time) {
    LagrangianSimulation sim(DoublePendulum{}, Two(1.2, -0.4), Two(1.0, 2.0), 0.0,
                             {.h = 1e-2, .velocity_forces = VelocityForces::implicit_midpoint});
    BOOST_TEST(sim.run(1.0).certified());
    sim.set_state(sim.position(), -sim.velocity());
    BOOST_TEST(sim.run(1.0).certified());
    BOOST_CHECK_SMALL((sim.position() - Two(1.2, -0.4)).norm(), 1e-11);
    BOOST_CHECK_SMALL((sim.velocity() + Two(1.0, 2.0)).norm(), 1e-11);
}

/// A damper too stiff for an explicit step, and one whose force is as the square of its speed.
struct Damped {
    static constexpr int dof = 1;
    double linear, square;
    void mass(double, const auto&, auto& a) const { a << 2.0; }
    void force(double, const auto&, const auto& u, auto& f) const {
        f << -linear * u[0] - square * u[0] * std::abs(u[0]);
    }
    void contacts(double, const auto&, auto&) const {}
};

BOOST_AUTO_TEST_CASE(implicit_midpoint_of_dampers) {
    const double h = 0.1;
    LagrangianParams params{.h = h, .velocity_forces = VelocityForces::implicit_midpoint};
    LagrangianSimulation stiff(Damped{100.0, 0.0}, Angle(0.0), Angle(1.0), 0.0, params);
    const double k = h * 100.0 / 2.0 / 2.0;
    BOOST_CHECK_CLOSE(stiff.step().end[0], (1.0 - k) / (1.0 + k), 1e-10);
    // 2 (v - 1) = -h c ((1 + v) / 2)^2, begun where the slope of the force is zero in no place.
    LagrangianSimulation drag(Damped{0.0, 3.0}, Angle(0.0), Angle(1.0), 0.0, params);
    const double v = drag.step().end[0];
    BOOST_CHECK_SMALL(2.0 * (v - 1.0) + h * 3.0 * (1.0 + v) * (1.0 + v) / 4.0, 1e-14);
}

/// Two masses of 1 kg that hang one below the other on springs with dampers. Displacements from
/// where the springs are slack, plus `tension` [N] that pulls up and down alike.
struct HangingPair {
    static constexpr int dof = 2;
    double stiffness = 500.0, damping = 20.0, tension = 0.0;
    void mass(double, const auto&, auto& a) const { a.setIdentity(); }
    void force(double, const auto& q, const auto& u, auto& f) const {
        const double upper = tension + stiffness * q[0] + damping * u[0];
        const double lower = tension + stiffness * (q[1] - q[0]) + damping * (u[1] - u[0]);
        f << lower - upper - g, tension - lower - g;
    }
    void contacts(double, const auto&, auto&) const {}
    Two rest() const { return Two(-2.0, -3.0) * g / stiffness; }
};

BOOST_AUTO_TEST_CASE(a_damped_machine_comes_to_rest) {
    for (const double damping : {0.5, 20.0, 300.0})
        for (const double tension : {0.0, 1e6})
            for (const double h : {1e-3, 1e-2}) {
                const HangingPair pair{.damping = damping, .tension = tension};
                LagrangianSimulation sim(
                    pair, Two(0.0, 0.0),
                    {.h = h, .velocity_forces = VelocityForces::implicit_midpoint});
                const auto run = sim.run(20.0);
                BOOST_TEST(run.certified(), to_string(run));
                // What rounding leaves: digits of forces, and a velocity that they make in a step.
                const double digits = 1e-15 * (tension + 100.0);
                if (damping >= 20.0) {
                    BOOST_CHECK_SMALL((sim.position() - pair.rest()).norm(),
                                      100.0 * digits / pair.stiffness + 1e-12);
                    BOOST_CHECK_SMALL(sim.velocity().norm(), 10.0 * digits + 1e-11);
                }
                if (tension == 0.0) BOOST_TEST(sim.data().free_report.iterations <= 5);
            }
}

BOOST_AUTO_TEST_CASE(a_damped_machine_begins_at_rest) {
    for (const double size : {1.0, 1e-6, 1e6}) {
        const HangingPair pair{.stiffness = 500.0 / size};
        LagrangianSimulation sim(pair, pair.rest(),
                                 {.h = 1e-3 * std::sqrt(std::min(1.0, size)),
                                  .velocity_forces = VelocityForces::implicit_midpoint});
        const auto run = sim.run(1000.0 * sim.params().h);
        BOOST_TEST(run.certified(), to_string(run));
        BOOST_CHECK_SMALL((sim.position() - pair.rest()).norm() / pair.rest().norm(), 1e-12);
    }
    LagrangianSimulation still(Damped{100.0, 3.0}, Angle(0.0), Angle(0.0), 0.0,
                               {.h = 0.1, .velocity_forces = VelocityForces::implicit_midpoint});
    BOOST_TEST(still.run(1.0).certified());
    BOOST_TEST(still.velocity()[0] == 0.0);
    BOOST_TEST(still.data().free_report.error == 0.0);
}

BOOST_AUTO_TEST_CASE(dampers_bring_a_speed_down_to_nothing) {
    for (const Damped& damper : {Damped{5.0, 0.0}, Damped{5.0, 1e3}, Damped{0.0, 1e4}}) {
        LagrangianSimulation sim(damper, Angle(0.0), Angle(1.0), 0.0,
                                 {.h = 0.1, .velocity_forces = VelocityForces::implicit_midpoint});
        const auto run = sim.run(1000.0);  // far below the smallest number, if it could
        BOOST_TEST(run.certified(), to_string(run));
        BOOST_TEST(std::abs(sim.velocity()[0]) < (damper.linear > 0.0 ? 1e-11 : 1e-3));
    }
}

/// Dry friction as a force, which jumps with the sign of the speed; or thrust that grows with it.
struct Jumpy {
    static constexpr int dof = 1;
    double friction, thrust;
    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double, const auto&, const auto& u, auto& f) const {
        f << 1.0 - friction * (u[0] > 0.0 ? 1.0 : -1.0) + thrust * u[0] * u[0];
    }
    void contacts(double, const auto&, auto&) const {}
};

BOOST_AUTO_TEST_CASE(a_free_velocity_that_is_not_found_is_told) {
    const LagrangianParams params{.h = 0.1, .velocity_forces = VelocityForces::implicit_midpoint};
    for (const Jumpy& system : {Jumpy{3.0, 0.0}, Jumpy{0.0, 1e4}}) {
        LagrangianSimulation sim(system, Angle(0.0), Angle(0.0), 0.0, params);
        const auto run = sim.run(params.h);
        BOOST_TEST(!run.certified());
        BOOST_TEST(run.missed == 0);
        BOOST_TEST(run.missed_free == 1);
        BOOST_TEST((sim.data().free_report.status != talus::FreeVelocityStatus::converged));
        BOOST_TEST(std::abs(sim.velocity()[0]) < 1.0);
        BOOST_TEST(to_string(run).find("not certified: 1 steps, 0 missed the tolerance, 1 did not "
                                       "find their free velocity (last change of it ") == 0u,
                   to_string(run));
    }
    LagrangianSimulation sliding(Jumpy{3.0, 0.0}, Angle(0.0), Angle(1.0), 0.0, params);
    BOOST_TEST(sliding.run(params.h).certified());
}

BOOST_AUTO_TEST_CASE(bead_on_a_rotating_hoop) {
    const BeadOnHoop hoop{5.0};
    const double rest = std::acos(g / 25.0), h = 1e-3;
    LagrangianSimulation still(hoop, Angle(rest), {.h = h});
    BOOST_TEST(still.run(1.0).certified());
    BOOST_CHECK_SMALL(still.position()[0] - rest, 1e-12);
    // About it, small swings of w = W sin(rest), which leapfrog makes (2/h) asin(w h / 2).
    LagrangianSimulation swinging(hoop, Angle(rest + 1e-6), {.h = h});
    const double w = 2.0 / h * std::asin(5.0 * std::sin(rest) * h / 2.0);
    BOOST_TEST(swinging.run(1.0).certified());
    BOOST_CHECK_SMALL((swinging.position()[0] - rest) / 1e-6 - std::cos(w), 2e-5);
    // At the bottom it stays on a slow hoop, and leaves a fast one.
    for (const double turning : {2.0, 5.0}) {
        LagrangianSimulation low(BeadOnHoop{turning}, Angle(1e-6), {.h = h});
        double farthest = 0.0;
        BOOST_TEST(low.run(5.0,
                           [&](const auto& s) {
                               farthest = std::max(farthest, std::abs(s.position()[0]));
                           })
                       .certified());
        BOOST_TEST((farthest > 1.0) == (turning * turning > g));
    }
}

BOOST_AUTO_TEST_CASE(double_pendulum_hits_a_wall_in_closed_form) {
    const Two q(0.3, 0.7), u(1.5, -0.4);
    Eigen::Matrix2d a, rows;
    a << 2.0, std::cos(q[0] - q[1]), std::cos(q[0] - q[1]), 1.0;
    rows << -std::cos(q[0]), -std::cos(q[1]), std::sin(q[0]), std::sin(q[1]);
    const Eigen::Matrix2d w = rows * a.inverse() * rows.transpose();
    for (const double mu : {0.0, 0.1, 5.0}) {
        for (const double e : {0.0, 0.5, 1.0}) {
            DoublePendulum pendulum{.gravity = 0.0};
            pendulum.wall_speed = -0.3;
            pendulum.law = {{mu}, e, e};
            const double h = 1e-3;
            pendulum.wall = std::sin(q[0]) + std::sin(q[1]) + 0.3 * h / 2.0 - 1e-12;
            // What the two speeds do to each other within the step is of order h and no matter
            // here.
            const auto forces = [&](const Two& v) {
                Two f;
                pendulum.force(0.0, q, v, f);
                return f;
            };
            LagrangianSimulation sim(pendulum, Two(q - 0.5 * h * u), u, 0.0, {.h = h});
            const auto& data = sim.step();
            BOOST_TEST(data.contact_count() == 1u);
            const Two prescribed(-0.3, 0.0);
            const Two begin = rows * u + prescribed;
            const Two free = begin + h * rows * a.inverse() * forces(u);
            const Two b = free + e * begin;
            // Stick if the cone allows, slip otherwise.
            Two r = -w.inverse() * b;
            if (std::abs(r[1]) > mu * r[0]) {
                for (const double way : {-1.0, 1.0}) {
                    const Two slip = -b[0] / (w(0, 0) + way * mu * w(0, 1)) * Two(1.0, way * mu);
                    if (slip[0] >= 0.0 && way * (w * slip + b)[1] <= 0.0) r = slip;
                }
            }
            BOOST_CHECK_SMALL((data.impulse[0] - talus::Vector<2>(r)).norm(), 1e-11);
            const Two end = u + a.inverse() * (h * forces(u) + rows.transpose() * r);
            BOOST_CHECK_SMALL((sim.velocity() - end).norm(), 1e-11);
            // The work of the contact is what kinetic energy at the midpoint has gained; the wall
            // gave that and what was lost.
            const double gained =
                0.5 * end.dot(a * end) - 0.5 * u.dot(a * u) - h * forces(u).dot(0.5 * (u + end));
            BOOST_CHECK_SMALL(data.contact_work() - gained, 1e-12);
            BOOST_CHECK_SMALL(data.contact_work() + data.contact_loss() + r.dot(prescribed), 1e-12);
            if (mu == 0.0 && e == 1.0) BOOST_CHECK_SMALL(data.contact_loss(), 1e-12);
            if (mu == 0.0 && e < 1.0) BOOST_TEST(data.contact_loss() > 0.01);
        }
    }
}

/// 2 kg on a floor that rises.
struct Lift {
    static constexpr int dof = 1;
    double speed = 1.0;
    void mass(double, const auto&, auto& a) const { a << 2.0; }
    void force(double, const auto&, const auto&, auto& f) const { f << -2.0 * g; }
    void gaps(const auto& t, const auto& q, auto& contacts) const {
        contacts.add(q[0] - speed * t, PlaneLaw{}, "floor");
    }
};

BOOST_AUTO_TEST_CASE(a_rising_floor_does_the_work) {
    const Lift lift;
    double work = 0.0, loss = 0.0;
    LagrangianSimulation sim(lift, Angle(0.0), Angle(0.0), 0.0, {.h = 1e-3});
    BOOST_TEST(sim.run(1.0,
                       [&](const auto& now) {
                           work += now.data().contact_work();
                           loss += now.data().contact_loss();
                       })
                   .certified());
    const double energy = 2.0 * g * sim.position()[0] + std::pow(sim.velocity()[0], 2);
    BOOST_CHECK_SMALL(work - energy, 1e-10);
    BOOST_CHECK_CLOSE(work, 2.0 * g + 1.0, 0.2);
    // The floor strikes 2 kg at 1 m/s, and gives 2 N s at that speed: half of it is lost.
    BOOST_CHECK_CLOSE(loss, 1.0, 2.0);
}

BOOST_AUTO_TEST_CASE(the_same_input_gives_the_same_bits) {
    DoublePendulum pendulum{.wall = 0.8};
    pendulum.law = {{0.3}, 0.4, 0.0};
    std::vector<Two> ends;
    LagrangianSimulation sim(pendulum, Two(1.0, -1.0), {.h = 1e-3});
    for (int run = 0; run < 2; ++run) {
        BOOST_TEST(sim.run(1.5).certified());
        ends.push_back(sim.position());
        sim.set_state(Two(1.0, -1.0), Two::Zero());
        BOOST_TEST(sim.time() == 0.0);
    }
    BOOST_TEST((ends[0] == ends[1]));
}

BOOST_AUTO_TEST_CASE(a_stack_lands_and_rests) {
    LagrangianSimulation sim(Stack{}, Eigen::VectorXd(Eigen::Vector3d(0.05, 0.2, 0.4)),
                             {.h = 1e-3});
    const talus::LagrangianSummary run = sim.run(1.0);
    BOOST_TEST(run.certified());
    BOOST_TEST(run.steps == 1000);
    BOOST_TEST(run.overlap.value < 3e-3);
    BOOST_TEST(run.overlap.value > 0.0);
    BOOST_CHECK_SMALL(sim.velocity().norm(), 1e-10);
    for (std::size_t c = 0; c < 3; ++c)
        BOOST_CHECK_CLOSE(sim.data().impulse[c][0] / sim.params().h, g * static_cast<double>(3 - c),
                          1e-8);
    BOOST_TEST(to_string(run).find("certified: 1000 steps") == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
