// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/hierarchical_grid.hpp>

#include "common/broad_phase_tester.hpp"
#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(broad_phase)

BOOST_AUTO_TEST_CASE_TEMPLATE(brute_force_is_a_broad_phase, D, dimensions) {
    test_broad_phase<D::value, talus::BruteForce<D::value>>(81);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(hierarchical_grid_is_a_broad_phase, D, dimensions) {
    for (unsigned seed = 82; seed < 92; ++seed)
        test_broad_phase<D::value, talus::HierarchicalGrid<D::value>>(seed);
}

BOOST_AUTO_TEST_SUITE_END()
