// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>

#include <cstddef>
#include <vector>

namespace talus {

/// The contacts of one configuration, one array per field, in the order of their keys (body a, body
/// b, feature), a < b. Signs as in ContactPoint.
template <int Dim>
requires SpaceDimension<Dim>
struct ContactSet {
    std::vector<ContactKey> key;
    std::vector<Vector<Dim>> point;   ///< [m]
    std::vector<Vector<Dim>> normal;  ///< unit, from b towards a
    std::vector<double> gap;          ///< [m]
    std::vector<Vector<Dim>> slide;   ///< of a past b until they touch there [m]

    std::size_t count() const { return key.size(); }
    void clear() {
        key.clear();
        point.clear();
        normal.clear();
        gap.clear();
        slide.clear();
    }
    void push_back(BodyIndex a, BodyIndex b, const ContactPoint<Dim>& c) {
        key.push_back({a, b, c.feature});
        point.push_back(c.point);
        normal.push_back(c.normal);
        gap.push_back(c.gap);
        slide.push_back(c.slide);
    }
    /// Keeps, in their order, the contacts c for which `keep(c)` holds.
    template <class Keep>
    void keep_if(Keep&& keep) {
        std::size_t kept = 0;
        for (std::size_t c = 0; c < count(); ++c) {
            if (!keep(c)) continue;
            key[kept] = key[c];
            point[kept] = point[c];
            normal[kept] = normal[c];
            gap[kept] = gap[c];
            slide[kept] = slide[c];
            ++kept;
        }
        key.resize(kept);
        point.resize(kept);
        normal.resize(kept);
        gap.resize(kept);
        slide.resize(kept);
    }
};

}  // namespace talus
