// SPDX-License-Identifier: BSL-1.0
// A steady step allocates nothing. Counts every operator new of this program.
#include <boost/test/unit_test.hpp>

#include "common/allocation_counter.hpp"
#include "common/dimensions.hpp"
#include "heap.hpp"

BOOST_AUTO_TEST_SUITE(stepping_allocations)

using namespace experiment;

BOOST_AUTO_TEST_CASE(the_counter_counts) {
    const long before = allocation_count;
    delete new int(3);
    BOOST_CHECK_GT(allocation_count, before);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_steady_step_allocates_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    for (auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        talus::SimulationParams params;
        params.step.scheme = scheme;
        auto sim = heap<Dim, Corrected<Dim>>(Dim == 2 ? 6 : 3, 5, law<Dim>(0.4), 2e-3, params);
        sim.gap_correction().params.fraction = 0.1;
        BOOST_TEST(sim.run(2.0).steps > 0);
        const long before = allocation_count;
        BOOST_TEST(sim.run(0.1).missed == 0);
        BOOST_CHECK_EQUAL(allocation_count - before, 0);
        BOOST_CHECK_GT(sim.data().contact_count(), 20u);
    }
}

BOOST_AUTO_TEST_SUITE_END()
