// SPDX-License-Identifier: BSL-1.0
// Cells driven by a stress, against closed forms: crystals at rest, free fall, a press.
#include <talus/geometry/ball.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"
#include "common/said.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_driven_cell)

template <int Dim>
using V = talus::Vector<Dim>;
template <int Dim>
using M = talus::Matrix<Dim>;
template <int Dim>
using Cell = talus::PeriodicCell<Dim>;
template <int Dim>
using Drive = talus::CellDrive<Dim>;

/// A square (cubic) crystal of 3^Dim balls in touch, some of them moved by whole cells.
template <class Sim, int Dim>
void add_crystal(Sim& sim, double radius, bool moved) {
    random_geometry::Generator g(5);
    const double side = 6.0 * radius;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < (Dim == 3 ? 3 : 1); ++k) {
                V<Dim> x = i * V<Dim>::Unit(0) + j * V<Dim>::Unit(1);
                x += (Dim == 3 ? k : 0) * V<Dim>::Unit(Dim - 1);
                x = 2.0 * radius * (x + 0.5 * V<Dim>::Ones());
                for (int d = 0; moved && d < Dim; ++d)
                    x[d] += side * (static_cast<double>(g() % 5) - 2.0);
                sim.system().add(talus::Ball<Dim>{radius}, 1000.0, {x, {}});
            }
    sim.system().set_cell(Cell<Dim>::box(side * V<Dim>::Ones()));
}

/// In the mean a contact carries p (2 R)^(Dim - 1), the mean stress is -p, nothing moves.
template <class Types, int Dim>
void crystal_under_pressure(typename talus::Simulation<Dim, Types>::Solver solver, bool moved) {
    constexpr double pressure = 1e4, radius = 0.05, side = 6.0 * radius;
    talus::SimulationParams params;
    params.h = 1e-3;
    talus::Simulation<Dim, Types> sim(experiment::law<Dim>(0.0), params, std::move(solver));
    add_crystal<talus::Simulation<Dim, Types>, Dim>(sim, radius, moved);
    sim.system().drive_cell(Drive<Dim>::pressure(pressure, 1.0));
    const auto begin = sim.state();
    for (int step = 0; step < 20; ++step) {
        const auto& data = sim.step();
        BOOST_TEST(data.contact_count() == sim.system().bodies.count() * std::size_t{Dim});
        std::vector<V<Dim>> forces;
        talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces);
        const M<Dim> stress =
            talus::cell_stress<Dim>(data.problem.jacobian, forces, sim.system().bodies, *data.cell);
        BOOST_TEST((stress + pressure * M<Dim>::Identity()).norm() < 1e-7 * pressure);
        // Of rows in parallel only the sum is known: it is hyperstatic.
        double mean = 0.0;
        for (const auto& r : data.impulse)
            mean += r[0] / (data.h * static_cast<double>(data.contact_count()));
        BOOST_CHECK_CLOSE(mean, pressure * std::pow(2.0 * radius, Dim - 1), 1e-5);
    }
    BOOST_TEST((sim.system().cell()->lattice() - side * M<Dim>::Identity()).norm() < 1e-9);
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        BOOST_TEST((sim.system().bodies.position[i] - begin.bodies.position[i]).norm() < 1e-8);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_crystal_bears_the_pressure, D, dimensions) {
    constexpr int Dim = D::value;
    using Sweeps = experiment::Sweeping<Dim>;
    const typename Sweeps::Solver tight({.max_sweeps = 100000, .tolerance = 1e-12});
    crystal_under_pressure<Sweeps, Dim>(tight, false);
    crystal_under_pressure<Sweeps, Dim>(tight, true);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_empty_cell_falls_into_itself, D, dimensions) {
    // dL/dt = -p V / m - damping L at first: L = -(p V / m damping) (1 - (1 - h damping)^n).
    constexpr int Dim = D::value;
    constexpr double h = 1e-4, p = 10.0, mass = 2.0, damping = 50.0;
    talus::Simulation<Dim, experiment::Sweeping<Dim>> sim(experiment::law<Dim>(0.3), {.h = h});
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {});
    sim.system().set_cell(Cell<Dim>::box(V<Dim>::Ones()));
    auto drive = Drive<Dim>::pressure(p, mass);
    drive.damping = damping;
    sim.system().drive_cell(drive);
    for (int step = 0; step < 100; ++step) sim.step();
    const double expected = -p / (mass * damping) * (1.0 - std::pow(1.0 - h * damping, 100.0));
    const M<Dim> rate = sim.system().cell()->velocity_gradient();
    BOOST_TEST((rate - expected * M<Dim>::Identity()).norm() < 2e-3 * std::abs(expected));
    drive.top_rate = 0.01;
    sim.system().drive_cell(drive);
    for (int step = 0; step < 10; ++step) sim.step();
    BOOST_TEST((sim.system().cell()->velocity_gradient() + 0.01 * M<Dim>::Identity()).norm() ==
               0.0);
    // What is not driven stays.
    drive.driven[0][0] = false;
    sim.system().drive_cell(drive);
    M<Dim> own = M<Dim>::Zero();
    own(0, 0) = 0.02;
    sim.system().set_velocity_gradient(own);
    sim.step();
    BOOST_TEST(sim.system().cell()->velocity_gradient()(0, 0) == 0.02);
    BOOST_TEST(sim.system().cell()->velocity_gradient()(1, 1) < 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_gas_is_pressed_together_with_books_that_close, D, dimensions) {
    constexpr int Dim = D::value;
    constexpr double pressure = 2e3, h = 1e-3;
    talus::Simulation<Dim> sim(experiment::law<Dim>(0.0), {.h = h});
    random_geometry::Generator g(6);
    constexpr int side = Dim == 2 ? 6 : 3;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < (Dim == 3 ? side : 1); ++k) {
                V<Dim> x = i * V<Dim>::Unit(0) + j * V<Dim>::Unit(1);
                x += (Dim == 3 ? k : 0) * V<Dim>::Unit(Dim - 1);
                for (int d = 0; d < Dim; ++d) x[d] += side * (static_cast<double>(g() % 3) - 1.0);
                sim.system().add(talus::Ball<Dim>{random_geometry::uniform(g, 0.03, 0.05)}, 1000.0,
                                 {0.12 * x, {}}, {0.3 * random_geometry::direction<Dim>(g), {}});
            }
    sim.system().set_cell(Cell<Dim>::box(0.12 * side * V<Dim>::Ones()));
    double mass = 0.0;
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        mass += sim.system().bodies.mass(i);
    auto drive = Drive<Dim>::pressure(pressure, 0.1 * mass * std::pow(0.12 * side, 2.0));
    drive.damping = 5.0;
    sim.system().drive_cell(drive);
    talus::EnergyLedger<Dim> books(sim.system().bodies, sim.system().gravity);
    auto resumed = sim;
    const talus::RunSummary run = sim.run(0.8, [&](const auto& s) {
        books.record(s.data(), s.system().bodies);
        if (s.step_count() == 300) resumed.restore(s.state());
        if (s.step_count() > 300) resumed.step();
    });
    BOOST_TEST(run.certified(), to_string(run));
    BOOST_TEST(books.closure() < 1e-11);
    BOOST_TEST(std::abs(books.flows().cell) > 0.0);
    // The pressure is that of the press, in the mean; the packing is dense and hardly moves.
    M<Dim> stress = M<Dim>::Zero();
    constexpr int last = 200;
    const talus::RunSummary rest = sim.run(last * h, [&](const auto& s) {
        std::vector<V<Dim>> forces;
        talus::contact_forces<Dim>(s.data().problem.jacobian, s.data().impulse, h, forces);
        stress += (1.0 / last) * talus::cell_stress<Dim>(s.data().problem.jacobian, forces,
                                                         s.system().bodies, *s.data().cell);
    });
    BOOST_TEST(rest.certified(), to_string(rest));
    BOOST_TEST(sim.system().cell()->velocity_gradient().norm() < 1e-2);
    for (int d = 0; d < Dim; ++d) BOOST_TEST(std::abs(stress(d, d) / pressure + 1.0) < 0.02);
    for (int step = 0; step < last; ++step) resumed.step();
    BOOST_TEST((*sim.system().cell() == *resumed.system().cell()));
    BOOST_TEST((sim.system().bodies.position == resumed.system().bodies.position));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(drives_that_are_none_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(experiment::law<Dim>(0.3), {.h = 1e-3});
    Drive<Dim> drive;
    BOOST_CHECK_THROW(sim.system().drive_cell(drive), talus::input_error);
    drive.mass = 1.0;
    BOOST_CHECK_THROW(sim.system().drive_cell(drive), talus::input_error);
    drive.stress = [](double) { return M<Dim>(-M<Dim>::Identity()); };
    BOOST_TEST(said([&] { sim.system().drive_cell(drive); }) ==
               "number of components of the cell that are driven is 0, but must be at least 1");
    drive.driven[0][0] = true;
    BOOST_TEST(!sim.system().cell_drive());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(Drive<Dim>::pressure(nan, 1.0), talus::input_error);
    BOOST_CHECK_THROW(sim.system().drive_cell(Drive<Dim>::pressure(1.0, 0.0)), talus::input_error);
    drive.stress = [nan](double) { return M<Dim>(nan * M<Dim>::Identity()); };
    sim.system().drive_cell(drive);
    BOOST_TEST(said([&] { sim.step(); }) ==
               "stress drives no cell, but must drive one: call set_cell, or "
               "drive_cell(std::nullopt) to take it away");
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {});
    sim.system().set_cell(Cell<Dim>::box(V<Dim>::Ones()));
    const auto before = sim.state();
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    BOOST_TEST((*sim.state().cell == *before.cell));
    auto damped = Drive<Dim>::pressure(1.0, 1.0);
    damped.damping = 1000.0;
    sim.system().drive_cell(damped);
    BOOST_TEST(said([&] { sim.step(); }) ==
               "damping of the cell times the step size is 1, but must be below 1");
    damped.damping = 999.0;
    sim.system().drive_cell(damped);
    sim.step();
    sim.system().remove_cell();
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    sim.system().drive_cell(std::nullopt);
    sim.step();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_not_periodic_is_not_driven, D, dimensions) {
    constexpr int Dim = D::value;
    typename Cell<Dim>::Directions along{};
    along[0] = true;
    const auto cell = Cell<Dim>::box(V<Dim>::Ones(), along);
    const std::string refusal =
        "driven component (1, 1): part of its second axis along lattice vector 1, not periodic, is "
        "1, but must be 0, as nothing pushes back there";
    const auto is_refusal = [&](const talus::input_error& error) {
        return std::string(error.what()) == refusal;
    };
    talus::Simulation<Dim> sim(experiment::law<Dim>(0.3), {.h = 1e-3});
    sim.system().set_cell(cell);
    BOOST_CHECK_EXCEPTION(sim.system().drive_cell(Drive<Dim>::pressure(1.0, 1.0)),
                          talus::input_error, is_refusal);
    BOOST_TEST(!sim.system().cell_drive());
    auto drive = Drive<Dim>::pressure(1.0, 1.0, along);
    drive.driven[1][0] = true;
    sim.system().drive_cell(drive);
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {});
    sim.step();
    const M<Dim> rate = sim.system().cell()->velocity_gradient();
    BOOST_TEST(rate(0, 0) < 0.0);
    BOOST_TEST(rate(1, 1) == 0.0);
    // The other order, and a state that brings the cell along.
    talus::Simulation<Dim> other(experiment::law<Dim>(0.3), {.h = 1e-3});
    other.system().drive_cell(Drive<Dim>::pressure(1.0, 1.0));
    BOOST_CHECK_EXCEPTION(other.system().set_cell(cell), talus::input_error, is_refusal);
    BOOST_CHECK_EXCEPTION(other.restore(sim.state()), talus::input_error, is_refusal);
    BOOST_TEST(!other.system().cell());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_new_cell_keeps_the_velocities_of_images_at_home, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(experiment::law<Dim>(0.3), {.h = 1e-3});
    V<Dim> x = V<Dim>::Constant(0.5);
    x[0] += 3.0;
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {x, {}});
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {V<Dim>::Constant(0.2), {}});
    M<Dim> rate = M<Dim>::Zero();
    rate(1, 0) = 0.2;
    sim.system().set_cell(Cell<Dim>(M<Dim>(M<Dim>::Identity()), rate));  // the first one
    BOOST_TEST(sim.system().bodies.velocity[0].norm() == 0.0);
    auto twin = sim;
    rate(0, 0) = -0.1;
    sim.system().set_cell(Cell<Dim>(M<Dim>(M<Dim>::Identity()), rate));
    twin.system().set_velocity_gradient(rate);
    BOOST_TEST((sim.system().bodies.velocity[0] + 0.3 * V<Dim>::Unit(0)).norm() < 1e-15);
    BOOST_TEST((sim.system().bodies.velocity == twin.system().bodies.velocity));
    BOOST_TEST((*sim.system().cell() == *twin.system().cell()));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(books_close_under_gravity_away_from_home, D, dimensions) {
    constexpr int Dim = D::value;
    for (const double x : {0.5, 1.5, -7.5})
        for (const bool applied : {false, true}) {
            talus::Simulation<Dim> sim(experiment::law<Dim>(0.3), {.h = 1e-3});
            V<Dim> place = V<Dim>::Constant(0.5);
            place[0] = x;
            sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {place, {}});
            sim.system().set_cell(Cell<Dim>::box(V<Dim>::Ones()));
            sim.system().drive_cell(Drive<Dim>::pressure(10.0, 2.0));
            if (applied)
                sim.system().forces.push_back([](double, const auto& bodies, auto wrenches) {
                    wrenches[0].force = -10.0 * bodies.mass(0) * V<Dim>::Unit(0);
                });
            else
                sim.system().gravity[0] = -10.0;
            talus::EnergyLedger<Dim> books(sim.system().bodies, sim.system().gravity);
            for (int step = 0; step < 100; ++step) {
                sim.step();
                books.record(sim.data(), sim.system().bodies);
            }
            BOOST_TEST(books.closure() < 1e-13);
        }
}

/// A gas of discs, elastic: its pressure is that of motion. The target is the whole.
BOOST_AUTO_TEST_CASE(a_gas_is_under_the_whole_stress) {
    constexpr int Dim = 2;
    constexpr double pressure = 100.0, h = 5e-4, side = 1.2;
    talus::Simulation<Dim> sim(experiment::law<Dim>(0.0, 1.0), {.h = h});
    random_geometry::Generator g(11);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            sim.system().add(talus::Ball<Dim>{0.04}, 1000.0, {0.2 * V<Dim>(i + 0.5, j + 0.5), {}},
                             {1.0 * random_geometry::direction<Dim>(g), {}});
    sim.system().set_cell(Cell<Dim>::box(side * V<Dim>::Ones()));
    double mass = 0.0;
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        mass += sim.system().bodies.mass(i);
    auto drive = Drive<Dim>::pressure(pressure, mass);
    drive.damping = 5.0;
    sim.system().drive_cell(drive);
    for (int step = 0; step < 4000; ++step) sim.step();
    double of_contacts = 0.0, of_motion = 0.0;
    constexpr int count = 12000;
    for (int step = 0; step < count; ++step) {
        const auto& data = sim.step();
        std::vector<V<Dim>> forces;
        talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, h, forces);
        const auto& bodies = sim.system().bodies;
        of_contacts -=
            talus::cell_stress<Dim>(data.problem.jacobian, forces, bodies, *data.cell).trace() /
            (2.0 * count);
        of_motion -=
            talus::kinetic_stress<Dim>(bodies, *sim.system().cell()).trace() / (2.0 * count);
    }
    BOOST_TEST_MESSAGE("pressure of contacts " << of_contacts << ", of motion " << of_motion);
    BOOST_TEST(of_motion > 0.2 * pressure);
    BOOST_TEST(std::abs((of_contacts + of_motion) / pressure - 1.0) < 0.03);
}

/// Largest difference between the velocities of contacts at the end and W r + u_free.
template <int Dim, class Law>
double mismatch(const talus::StepData<Dim, Law>& data) {
    constexpr int rows = talus::law_rows<Law, Dim>;
    const talus::ContactJacobian<Dim>& jacobian = data.problem.jacobian;
    const talus::DelassusProduct<Dim, talus::AngularMatrix<Dim>, rows> w(jacobian,
                                                                         data.problem.inverse_mass);
    std::vector<talus::Vector<rows>> u(data.contact_count());
    w.multiply(data.solution(), u);
    double most = 0.0;
    const auto at = [&](std::size_t c, const auto& twists, const M<Dim>& cell_rate) {
        auto velocity = talus::relative_velocity<Dim, rows>(
            jacobian, c, std::span<const talus::Twist<Dim>>(twists));
        const M<Dim> change = cell_rate - jacobian.cell_rate;
        velocity.template head<Dim>() -= jacobian.frame[c] * (change * jacobian.offset[c]);
        return velocity;
    };
    auto free = data.free;  // as the loads on the cell alone would have it
    const M<Dim> change = data.cell_rate_free - jacobian.cell_rate;
    for (std::size_t i = 0; i < free.size(); ++i) free[i].linear += change * data.from_home[i];
    for (std::size_t c = 0; c < u.size(); ++c)
        most = std::max(
            most,
            (at(c, data.end, data.cell_rate_end) - at(c, free, data.cell_rate_free) - u[c]).norm());
    return most;
}

/// Bodies with friction, rolling too if the law has it, in a skewed cell under pressure and shear.
template <class Types, int Dim>
talus::Simulation<Dim, Types> sheared_press(const typename Types::Law& law, double shear) {
    talus::Simulation<Dim, Types> sim(law, {.h = 1e-3});
    random_geometry::Generator g(11);
    constexpr int side = Dim == 2 ? 4 : 3;
    M<Dim> lattice = 0.21 * side * M<Dim>::Identity();
    lattice(0, 1) = 0.15;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < (Dim == 3 ? side : 1); ++k) {
                V<Dim> s = (1.0 / side) * (i * V<Dim>::Unit(0) + j * V<Dim>::Unit(1));
                s += (Dim == 3 ? k / double{side} : 0.0) * V<Dim>::Unit(Dim - 1);
                for (int d = 0; d < Dim; ++d) s[d] += static_cast<double>(g() % 5) - 2.0;
                const double radius = random_geometry::uniform(g, 0.085, 0.1);
                const V<Dim> velocity = 0.2 * random_geometry::direction<Dim>(g);
                sim.system().add(talus::Ball<Dim>{radius}, 1000.0, {lattice * s, {}},
                                 {velocity, {}});
            }
    sim.system().set_cell(Cell<Dim>(lattice));
    auto drive = Drive<Dim>::pressure(2e3, 20.0);
    drive.driven[0][1] = true;
    drive.stress = [shear](double) {
        M<Dim> stress = -2e3 * M<Dim>::Identity();
        stress(0, 1) = stress(1, 0) = shear;
        return stress;
    };
    drive.damping = 20.0;
    sim.system().drive_cell(drive);
    return sim;
}

/// Runs it; the stress of contacts over the last steps.
template <class Types, int Dim>
M<Dim> shear_press(talus::Simulation<Dim, Types>& sim, int steps) {
    talus::EnergyLedger<Dim> books(sim.system().bodies, sim.system().gravity);
    const Drive<Dim> drive = *sim.system().cell_drive();
    M<Dim> stress = M<Dim>::Zero();
    const int last = steps / 4;
    double scale = 0.0, worst_mismatch = 0.0, worst_change = 0.0;
    for (int step = 0; step < steps; ++step) {
        const Cell<Dim> before = *sim.system().cell();
        const auto& data = sim.step();
        books.record(data, sim.system().bodies);
        const auto& jacobian = data.problem.jacobian;
        worst_mismatch = std::max(worst_mismatch, mismatch<Dim>(data));
        // The cell by its own equation, from impulses and where bodies are.
        M<Dim> expected = before.velocity_gradient();
        const M<Dim> free = data.cell_rate_free;
        M<Dim> moment = M<Dim>::Zero();
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            const V<Dim> f = jacobian.frame[c].transpose() * data.impulse[c];
            const V<Dim> lever = data.contacts.offset[c] + data.from_home[jacobian.b[c]] -
                                 data.from_home[jacobian.a[c]];
            moment -= f * lever.transpose();
        }
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                if (drive.drives(i, j)) expected(i, j) = free(i, j) + moment(i, j) / drive.mass;
        worst_change =
            std::max(worst_change, (expected - sim.system().cell()->velocity_gradient()).norm());
        scale = std::max(scale, moment.norm() / drive.mass);
        BOOST_TEST(sim.system().cell()->velocity_gradient()(1, 0) == 0.0);
        std::vector<V<Dim>> forces;
        talus::contact_forces<Dim>(jacobian, data.impulse, data.h, forces);
        if (step >= steps - last)
            stress += (1.0 / last) *
                      talus::cell_stress<Dim>(jacobian, forces, sim.system().bodies, *data.cell);
    }
    BOOST_TEST(scale > 1e-3);
    BOOST_TEST(worst_change < 1e-12 * (1.0 + scale));
    BOOST_TEST(worst_mismatch < 1e-12);
    BOOST_TEST(books.closure() < 1e-11);
    return stress;
}

template <int Dim>
struct Rolling : talus::SimulationTypes<Dim> {
    using Law = talus::RollingFriction<Dim>;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(shear_and_friction_in_a_skewed_cell, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = sheared_press<talus::SimulationTypes<Dim>, Dim>(experiment::law<Dim>(0.5), 300.0);
    const M<Dim> stress = shear_press<talus::SimulationTypes<Dim>, Dim>(sim, 1600);
    BOOST_TEST(sim.system().cell()->lattice()(0, 1) != 0.15);
    for (int d = 0; d < Dim; ++d) BOOST_TEST(std::abs(stress(d, d) / 2e3 + 1.0) < 0.05);
    BOOST_TEST(std::abs(stress(0, 1) / 300.0 - 1.0) < 0.05);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rolling_friction_in_a_skewed_cell, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = sheared_press<Rolling<Dim>, Dim>({.mu = 0.5, .mu_r = 0.1}, 0.0);
    shear_press<Rolling<Dim>, Dim>(sim, 400);
}

/// Two bars that move along the cell alone, or not at all, and touch across it.
BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_that_do_not_move_push_the_cell, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim, experiment::Sweeping<Dim>> sim(experiment::law<Dim>(0.0), {.h = 1e-3});
    typename Cell<Dim>::Directions along{};
    along[0] = true;
    for (const double x : {0.1, 0.3}) {
        const auto i = static_cast<std::size_t>(
            sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {x * V<Dim>::Unit(0), {}}));
        sim.system().bodies.locked[i] = talus::LockedAxes<Dim>::all();
    }
    sim.system().set_cell(Cell<Dim>::box(0.401 * V<Dim>::Ones(), along));
    sim.system().drive_cell(Drive<Dim>::pressure(1e3, 1.0, along));
    for (int step = 0; step < 200; ++step) sim.step();
    BOOST_TEST(sim.data().contact_count() == 1u);
    BOOST_TEST(std::abs(sim.system().cell()->velocity_gradient()(0, 0)) < 1e-9);
    BOOST_TEST(sim.system().cell()->lattice()(0, 0) > 0.39);
}

BOOST_AUTO_TEST_SUITE_END()
