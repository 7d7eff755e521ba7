// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/contact_network.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "press.hpp"

namespace lab {

/// What bears in a packing of balls: grains that bear nothing are left out, and contacts that bear
/// less than a thousandth of the mean.
struct Packing {
    double grains = 0, solid = 0;                ///< [-]
    double contacts = 0, freedom = 0, ends = 0;  ///< that bear; of grains that do; on such grains
    double bearing = 0;                          ///< grains that bear
    std::vector<double> normal_forces = {};      ///< between grains that bear [N]
    double coordination() const { return bearing > 0.0 ? ends / bearing : 0.0; }
};

/// The grains of a box whose axes all have lids, after a step, with their friction coefficient.
template <int Dim>
Packing measure_packing(const talus::Simulation<Dim>& sim, const PressedBox<Dim>& box, double mu) {
    const auto& bodies = sim.system().bodies;
    const auto& data = sim.data();
    const std::span<const talus::Vector<Dim>> impulses(data.impulse.begin(), data.impulse.end());
    // Without friction a ball is held by Dim + 1 others, with it by two.
    double sum = 0.0, count = 0.0;
    for (const auto& r : impulses)
        if (r[0] > 0.0) sum += r[0], ++count;
    const auto network =
        talus::contact_network<Dim>(bodies, data.contacts, impulses,
                                    {.least_impulse = count > 0.0 ? 1e-3 * sum / count : 0.0,
                                     .least_contacts = mu > 0.0 ? 2 : Dim + std::size_t{1}});
    Packing p;
    p.grains = static_cast<double>(box.grains());
    p.solid = box.solid_fraction(bodies);
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        if (!network.bears[c]) continue;
        ++p.contacts;
        for (const auto i : {data.contacts.key[c].a, data.contacts.key[c].b})
            p.ends += static_cast<std::size_t>(i) < box.grains() ? 1.0 : 0.0;
        const auto& key = data.contacts.key[c];
        if (static_cast<std::size_t>(std::max(key.a, key.b)) < box.grains())
            p.normal_forces.push_back(data.impulse[c][0] / data.h);
    }
    for (std::size_t i = 0; i < box.grains(); ++i) p.bearing += network.is_rattler[i] ? 0.0 : 1.0;
    p.freedom = Dim * p.bearing + Dim;  // each lid has one of its own
    return p;
}

}  // namespace lab
