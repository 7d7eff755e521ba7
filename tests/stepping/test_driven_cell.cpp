// SPDX-License-Identifier: BSL-1.0
// Cells driven by a stress, against closed forms: crystals at rest, free fall, a press.
#include <talus/geometry/ball.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/momentum.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"
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
    BOOST_TEST(!sim.system().cell_drive());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(Drive<Dim>::pressure(nan, 1.0), talus::input_error);
    BOOST_CHECK_THROW(sim.system().drive_cell(Drive<Dim>::pressure(1.0, 0.0)), talus::input_error);
    drive.stress = [nan](double) { return M<Dim>(nan * M<Dim>::Identity()); };
    sim.system().drive_cell(drive);
    sim.step();  // without a cell there is nothing to drive
    sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {});
    sim.system().set_cell(Cell<Dim>::box(V<Dim>::Ones()));
    const auto before = sim.state();
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    BOOST_TEST((*sim.state().cell == *before.cell));
}

BOOST_AUTO_TEST_SUITE_END()
