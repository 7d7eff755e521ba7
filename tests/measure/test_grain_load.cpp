// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/grain_load.hpp>
#include <talus/measure/penetration.hpp>
#include <talus/spatial/local_frame.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_grain_load)

BOOST_AUTO_TEST_CASE_TEMPLATE(the_floor_gives_what_the_stack_weighs, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    // Body 0 is the floor, 1 rests on it, 2 rests on 1; normals from the higher index to the lower
    // one point down.
    talus::ContactJacobian<Dim> j;
    j.resize(2);
    j.a = {0, 1};
    j.b = {1, 2};
    for (auto& f : j.frame) f = talus::local_frame<Dim>(V(-V::Unit(Dim - 1)));
    std::vector<V> r(2, V::Zero());
    r[0][0] = 5.0;
    r[1][0] = 2.0;
    std::vector<double> load;
    talus::grain_load<Dim>(j, r, 3, load);
    BOOST_CHECK_EQUAL(load[0], 5.0);
    BOOST_CHECK_EQUAL(load[1], 7.0);
    BOOST_CHECK_EQUAL(load[2], 2.0);
    BOOST_CHECK_THROW(talus::grain_load<Dim>(j, r, 2, load), talus::input_error);  // 2 has gone
    const V up = talus::impulse_from<Dim>(j, r, [](std::size_t i) { return i == 0; });
    BOOST_CHECK_EQUAL(up, V(5.0 * V::Unit(Dim - 1)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(penetration_counts_gaps_as_zero, D, dimensions) {
    constexpr int Dim = D::value;
    talus::ContactSet<Dim> contacts;
    for (double gap : {-0.3, 0.2, -0.1})
        contacts.push_back(0, 1,
                           {talus::Vector<Dim>::Zero(), talus::Vector<Dim>::Unit(0), gap, {}});
    const auto all = talus::penetration(contacts);
    BOOST_CHECK_EQUAL(all.max, 0.3);
    BOOST_CHECK_CLOSE(all.mean, 0.4 / 3.0, 1e-12);
    const auto last = talus::penetration(contacts, [](std::size_t c) { return c == 2; });
    BOOST_CHECK_EQUAL(last.max, 0.1);
    BOOST_CHECK_EQUAL(last.contact_count, 1u);
    BOOST_CHECK_EQUAL(talus::penetration(talus::ContactSet<Dim>{}).mean, 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
