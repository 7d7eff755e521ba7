// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/contact_network.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(measure_contact_network)

/// Obstacles 0 and 1, then free bodies; contacts by hand, in order, each with its normal impulse.
template <int Dim>
struct Net {
    talus::Bodies<Dim> bodies;
    talus::ContactSet<Dim> contacts;
    std::vector<talus::Vector<Dim>> r;

    explicit Net(int free) {
        for (int k = 0; k < 2; ++k) bodies.add_obstacle({});
        for (int k = 0; k < free; ++k)
            bodies.add({1.0, talus::AngularVector<Dim>::Constant(1.0)}, {});
    }
    void touch(talus::BodyIndex a, talus::BodyIndex b, double impulse = 1.0,
               std::uint64_t feature = 0) {
        contacts.push_back(a, b, {.feature = {feature}});
        r.push_back(impulse * talus::Vector<Dim>::Unit(0));
    }
    talus::ContactNetwork network(talus::ContactNetworkParams params = {}) const {
        return talus::contact_network<Dim>(bodies, contacts, r, params);
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(what_holds_nothing_is_taken_out_one_after_the_other, D, dimensions) {
    constexpr int Dim = D::value;
    // A row 0 - 2 - 3 - 1 between the walls; 4 hangs on 3, 5 on 4; 6 touches nothing.
    Net<Dim> net(5);
    net.touch(0, 2);
    net.touch(1, 3);
    net.touch(2, 3);
    net.touch(3, 4);
    net.touch(4, 5);
    const auto network = net.network();
    BOOST_TEST(network.bodies == 2u);
    BOOST_TEST(network.rattlers == 3u);
    BOOST_TEST(network.contacts == 1u);
    BOOST_TEST(network.wall_contacts == 2u);
    BOOST_TEST(network.coordination() == 2.0);
    BOOST_TEST(network.neighbours() == 2.0);
    BOOST_TEST(network.rattler_share() == 0.6);
    BOOST_TEST(
        network.is_rattler == std::vector<bool>({false, false, false, false, true, true, true}),
        boost::test_tools::per_element());
    BOOST_TEST(network.bears == std::vector<bool>({true, true, true, false, false}),
               boost::test_tools::per_element());
    // One that must have three brings all of it down.
    BOOST_TEST(net.network({.least_contacts = 3}).bodies == 0u);
    BOOST_TEST(net.network({.least_contacts = 3}).coordination() == 0.0);
    BOOST_TEST(net.network({.least_contacts = 0}).rattlers == 0u);
}

BOOST_AUTO_TEST_CASE(sides_are_two_points_of_one_neighbour) {
    Net<2> net(2);
    net.touch(0, 2, 1.0, 0);
    net.touch(0, 2, 1.0, 1);
    net.touch(2, 3, 0.5, 0);
    net.touch(2, 3, 0.0, 1);
    net.touch(2, 3, 0.5, 2);
    const auto network = net.network();
    BOOST_TEST(network.contacts == 2u);
    BOOST_TEST(network.pairs == 1u);
    BOOST_TEST(network.wall_contacts == 2u);
    BOOST_TEST(network.wall_pairs == 1u);
    BOOST_TEST(network.coordination() == 3.0);
    BOOST_TEST(network.neighbours() == 1.5);
    BOOST_TEST(net.network({.least_impulse = 0.7}).bodies == 1u);
}

BOOST_AUTO_TEST_CASE(rattlers_are_those_of_passes_until_nothing_changes) {
    std::mt19937 rng(5);
    for (int trial = 0; trial < 200; ++trial) {
        const int n = 12;
        Net<2> net(n);
        for (talus::BodyIndex a = 0; a < n + 2; ++a)
            for (talus::BodyIndex b = std::max(a + 1, 2); b < n + 2; ++b)
                if (random_input::uniform(rng, 0.0, 1.0) < 0.2) net.touch(a, b);
        const std::size_t least = trial % 2 == 0 ? 2 : 3;
        std::vector<bool> out(n + 2, false);
        for (bool changes = true; changes;) {
            changes = false;
            for (std::size_t i = 2; i < out.size(); ++i) {
                std::size_t count = 0;
                for (const auto& key : net.contacts.key) {
                    const auto a = static_cast<std::size_t>(key.a);
                    const auto b = static_cast<std::size_t>(key.b);
                    count += (a == i || b == i) && !out[a] && !out[b] ? 1 : 0;
                }
                if (out[i] || count >= least) continue;
                out[i] = changes = true;
            }
        }
        BOOST_TEST(net.network({.least_contacts = least}).is_rattler == out,
                   boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(what_does_not_belong_together_is_refused) {
    Net<2> net(1);
    net.touch(0, 2);
    BOOST_CHECK_THROW(net.network({.least_impulse = -1.0}), talus::input_error);
    net.r.clear();
    BOOST_CHECK_THROW(net.network(), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
