// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// What counts in a network of contacts.
struct ContactNetworkParams {
    /// Normal impulse above which a contact bears [N s], not negative: a small part of the mean one
    /// where the solver's errors are to be left out.
    double least_impulse = 0.0;
    /// Bearing contact points below which a body is a rattler [-]: it can be taken out and the rest
    /// holds. Between contacts alone (no gravity) a ball needs Dim + 1 without friction and 2 with
    /// it. Under gravity one that lies on others needs Dim, or 1, and bears nothing but itself.
    std::size_t least_contacts = 2;
};

/// The bodies and contacts that bear, without rattlers.
struct ContactNetwork {
    std::size_t bodies = 0;         ///< free ones, rattlers not counted
    std::size_t rattlers = 0;       ///< free ones
    std::size_t contacts = 0;       ///< points between two of these bodies
    std::size_t pairs = 0;          ///< of these bodies: a side on a side is one, with two points
    std::size_t wall_contacts = 0;  ///< points between one of them and an obstacle
    std::size_t wall_pairs = 0;
    std::vector<bool> is_rattler;  ///< by body; false for obstacles
    std::vector<bool> bears;       ///< by contact

    /// Mean number of contact points on a body, Z; 0 without bodies. Those with obstacles have one
    /// end in the network. A rigid frictionless packing of balls has 2 Dim but for its boundary
    /// [Moukarzel1998].
    double coordination() const { return share(2 * contacts + wall_contacts); }
    /// Mean number of bodies that a body touches, obstacles included.
    double neighbours() const { return share(2 * pairs + wall_pairs); }
    /// Part of the free bodies that are rattlers; 0 without any.
    double rattler_share() const {
        const std::size_t all = bodies + rattlers;
        return all > 0 ? static_cast<double>(rattlers) / static_cast<double>(all) : 0.0;
    }

  private:
    double share(std::size_t ends) const {
        return bodies > 0 ? static_cast<double>(ends) / static_cast<double>(bodies) : 0.0;
    }
};

/// Takes rattlers out of the bearing contacts, one after the other until none is left: what touched
/// one of them may be one itself. The result does not depend on their order. `contacts` in the
/// order of their keys, r the impulses, normal first [N s]. O(bodies + contacts). Throws
/// input_error unless there is one impulse per contact and their bodies are there, and for a
/// negative `least_impulse`.
template <int Dim>
ContactNetwork contact_network(const Bodies<Dim>& bodies, const ContactSet<Dim>& contacts,
                               std::span<const Vector<Dim>> r, ContactNetworkParams params = {}) {
    require_count("impulses", r.size(), "contacts", contacts.count());
    contacts.require_bodies(bodies.id);
    require_non_negative("least_impulse", params.least_impulse);
    const std::size_t n = bodies.count();
    ContactNetwork network;
    network.is_rattler.assign(n, false);
    network.bears.assign(contacts.count(), false);
    std::vector<std::size_t> ends(n, 0);
    // Contacts of each body, one body after the other.
    std::vector<std::size_t> first(n + 1, 0), of_body;
    for (std::size_t c = 0; c < contacts.count(); ++c) {
        if (!(r[c][0] > params.least_impulse)) continue;
        network.bears[c] = true;
        for (const BodyIndex i : {contacts.key[c].a, contacts.key[c].b})
            ++ends[static_cast<std::size_t>(i)];
    }
    for (std::size_t i = 0; i < n; ++i) first[i + 1] = first[i] + ends[i];
    of_body.resize(first[n]);
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t c = 0; c < contacts.count(); ++c)
        if (network.bears[c])
            for (const BodyIndex i : {contacts.key[c].a, contacts.key[c].b})
                of_body[next[static_cast<std::size_t>(i)]++] = c;

    std::vector<std::size_t> loose;
    const auto look_at = [&](std::size_t i) {
        if (bodies.is_obstacle(i) || network.is_rattler[i] || ends[i] >= params.least_contacts)
            return;
        network.is_rattler[i] = true;
        loose.push_back(i);
    };
    for (std::size_t i = 0; i < n; ++i) look_at(i);
    while (!loose.empty()) {
        const std::size_t i = loose.back();
        loose.pop_back();
        ++network.rattlers;
        for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
            const std::size_t c = of_body[k];
            if (!network.bears[c]) continue;
            network.bears[c] = false;
            const auto a = static_cast<std::size_t>(contacts.key[c].a);
            const auto b = static_cast<std::size_t>(contacts.key[c].b);
            --ends[a];
            --ends[b];
            look_at(a == i ? b : a);
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        network.bodies += !bodies.is_obstacle(i) && !network.is_rattler[i] ? 1 : 0;
    ContactKey last{-1, -1, {}};
    for (std::size_t c = 0; c < contacts.count(); ++c) {
        if (!network.bears[c]) continue;
        const ContactKey& key = contacts.key[c];
        const bool wall = bodies.is_obstacle(key.a) || bodies.is_obstacle(key.b);
        const bool another = key.a != last.a || key.b != last.b || key.image != last.image;
        ++(wall ? network.wall_contacts : network.contacts);
        if (another) ++(wall ? network.wall_pairs : network.pairs);
        last = key;
    }
    return network;
}

}  // namespace talus
