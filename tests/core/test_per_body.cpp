// SPDX-License-Identifier: BSL-1.0
#include <talus/core/ids.hpp>
#include <talus/core/per_body.hpp>
#include <talus/dynamics/bodies.hpp>

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

BOOST_AUTO_TEST_SUITE(core_per_body)

BOOST_AUTO_TEST_CASE(any_integer_is_an_index) {
    talus::PerBody<double> mass = {1.0, 2.0, 3.0};
    const talus::BodyIndex body = 1;
    mass[body] = 5.0;
    BOOST_CHECK_EQUAL(mass[std::size_t{1}], 5.0);
    BOOST_CHECK_EQUAL(mass[1u], 5.0);
    BOOST_CHECK_EQUAL(mass[std::int64_t{1}], 5.0);
    const auto& same = mass;
    BOOST_CHECK_EQUAL(&same[body], mass.data() + 1);
    static_assert(std::is_same_v<decltype(same[body]), const double&>);
}

BOOST_AUTO_TEST_CASE(else_it_is_a_vector) {
    const talus::PerBody<int> a(3, 7), b = {7, 7, 7};
    BOOST_CHECK(a == b);
    const std::vector<int>& base = a;
    const std::span<const int> view = a;
    BOOST_CHECK_EQUAL(base.size(), view.size());
    static_assert(std::is_nothrow_move_constructible_v<talus::PerBody<int>>);
}

BOOST_AUTO_TEST_CASE(bodies_are_asked_by_their_index) {
    talus::Bodies<2> bodies;
    bodies.add_obstacle({});
    const talus::BodyIndex body = bodies.add({2.0, talus::AngularVector<2>::Constant(1.0)}, {});
    BOOST_CHECK_EQUAL(bodies.mass(body), 2.0);
    BOOST_TEST(!bodies.is_obstacle(body));
    BOOST_CHECK(bodies.pose(body).position == bodies.position[body]);
}

BOOST_AUTO_TEST_SUITE_END()
