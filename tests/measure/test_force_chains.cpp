// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/force_chains.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_force_chains)

/// Grains of volume 1 at places, each compressed along a direction.
template <int Dim>
struct Grains {
    using V = talus::Vector<Dim>;
    talus::Bodies<Dim> bodies;
    talus::ContactSet<Dim> contacts;
    std::vector<V> r;
    std::vector<talus::Matrix<Dim>> moments;
    std::vector<double> volume;

    talus::BodyIndex add(const V& at, const V& along, double compression) {
        moments.push_back(-compression * (along * along.transpose()));
        volume.push_back(1.0);
        return bodies.add({1.0, talus::AngularVector<Dim>::Constant(1.0)}, {at, {}});
    }
    void touch(talus::BodyIndex a, talus::BodyIndex b, double impulse = 1.0) {
        contacts.push_back(a, b, {});
        r.push_back(impulse * V::Unit(0));
    }
    talus::ForceChains chains(talus::ForceChainParams params = {}) const {
        return talus::force_chains<Dim>(bodies, contacts, r, moments, volume, params);
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_compressed_row_is_a_chain, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    Grains<Dim> g;
    // Five in a row, of which the last carries little; one beside the second, aligned with no one.
    for (int k = 0; k < 5; ++k) g.add(k * V::Unit(0), V::Unit(0), k < 4 ? 3.0 : 0.1);
    const auto beside = g.add(V::Unit(0) + V::Unit(1), V::Unit(0), 3.0);
    for (int k = 0; k < 4; ++k) g.touch(k, k + 1);
    g.touch(1, beside);
    const auto found = g.chains();
    BOOST_REQUIRE(found.chains.size() == 1u);
    BOOST_TEST(found.chains[0] == std::vector<talus::BodyIndex>({0, 1, 2, 3}),
               boost::test_tools::per_element());
    BOOST_TEST(found.grains() == 4u);
    BOOST_CHECK_CLOSE(found.mean, (5 * 3.0 + 0.1) / 6, 1e-12);
    BOOST_CHECK_CLOSE(found.compression[1], 3.0, 1e-12);
    BOOST_TEST(g.chains({.least_length = 5}).chains.empty());
    BOOST_TEST(g.chains({.least_impulse = 1.0}).chains.empty());
}

// Where a chain could branch the best aligned goes on.
BOOST_AUTO_TEST_CASE(chains_do_not_branch) {
    using V = talus::Vector<2>;
    Grains<2> g;
    const V x = V::Unit(0);
    g.add(V(0, 0), x, 1.0);
    g.add(V(1, 0), x, 1.0);
    g.add(V(1.9, 0.5), x, 1.0);
    g.add(V(2, -0.1), x, 1.0);
    g.add(V(3, 0.0), x, 1.0);
    g.touch(0, 1);
    g.touch(1, 2);
    g.touch(1, 3);
    g.touch(2, 4);
    g.touch(3, 4);
    const auto found = g.chains();
    BOOST_REQUIRE(found.chains.size() == 1u);
    BOOST_TEST(found.chains[0] == std::vector<talus::BodyIndex>({0, 1, 3, 4}),
               boost::test_tools::per_element());
    // The narrower angle leaves no way around the bend of a sixth of a radian.
    BOOST_TEST(g.chains({.angle = 0.05}).chains.empty());
}

BOOST_AUTO_TEST_CASE(a_ring_is_one_chain) {
    Grains<2> g;
    constexpr int n = 12;
    for (int k = 0; k < n; ++k) {
        const double at = 2.0 * std::numbers::pi * k / n;
        g.add({std::cos(at), std::sin(at)}, {-std::sin(at), std::cos(at)}, 2.0);
    }
    g.touch(0, 1);
    g.touch(0, n - 1);
    for (int k = 1; k + 1 < n; ++k) g.touch(k, k + 1);
    BOOST_REQUIRE(g.chains().chains.size() == 1u);
    BOOST_TEST(g.chains().chains[0].size() == 12u);
    BOOST_TEST(g.chains().chains[0].front() == 0);
    BOOST_TEST(g.chains({.angle = std::numbers::pi / 13}).chains.empty());
}

BOOST_AUTO_TEST_CASE(what_does_not_belong_together_is_refused) {
    Grains<2> g;
    BOOST_TEST(g.chains().chains.empty());
    g.add({0, 0}, {1, 0}, 1.0);
    for (const double angle : {0.0, -1.0, std::numbers::pi / 2})
        BOOST_CHECK_THROW(g.chains({.angle = angle}), talus::input_error);
    g.volume[0] = 0.0;
    BOOST_CHECK_THROW(g.chains(), talus::input_error);
    g.volume.clear();
    BOOST_CHECK_THROW(g.chains(), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
