// SPDX-License-Identifier: BSL-1.0
#include <talus/assembly/impulse_cache.hpp>
#include <talus/spatial/local_frame.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(assembly_impulse_cache)

template <int Dim>
void add(talus::ContactSet<Dim>& contacts, talus::ContactJacobian<Dim>& jacobian,
         talus::ContactKey key, const talus::Vector<Dim>& normal) {
    contacts.push_back(key.a, key.b, {talus::Vector<Dim>::Zero(), normal, 0.0, key.feature});
    const std::size_t n = contacts.count();
    jacobian.resize(n);
    jacobian.frame[n - 1] = talus::local_frame<Dim>(normal);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(impulses_return_in_world_axes_to_the_contact_of_the_same_key, D,
                              dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    std::mt19937 rng(81);
    talus::ContactSet<Dim> before, after;
    talus::ContactJacobian<Dim> j_before, j_after;
    for (const auto& key : {talus::ContactKey{0, 1, {3}}, {0, 1, {5}}, {0, 2, {0}}, {4, 7, {1}}})
        add<Dim>(before, j_before, key, random_input::unit<V>(rng));
    // One contact gone, one new in front, one new behind; all normals turned.
    for (const auto& key :
         {talus::ContactKey{0, 1, {1}}, {0, 1, {5}}, {0, 2, {0}}, {4, 7, {1}}, {5, 6, {0}}})
        add<Dim>(after, j_after, key, random_input::unit<V>(rng));
    std::vector<V> r(4), s(5, V::Constant(9.0));
    for (auto& x : r) x = random_input::vector<V>(rng);
    talus::ImpulseCache<Dim> cache;
    BOOST_CHECK_EQUAL(cache.recall(after, j_after, s), 0u);
    for (const auto& x : s) BOOST_CHECK(x.isZero(0.0));

    cache.store(before, j_before, r);
    BOOST_CHECK_EQUAL(cache.recall(after, j_after, s, 0.5), 3u);
    BOOST_CHECK(s[0].isZero(0.0) && s[4].isZero(0.0));
    for (const auto& [old, now] : {std::pair{1u, 1u}, {2u, 2u}, {3u, 3u}}) {
        const V world = j_after.frame[now].transpose() * s[now];
        BOOST_CHECK_SMALL((world - 0.5 * (j_before.frame[old].transpose() * r[old])).norm(), 1e-15);
    }
}

BOOST_AUTO_TEST_SUITE_END()
