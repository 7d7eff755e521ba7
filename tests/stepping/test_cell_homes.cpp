// SPDX-License-Identifier: BSL-1.0
// It makes no difference which image of a body in a periodic cell is the body, however the cell
// deforms: against the same scene with its bodies at home.
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_cell_homes)

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
talus::ImageShift random_image(random_geometry::Generator& g,
                               const typename Cell<Dim>::Directions& periodic) {
    talus::ImageShift image;
    for (std::size_t k = 0; k < periodic.size(); ++k)
        if (periodic[k]) image.n[k] = static_cast<std::int32_t>(g() % 11) - 5;
    return image;
}

/// As its images: at x + H n with v + L H n.
template <int Dim>
void move_to_images(Sim<Dim>& sim, std::vector<talus::ImageShift>& images, unsigned seed) {
    random_geometry::Generator g(seed);
    const Cell<Dim> cell = *sim.system().cell();
    auto& bodies = sim.system().bodies;
    images.assign(bodies.count(), {});
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (bodies.is_obstacle(i)) continue;
        images[i] = random_image<Dim>(g, cell.periodic());
        bodies.position[i] += cell.offset(images[i]);
        bodies.velocity[i] += cell.velocity_at(cell.offset(images[i]));
    }
}

/// Runs both, and the books of the moved one; the largest difference of what is at home.
template <int Dim>
double run_and_compare(Sim<Dim>& home, Sim<Dim>& moved,
                       const std::vector<talus::ImageShift>& images, int steps,
                       std::size_t* pushes = nullptr) {
    talus::EnergyLedger<Dim> books(moved.system().bodies, moved.system().gravity);
    double worst = 0.0;
    for (int step = 0; step < steps; ++step) {
        home.step();
        const auto& data = moved.step();
        books.record(data, moved.system().bodies);
        for (const auto& r : data.impulse)
            if (pushes != nullptr) *pushes += r.norm() > 0.0 ? 1u : 0u;
        const Cell<Dim>&cell = *home.system().cell(), &other = *moved.system().cell();
        worst = std::max(worst, (cell.lattice() - other.lattice()).norm());
        worst = std::max(worst, (cell.velocity_gradient() - other.velocity_gradient()).norm());
        const auto &x = home.system().bodies, &y = moved.system().bodies;
        for (std::size_t i = 0; i < x.count(); ++i) {
            const V<Dim> s = other.offset(images[i]);
            worst = std::max(worst, (x.position[i] - (y.position[i] - s)).norm());
            worst =
                std::max(worst, (x.velocity[i] - (y.velocity[i] - other.velocity_at(s))).norm());
            worst = std::max(worst, (x.spin[i] - y.spin[i]).norm());
        }
    }
    BOOST_TEST(books.closure() < 1e-11);
    return worst;
}

template <int Dim>
Sim<Dim> scene(talus::Scheme scheme, double restitution) {
    return Sim<Dim>(
        experiment::law<Dim>(0.4, scheme == talus::Scheme::midpoint ? restitution : 0.0),
        {.h = 2e-3, .step = {.scheme = scheme}},
        typename experiment::Sweeping<Dim>::Solver({.max_sweeps = 100000, .tolerance = 1e-15}));
}
template <int Dim>
std::vector<M<Dim>> rates() {
    M<Dim> general;
    random_geometry::Generator g(2);
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) general(i, j) = uniform(g, -0.5, 0.5);
    return {-0.3 * M<Dim>::Identity(), 0.2 * M<Dim>::Identity(), general};
}
const auto schemes = {talus::Scheme::midpoint, talus::Scheme::gap_anticipating};

BOOST_AUTO_TEST_CASE_TEMPLATE(one_ball_is_where_its_home_image_is, D, dimensions) {
    constexpr int Dim = D::value;
    for (const int n : {0, 1, 5}) {
        auto sim = scene<Dim>(talus::Scheme::midpoint, 0.0);
        const Cell<Dim> cell(M<Dim>(M<Dim>::Identity()), -0.1 * M<Dim>::Identity());
        talus::ImageShift image;
        image.n[0] = n;
        const V<Dim> home = 0.2 * V<Dim>::Unit(0) + 0.5 * V<Dim>::Unit(1);
        const V<Dim> s = cell.offset(image);
        sim.system().add(talus::Ball<Dim>{0.05}, 1000.0, {home + s, {}}, {cell.velocity_at(s), {}});
        sim.system().set_cell(cell);
        for (int step = 0; step < 1000; ++step) sim.step();
        const V<Dim> x = sim.system().bodies.position[0] - sim.system().cell()->offset(image);
        BOOST_TEST((x - home).norm() < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_crowd_moves_as_its_images, D, dimensions) {
    constexpr int Dim = D::value;
    for (const auto scheme : schemes)
        for (const M<Dim>& rate : rates<Dim>()) {
            auto home = scene<Dim>(scheme, 0.5);
            random_geometry::Generator g(4);
            M<Dim> lattice = M<Dim>::Identity();
            lattice(0, 1) = 0.3;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) {
                    V<Dim> s = V<Dim>::Constant(0.5);
                    s[0] = (i + 0.5) / 3.0;
                    s[Dim - 1] = (j + 0.5) / 3.0;
                    const V<Dim> v = 2.5 * random_geometry::direction<Dim>(g);
                    const talus::Pose<Dim> pose{lattice * s,
                                                random_geometry::pose<Dim>(g, 1.0).rotation};
                    if (j == 1)
                        home.system().add(talus::Box<Dim>(0.08 * V<Dim>::Ones()), 1000.0, pose,
                                          {v, {}});
                    else
                        home.system().add(talus::Ball<Dim>{0.13}, 1000.0, pose, {v, {}});
                }
            home.system().set_cell(Cell<Dim>(lattice, rate));
            auto moved = home;
            std::vector<talus::ImageShift> images;
            move_to_images<Dim>(moved, images, 8);
            std::size_t pushes = 0;
            const double worst = run_and_compare<Dim>(home, moved, images, 150, &pushes);
            BOOST_TEST(worst < 1e-9);
            BOOST_TEST(pushes > 5u);
        }
}

/// A box slides, a ball rolls on a floor with friction, across the cell; a second wall holds a
/// third body that leans on it.
BOOST_AUTO_TEST_CASE_TEMPLATE(walls_go_along, D, dimensions) {
    constexpr int Dim = D::value;
    const V<Dim> up = V<Dim>::Unit(Dim - 1);
    for (const auto& [scheme, driven] :
         {std::pair{talus::Scheme::midpoint, false}, std::pair{talus::Scheme::midpoint, true},
          std::pair{talus::Scheme::gap_anticipating, false},
          std::pair{talus::Scheme::gap_anticipating, true}}) {
        M<Dim> rate = M<Dim>::Zero();
        rate(0, 0) = -0.1;
        if (Dim == 3) {
            rate(0, 1) = 0.2;
            rate(1, 0) = 0.1;
        }
        rate(0, Dim - 1) += 0.15;
        typename Cell<Dim>::Directions periodic{};
        periodic[0] = true;
        periodic[Dim - 2] = true;
        auto home = scene<Dim>(scheme, 0.0);
        home.system().gravity = -9.81 * up;
        home.system().add(talus::Box<Dim>(0.05 * V<Dim>::Ones()), 1000.0,
                          {0.3 * V<Dim>::Ones() - 0.25 * up, {}}, {});
        home.system().add_obstacle(talus::HalfSpace<Dim>{up, 0.0});
        home.system().add(talus::Ball<Dim>{0.05}, 1000.0, {0.5 * V<Dim>::Ones() - 0.45 * up, {}},
                          {0.4 * V<Dim>::Unit(0), {}});
        home.system().add(talus::Ball<Dim>{0.05}, 1000.0, {0.8 * V<Dim>::Ones() - 0.6 * up, {}},
                          {-0.3 * V<Dim>::Unit(0), {}});
        home.system().add_obstacle(talus::HalfSpace<Dim>{-up, -0.28});
        const Cell<Dim> cell(M<Dim>(M<Dim>::Identity()), rate, periodic);
        home.system().set_cell(cell);
        if (driven) home.system().drive_cell(talus::CellDrive<Dim>::pressure(20.0, 50.0, {true}));
        auto moved = home;
        std::vector<talus::ImageShift> images;
        move_to_images<Dim>(moved, images, 9);
        std::size_t pushes = 0;
        const double worst = run_and_compare<Dim>(home, moved, images, 500, &pushes);
        BOOST_TEST(worst < 1e-10);
        BOOST_TEST(pushes > 500u);
        // At rest on the floor at home.
        BOOST_TEST(std::abs(home.system().bodies.position[0][0] - 0.3) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_driven_cell_does_not_see_which_image_it_is, D, dimensions) {
    constexpr int Dim = D::value;
    for (const auto scheme : schemes) {
        auto home = scene<Dim>(scheme, 0.3);
        random_geometry::Generator g(5);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                V<Dim> x = V<Dim>::Constant(0.5);
                x[0] = (i + 0.5) / 3.0;
                x[Dim - 1] = (j + 0.5) / 3.0;
                home.system().add(talus::Ball<Dim>{0.14}, 1000.0, {x, {}},
                                  {0.5 * random_geometry::direction<Dim>(g), {}});
            }
        M<Dim> rate = M<Dim>::Zero();
        rate(0, 1) = 0.3;
        rate(1, 0) = -0.1;
        home.system().set_cell(Cell<Dim>(M<Dim>(M<Dim>::Identity()), rate));
        auto drive = talus::CellDrive<Dim>::pressure(1e3, 20.0);
        drive.driven[0][1] = true;
        home.system().drive_cell(drive);
        auto moved = home;
        std::vector<talus::ImageShift> images;
        move_to_images<Dim>(moved, images, 10);
        std::size_t pushes = 0;
        const double worst = run_and_compare<Dim>(home, moved, images, 120, &pushes);
        BOOST_TEST(worst < 1e-8);
        BOOST_TEST(pushes > 20u);
        BOOST_TEST(home.system().cell()->velocity_gradient().norm() > 0.1);
    }
}

BOOST_AUTO_TEST_SUITE_END()
