// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>

#include <algorithm>
#include <cstddef>

namespace talus {

/// Overlap of the bodies at their contacts.
struct Penetration {
    double max = 0.0;               ///< deepest, 0 if there is none [m]
    double mean = 0.0;              ///< over the contacts that count, gaps as 0 [m]
    std::size_t contact_count = 0;  ///< contacts that count
};

/// Penetration over the contacts for which `counts(c)` holds (all, by default): those that carry an
/// impulse, say.
template <int Dim, class Counts>
Penetration penetration(const ContactSet<Dim>& contacts, Counts&& counts) {
    Penetration result;
    double sum = 0.0;
    for (std::size_t c = 0; c < contacts.count(); ++c) {
        if (!counts(c)) continue;
        const double depth = std::max(0.0, -contacts.gap[c]);
        result.max = std::max(result.max, depth);
        sum += depth;
        ++result.contact_count;
    }
    if (result.contact_count > 0) result.mean = sum / static_cast<double>(result.contact_count);
    return result;
}

template <int Dim>
Penetration penetration(const ContactSet<Dim>& contacts) {
    return penetration(contacts, [](std::size_t) { return true; });
}

}  // namespace talus
