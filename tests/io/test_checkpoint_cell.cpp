// SPDX-License-Identifier: BSL-1.0
// A periodic cell, and the images that touch, through a file.
#include <talus/geometry/ball.hpp>
#include <talus/io/checkpoint/checkpoint.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <cstddef>

#include "common/dimensions.hpp"
#include "temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_checkpoint_cell)

template <int Dim>
talus::Simulation<Dim> press() {
    talus::Simulation<Dim> sim(talus::DefaultLaw<Dim>{{0.3}}, {.h = 1e-3});
    for (int i = 0; i < 6; ++i) {
        talus::Vector<Dim> x = 0.21 * (i % 3) * talus::Vector<Dim>::Unit(0);
        x += (0.22 * (i / 3) + 0.64 * (i % 2)) * talus::Vector<Dim>::Unit(1);
        sim.system().add(talus::Ball<Dim>{0.1}, 1000.0, {x, {}});
    }
    talus::Vector<Dim> sides = talus::Vector<Dim>::Constant(0.64);
    sim.system().set_cell(talus::PeriodicCell<Dim>::box(sides));
    // In space there is nobody above the others to hold the cell open.
    auto drive = talus::CellDrive<Dim>::pressure(1e4, 5.0);
    if (Dim == 3) drive.driven[Dim - 1][Dim - 1] = false;
    sim.system().drive_cell(drive);
    return sim;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_run_in_a_cell_goes_on_with_the_same_bits, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("checkpoint-cell");
    const auto file = folder / "cell.h5";
    auto sim = press<Dim>();
    for (int step = 0; step < 150; ++step) sim.step();
    talus::save_checkpoint(file, sim, "press");
    // Into a simulation without a cell too: the file has it.
    auto next = press<Dim>();
    next.system().remove_cell();
    talus::load_checkpoint(file, next, "press");
    BOOST_TEST((*next.system().cell() == *sim.system().cell()));
    std::size_t images = 0;
    for (int step = 0; step < 100; ++step) {
        sim.step();
        next.step();
        BOOST_TEST(next.data().recalled == sim.data().recalled);
        for (const auto& key : sim.data().contacts.key) images += key.image.is_zero() ? 0u : 1u;
    }
    BOOST_TEST(images > 0u);
    BOOST_TEST((next.system().bodies.position == sim.system().bodies.position));
    BOOST_TEST((next.system().bodies.velocity == sim.system().bodies.velocity));
    BOOST_TEST((*next.system().cell() == *sim.system().cell()));
    // One without a cell takes it away again.
    auto open = press<Dim>();
    open.system().remove_cell();
    talus::save_checkpoint(file, open, "press");
    talus::load_checkpoint(file, next, "press");
    BOOST_TEST(!next.system().cell());
}

BOOST_AUTO_TEST_SUITE_END()
