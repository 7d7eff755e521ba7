// SPDX-License-Identifier: BSL-1.0
#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/effort.hpp"
#include "common/pair_tester.hpp"

BOOST_AUTO_TEST_SUITE(collision_convex_pairs)

/// Random placements of random shapes of two kinds: most of them touch.
template <int Dim>
void try_kinds(int kind_a, int kind_b, double scale) {
    BOOST_TEST_CONTEXT("kinds " << kind_a << ", " << kind_b << ", dimension " << Dim << ", scale "
                                << scale) {
        random_geometry::Generator g(20u + static_cast<unsigned>(10 * kind_a + kind_b));
        for (int trial = 0; trial < repetitions(40, 4); ++trial) {
            const auto a = random_geometry::convex_shape<Dim>(g, kind_a, scale);
            const auto b = random_geometry::convex_shape<Dim>(g, kind_b, scale);
            const auto at_a = random_geometry::pose<Dim>(g, scale);
            auto at_b = random_geometry::pose<Dim>(g, scale);
            at_b.position = at_a.position + scale * random_geometry::displacement<Dim>(g, 0.4, 2.4);
            BOOST_TEST_CONTEXT("trial " << trial)
            PairTester<Dim>(a, b, scale).check(at_a, at_b, trial % 2 == 0 ? 0.0 : 0.2 * scale);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_pair_agrees_with_dense_direction_sampling, D, dimensions) {
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) try_kinds<D::value>(a, b, 1.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(grains_of_a_micron_are_treated_like_grains_of_a_metre, D,
                              dimensions) {
    for (int a = 1; a < 4; ++a) try_kinds<D::value>(a, 3, 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
