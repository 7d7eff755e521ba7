// SPDX-License-Identifier: BSL-1.0
// Steps in a periodic cell: against scenes in which every image is a body of its own, and books of
// energy and momentum.
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>
#include <talus/stepping/step_queries.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"
#include "common/said.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_periodic)

using random_geometry::uniform;
template <int Dim>
using V = talus::Vector<Dim>;
template <int Dim>
using M = talus::Matrix<Dim>;
template <int Dim>
using Cell = talus::PeriodicCell<Dim>;
template <int Dim>
using Sim = talus::Simulation<Dim, experiment::Sweeping<Dim>>;

template <int Dim>
Sim<Dim> empty_scene(const talus::DefaultLaw<Dim>& law, double h,
                     talus::Scheme scheme = talus::Scheme::midpoint) {
    return Sim<Dim>(
        law, {.h = h, .step = {.scheme = scheme}},
        typename experiment::Sweeping<Dim>::Solver({.max_sweeps = 10000, .tolerance = 1e-15}));
}
template <int Dim>
M<Dim> simple_shear(double rate) {
    M<Dim> shear = M<Dim>::Zero();
    shear(0, Dim - 1) = rate;
    return shear;
}

template <int Dim>
struct Grain {
    V<Dim> x, v;
    talus::AngularVector<Dim> w;
};
/// Two balls that hit each other across two faces of a unit cell.
template <int Dim>
std::vector<Grain<Dim>> two_grains() {
    V<Dim> up = V<Dim>::Unit(Dim - 1), along = V<Dim>::Unit(0);
    const auto spin = talus::AngularVector<Dim>::Constant(3.0);
    return {{0.9 * along + 0.85 * up, 0.6 * along + 0.5 * up, spin},
            {0.2 * along + 0.1 * up, -0.5 * along - 0.2 * up, -0.5 * spin}};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_cell_is_a_scene_with_all_its_images, D, dimensions) {
    // Simple shear moves images on straight lines, as bodies by themselves move.
    constexpr int Dim = D::value;
    for (const auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating})
        for (const double rate : {0.0, 0.7}) {
            const bool anticipates = scheme == talus::Scheme::gap_anticipating;
            const auto law = experiment::law<Dim>(0.3, anticipates ? 0.0 : 0.5);
            auto cell_scene = empty_scene<Dim>(law, 2e-3, scheme);
            auto open_scene = empty_scene<Dim>(law, 2e-3, scheme);
            const Cell<Dim> cell(M<Dim>(M<Dim>::Identity()), simple_shear<Dim>(rate));
            const int third = Dim == 3 ? 1 : 0;
            std::vector<talus::BodyIndex> middle;
            for (const auto& grain : two_grains<Dim>()) {
                cell_scene.system().add(talus::Ball<Dim>{0.15}, 1000.0, {grain.x, {}},
                                        {grain.v, grain.w});
                for (int i = -1; i <= 1; ++i)
                    for (int j = -1; j <= 1; ++j)
                        for (int k = -third; k <= third; ++k) {
                            talus::ImageShift image;
                            image.n = {i, j, k};
                            const V<Dim> offset = cell.offset(image);
                            const auto body = open_scene.system().add(
                                talus::Ball<Dim>{0.15}, 1000.0, {grain.x + offset, {}},
                                {grain.v + cell.velocity_at(offset), grain.w});
                            if (image.is_zero()) middle.push_back(body);
                        }
            }
            cell_scene.system().set_cell(cell);
            std::size_t contacts = 0;
            for (int step = 0; step < 300; ++step) {
                cell_scene.step();
                open_scene.step();
                for (std::size_t i = 0; i < 2; ++i) {
                    const auto& one = cell_scene.system().bodies;
                    const auto& other = open_scene.system().bodies;
                    BOOST_TEST((one.position[i] - other.position[middle[i]]).norm() < 1e-12);
                    BOOST_TEST((one.velocity[i] - other.velocity[middle[i]]).norm() < 1e-11);
                    BOOST_TEST((one.spin[i] - other.spin[middle[i]]).norm() < 1e-11);
                }
                for (std::size_t c = 0; c < cell_scene.data().contact_count(); ++c)
                    contacts += cell_scene.data().impulse[c].norm() > 0.0 ? 1u : 0u;
                // Beyond this copies at the rim would be missed.
                if (contacts > 0 && step > 200) break;
            }
            BOOST_TEST(contacts > 0u);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_ball_rolls_across_the_boundary_as_in_open_space, D, dimensions) {
    constexpr int Dim = D::value;
    const V<Dim> up = V<Dim>::Unit(Dim - 1), along = V<Dim>::Unit(0);
    auto scene = [&](bool in_cell) {
        auto sim = empty_scene<Dim>(experiment::law<Dim>(0.3), 2e-3);
        sim.system().gravity = -9.81 * up;
        sim.system().add_obstacle(talus::HalfSpace<Dim>{up, 0.0});
        sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {0.45 * along + 0.1 * up, {}},
                         {1.3 * along, {}});
        typename Cell<Dim>::Directions periodic{};
        periodic[0] = true;
        if (in_cell) sim.system().set_cell(Cell<Dim>::box(0.5 * V<Dim>::Ones(), periodic));
        return sim;
    };
    auto open = scene(false), periodic = scene(true);
    for (int step = 0; step < 2000; ++step) {
        open.step();
        periodic.step();
    }
    // It touches nobody but the floor: the same bits.
    const auto &x = open.system().bodies, &y = periodic.system().bodies;
    BOOST_TEST(x.position[1][0] > 2.0);
    BOOST_TEST((x.position[1] == y.position[1]));
    BOOST_TEST((x.velocity[1] == y.velocity[1]));
    BOOST_TEST((x.spin[1] == y.spin[1]));
}

/// A gas of balls and boxes in a cell that is sheared and grows thinner.
template <int Dim>
Sim<Dim> sheared_gas(talus::Scheme scheme, bool backwards = false) {
    const bool anticipates = scheme == talus::Scheme::gap_anticipating;
    auto sim = empty_scene<Dim>(experiment::law<Dim>(0.4, anticipates ? 0.0 : 0.6), 1e-3, scheme);
    random_geometry::Generator g(3);
    M<Dim> lattice = M<Dim>::Identity(), rate = simple_shear<Dim>(1.0);
    lattice(0, 1) = 0.3;
    rate(Dim - 1, Dim - 1) = -0.2;
    const Cell<Dim> cell(lattice, rate);
    constexpr int side = 3;
    struct One {
        talus::Pose<Dim> pose;
        talus::Twist<Dim> twist;
        bool box;
    };
    std::vector<One> all;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < (Dim == 3 ? side : 1); ++k) {
                // Also some cells away.
                V<Dim> s = (1.0 / side) * (i * V<Dim>::Unit(0) + j * V<Dim>::Unit(1));
                s += (Dim == 3 ? k / double{side} : 0.0) * V<Dim>::Unit(Dim - 1);
                for (int d = 0; d < Dim; ++d) s[d] += static_cast<double>(g() % 3) - 1.0;
                const V<Dim> x = lattice * s;
                all.push_back({{x, random_geometry::pose<Dim>(g, 1.0).rotation},
                               {cell.velocity_at(x) + 0.5 * random_geometry::direction<Dim>(g), {}},
                               g() % 3 == 0});
            }
    if (backwards) std::reverse(all.begin(), all.end());
    for (const One& one : all)
        if (one.box)
            sim.system().add(talus::Box<Dim>(0.07 * V<Dim>::Ones()), 1000.0, one.pose, one.twist);
        else
            sim.system().add(talus::Ball<Dim>{0.12}, 1000.0, one.pose, one.twist);
    sim.system().set_cell(cell);
    return sim;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(books_close_and_contacts_keep_momentum, D, dimensions) {
    constexpr int Dim = D::value;
    for (const auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        auto sim = sheared_gas<Dim>(scheme);
        talus::EnergyLedger<Dim> books(sim.system().bodies, sim.system().gravity);
        std::size_t pushes = 0;
        for (int step = 0; step < 1000; ++step) {
            const double work_before = books.flows().cell;
            const talus::Bodies<Dim> begin = sim.system().bodies;
            const Cell<Dim> before = *sim.system().cell();
            const auto& data = sim.step();
            books.record(data, sim.system().bodies);
            for (const auto& r : data.impulse) pushes += r.norm() > 0.0 ? 1u : 0u;
            double momentum_scale = 0.0;
            for (std::size_t i = 0; i < begin.count(); ++i)
                momentum_scale += begin.mass(i) * begin.velocity[i].norm();
            // Levers of what is foreseen to slide end where it will meet.
            if (scheme == talus::Scheme::gap_anticipating) continue;
            // Contacts leave momentum as it is; away from home the cell carries bodies along.
            V<Dim> gained = V<Dim>::Zero();
            for (std::size_t i = 0; i < begin.count(); ++i)
                gained += begin.mass(i) * (data.end[i].linear - data.begin[i].linear);
            BOOST_TEST(gained.norm() < 1e-14 * momentum_scale);
            // V sigma : L dt, what the bodies' accelerations take of it, and what carries them.
            std::vector<V<Dim>> forces;
            talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces);
            const M<Dim> stress = talus::cell_stress<Dim>(data.problem.jacobian, forces,
                                                          sim.system().bodies, *data.cell);
            double work =
                data.h * data.cell->volume() * (stress * data.cell->velocity_gradient()).trace();
            const auto& bodies = sim.system().bodies;
            for (std::size_t i = 0; i < begin.count(); ++i) {
                const V<Dim> s = data.from_home[i];
                const V<Dim> own = data.begin[i].linear - data.cell->velocity_at(s);
                const V<Dim> mid =
                    begin.position[i] + 0.5 * data.h * own + (s - before.offset(data.home[i]));
                work +=
                    begin.mass(i) *
                    (data.end[i].linear - data.begin[i].linear).dot(data.cell->velocity_at(mid));
                work += 0.5 * begin.mass(i) *
                        (bodies.velocity[i].squaredNorm() - data.end[i].linear.squaredNorm() +
                         data.begin[i].linear.squaredNorm() - begin.velocity[i].squaredNorm());
            }
            BOOST_TEST(std::abs(books.flows().cell - work_before - work) <
                       1e-11 * books.kinetic_start());
        }
        BOOST_TEST(pushes > 10u);
        BOOST_TEST(std::abs(books.flows().cell) > 1e-3 * books.kinetic_start());
        BOOST_TEST(books.closure() < 1e-12);
        const auto again = talus::from_record<talus::EnergyLedger<Dim>>(talus::record_of(books));
        BOOST_TEST(again.flows().cell == books.flows().cell);
        talus::NumberRecord older = talus::record_of(books);
        older.reals.pop_back();
        BOOST_TEST(talus::from_record<talus::EnergyLedger<Dim>>(older).flows().cell == 0.0);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(candidates_and_restarts_do_not_show, D, dimensions) {
    constexpr int Dim = D::value;
    for (const auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        auto one = sheared_gas<Dim>(scheme);
        auto params = one.params();
        params.step.skin = 1.5;
        Sim<Dim> wide(one.system(), params, one.solver());
        auto resumed = one;
        for (int step = 0; step < 400; ++step) {
            one.step();
            wide.step();
            if (step == 200) {
                Sim<Dim> other = sheared_gas<Dim>(scheme);
                other.restore(resumed.state());
                resumed = std::move(other);
            }
            resumed.step();
        }
        const auto& bodies = one.system().bodies;
        BOOST_TEST((*one.system().cell() == *resumed.system().cell()));
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            BOOST_TEST((bodies.position[i] == wide.system().bodies.position[i]));
            BOOST_TEST((bodies.position[i] == resumed.system().bodies.position[i]));
            BOOST_TEST((bodies.velocity[i] == resumed.system().bodies.velocity[i]));
            BOOST_TEST((bodies.spin[i] == resumed.system().bodies.spin[i]));
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_with_images_are_found_again, D, dimensions) {
    // Two balls in a cell that both touch twice: as neighbours and around the cell.
    constexpr int Dim = D::value;
    auto sim = empty_scene<Dim>(experiment::law<Dim>(0.5), 1e-3);
    const V<Dim> along = V<Dim>::Unit(0);
    for (const double x : {0.0, 0.2})
        sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {x * along, {}});
    V<Dim> sides = V<Dim>::Ones();
    sides[0] = 0.4;
    sim.system().set_cell(Cell<Dim>::box(sides));
    sim.step();
    BOOST_TEST(sim.data().contact_count() == 2u);
    BOOST_TEST(sim.data().recalled == 0u);
    BOOST_TEST((sim.data().contacts.key[0] < sim.data().contacts.key[1]));
    BOOST_TEST(!sim.data().contacts.key[0].image.is_zero());
    sim.step();
    BOOST_TEST(sim.data().recalled == 2u);
    BOOST_TEST(talus::contacts_between(sim.data(), 0, 1).size() == 2u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_does_not_fit_is_refused_and_changes_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = empty_scene<Dim>(experiment::law<Dim>(0.5), 1e-3);
    auto& system = sim.system();
    const V<Dim> up = V<Dim>::Unit(Dim - 1);
    const auto cell = Cell<Dim>::box(V<Dim>::Ones());
    BOOST_TEST(said([&] { system.set_velocity_gradient(M<Dim>::Identity()); }) ==
               "velocity gradient is of no cell, but must be of one: call set_cell");
    system.add(talus::Ball<Dim>{0.1}, 1000.0, {});
    system.add(talus::Ball<Dim>{0.5}, 1000.0, {3.0 * up, {}});
    BOOST_TEST(said([&] { system.set_cell(cell); }) ==
               "shortest lattice vector of the cell is 1, but must be above the width of body 1, "
               "1, which would meet its own image");
    BOOST_TEST(!system.cell());
    system.set_shape(1, talus::Ball<Dim>{0.45});
    system.set_cell(cell);
    system.add_obstacle(talus::HalfSpace<Dim>{up, -9.0});
    BOOST_TEST(said([&] { sim.step(); }) ==
               "part of lattice vector " + std::to_string(Dim - 1) +
                   " across the wall, body 2, is 1, but must be 0, as walls have no images");
    system.remove(system.bodies.id[2]);
    // The cell shrinks until the ball no longer fits: the step that fails leaves all as it was.
    system.set_velocity_gradient(-5.0 * M<Dim>::Identity());
    std::string found;
    int steps = 0;
    talus::RunState<Dim, talus::AnyShape<Dim>> before;
    for (; steps < 100 && found.empty(); ++steps) {
        before = sim.state();
        found = said([&] { sim.step(); });
    }
    BOOST_TEST(steps == 22);  // exp(-5 * 0.0215) < 0.9
    BOOST_TEST(found.find("above the width of body 1, 0.9") != std::string::npos, found);
    BOOST_TEST((*sim.state().cell == *before.cell));
    BOOST_TEST((sim.state().bodies.position[1] == before.bodies.position[1]));
    system.set_velocity_gradient(600.0 * M<Dim>::Identity());
    BOOST_TEST(said([&] { sim.step(); }).starts_with("strain of the cell in half a step is"));
    M<Dim> bad = M<Dim>::Identity();
    bad(0, 0) = std::numeric_limits<double>::infinity();
    BOOST_CHECK_THROW(system.set_velocity_gradient(bad), talus::input_error);
    system.remove_cell();
    sim.step();
    BOOST_TEST(!sim.data().cell);
}

BOOST_AUTO_TEST_SUITE_END()
