// SPDX-License-Identifier: BSL-1.0
// A steady step allocates nothing. Counts every operator new of this program.
#include <talus/geometry/box.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/allocation_counter.hpp"
#include "common/dimensions.hpp"
#include "heap.hpp"

BOOST_AUTO_TEST_SUITE(stepping_allocations)

using namespace experiment;

/// Runs for so long, and counts the steps after `start` that allocate without having more contacts
/// than any before: than any other one of those, as a simulation has two sets of data that take
/// turns.
template <class Sim>
std::size_t allocating_steps(Sim& sim, double duration, double start) {
    std::array<std::size_t, 2> most{};
    std::size_t allocating = 0;
    long before = allocation_count;
    const auto run = sim.run(duration, [&](const auto& s) {
        const std::size_t count = s.data().contact_count();
        std::size_t& most_here = most[static_cast<std::size_t>(s.step_count() % 2)];
        allocating += s.time() > start && count <= most_here && allocation_count != before;
        most_here = std::max(most_here, count);
        before = allocation_count;
    });
    BOOST_TEST(run.steps > 0);
    return allocating;
}

BOOST_AUTO_TEST_CASE(the_counter_counts) {
    const long before = allocation_count;
    // Not `delete new int`, which a compiler may leave out.
    ::operator delete(::operator new(sizeof(int)));
    BOOST_CHECK_GT(allocation_count, before);
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("long"))
BOOST_AUTO_TEST_CASE_TEMPLATE(a_steady_step_allocates_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    for (auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        talus::SimulationParams params;
        params.step.scheme = scheme;
        auto sim = heap<Dim, Corrected<Dim>>(Dim == 2 ? 6 : 3, 5, law<Dim>(0.4), 2e-3, params);
        sim.gap_correction().params.fraction = 0.1;
        BOOST_CHECK_EQUAL(allocating_steps(sim, 2.2, 1.0), 0u);
        BOOST_CHECK_GT(sim.data().contact_count(), 20u);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sliding_over_seams_allocates_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    talus::SimulationParams params{.h = 1e-3};
    params.step.scheme = talus::Scheme::gap_anticipating;
    params.step.contact_tolerance = touching;
    talus::Simulation<Dim> sim(law<Dim>(0.1), params);
    sim.system().gravity = -g * up<Dim>();
    const talus::Box<Dim> cube(V<Dim>::Constant(0.05));
    for (int i = 0; i < 20; ++i)
        sim.system().add_obstacle(cube, talus::Pose<Dim>{in_plane<Dim>(0.1 * i, -0.05), {}});
    sim.system().add(cube, 1000.0, {in_plane<Dim>(0.0131, 0.05), {}}, {in_plane<Dim>(2.0, 0.0)});
    BOOST_CHECK_EQUAL(allocating_steps(sim, 0.6, 0.3), 0u);
}

BOOST_AUTO_TEST_SUITE_END()
