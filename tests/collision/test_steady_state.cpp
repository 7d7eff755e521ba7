// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include "common/allocation_counter.hpp"
#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(collision_steady_state)

BOOST_AUTO_TEST_CASE_TEMPLATE(a_repeated_query_allocates_nothing_and_repeats_its_bits, D,
                              dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(16);
    std::vector<talus::AnyShape<Dim>> shapes;
    for (int kind = 0; kind < 4; ++kind)
        shapes.push_back(random_geometry::convex_shape<Dim>(g, kind, 1.0));
    shapes.push_back(talus::HalfSpace<Dim>(talus::Vector<Dim>::Unit(0)));
    shapes.push_back(talus::Compound<Dim>(
        {{talus::Ball<Dim>(0.5), {}}, {talus::Box<Dim>(talus::Vector<Dim>::Constant(0.4)), {}}}));
    talus::Column<talus::ContactPoint<Dim>> out;
    for (int trial = 0; trial < 20; ++trial)
        for (const auto& a : shapes)
            for (const auto& b : shapes) {
                const auto at = random_geometry::pose<Dim>(g, 1.5);
                out.clear();
                talus::contact_points<Dim>(a, at, b, talus::Pose<Dim>{}, 0.1, out);
                const std::size_t count = out.size();
                out.reserve(2 * count);
                const long before = allocation_count;
                talus::contact_points<Dim>(a, at, b, talus::Pose<Dim>{}, 0.1, out);
                BOOST_CHECK_EQUAL(allocation_count - before, 0);
                BOOST_REQUIRE_EQUAL(out.size(), 2 * count);
                for (std::size_t i = 0; i < count; ++i) {
                    BOOST_CHECK(out[i].feature == out[count + i].feature);
                    BOOST_CHECK(out[i].point == out[count + i].point);
                    BOOST_CHECK_EQUAL(out[i].gap, out[count + i].gap);
                }
            }
}

BOOST_AUTO_TEST_SUITE_END()
