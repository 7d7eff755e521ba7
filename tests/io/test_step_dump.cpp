// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/io/step_dump.hpp>
#include <talus/problem/residual.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include "common/dimensions.hpp"
#include "io/temporary_folder.hpp"

using talus::Vector;

BOOST_AUTO_TEST_SUITE(io_step_dump)

BOOST_AUTO_TEST_CASE_TEMPLATE(a_dumped_step_is_as_good_as_the_simulation_said, D, dimensions) {
    constexpr int Dim = D::value;
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    talus::Simulation<Dim> sim({{0.3}, 0.5, 0.0}, {.h = 1e-2});
    // Ends far above rounding, so that the residual has digits to compare.
    sim.solver().params.tolerance = 1e-3;
    sim.system().gravity = -9.81 * up;
    sim.system().add_obstacle(talus::HalfSpace<Dim>(up, 0.0));
    sim.system().add_obstacle(talus::HalfSpace<Dim>((up + Vector<Dim>::Unit(0)).normalized(), 0.0));
    for (int k = 0; k < 5; ++k)
        sim.system().add(talus::Ball<Dim>{0.1}, 1000.0,
                         {0.05 * k * Vector<Dim>::Unit(0) + (0.15 + 0.2 * k) * up, {}});

    const TemporaryFolder folder("dump");
    const talus::StepDump dump(folder / "", "pile");
    std::size_t most_contacts = 0;
    double digits_lost = 0.0;
    const auto run = sim.run(0.5, [&](const auto& s) {
        dump(s);
        const auto content = talus::read_problem<Dim>(dump.path(s.step_count()));
        BOOST_REQUIRE(content.solution.has_value());
        BOOST_REQUIRE(content.global->contact_count() == s.data().contact_count());
        if (content.global->contact_count() == 0) return;
        most_contacts = std::max(most_contacts, content.global->contact_count());
        auto local = talus::assembled(content);
        const auto& r = content.solution->impulse;
        local.delassus.start(r);
        talus::ResidualMeasure<Dim> measure;
        measure.template prepare<talus::DelassusSparse<Dim>, talus::Coulomb<Dim>>(
            local.delassus, local.free_velocity, local.laws);
        const auto residual = measure.template evaluate<talus::Coulomb<Dim>>(
            local.free_velocity, local.laws, r,
            [&](std::size_t i) { return local.delassus.velocity(i); });
        digits_lost = std::max(digits_lost, std::abs(residual.relative - s.data().report.residual));
    });
    BOOST_TEST(run.missed == 0);
    const double rounding = 1e-13;  // of a relative residual, in a pile of five
    BOOST_TEST(digits_lost < rounding);
    BOOST_TEST(most_contacts > 3u);
    BOOST_TEST(folder.file_count() == 50);
    BOOST_TEST(dump.path(7).filename() == "pile-000007.hdf5");
    BOOST_TEST(talus::read_problem<Dim>(dump.path(50)).info.title == "pile, step 50");
}

BOOST_AUTO_TEST_SUITE_END()
