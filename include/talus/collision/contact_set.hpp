// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>

#include <algorithm>
#include <cstddef>

namespace talus {

/// The contacts of one configuration, one array per field, in the order of their keys (body a, body
/// b, image of b, feature), a < b. Signs as in ContactPoint. In a periodic cell they are where body
/// a is.
template <int Dim>
requires SpaceDimension<Dim>
struct ContactSet {
    Column<ContactKey> key;
    Column<Vector<Dim>> point;   ///< [m]
    Column<Vector<Dim>> normal;  ///< unit, from b towards a
    Column<double> gap;          ///< [m]
    Column<Vector<Dim>> slide;   ///< of a past b until they touch there [m]
    /// From body b to the image of it that touches a [m]; empty where there is no periodic cell.
    Column<Vector<Dim>> offset;
    /// Ids of the bodies that the keys name by their indices; empty for contacts made by hand.
    PerBody<BodyId> body;

    std::size_t count() const { return key.size(); }
    /// Throws input_error unless the keys' indices are those of these bodies still: bodies that
    /// were removed since have moved them, bodies that were added do no harm. Of contacts made by
    /// hand, that there are such bodies. O(bodies), by hand O(contacts).
    void require_bodies(const PerBody<BodyId>& id) const {
        const auto [ours, theirs] = std::mismatch(body.begin(), body.end(), id.begin(), id.end());
        if (ours != body.end())
            throw input_error(
                detail::numbered("body id is", static_cast<std::size_t>(ours->serial),
                                 ", but must be that of a body that was not removed after its "
                                 "contacts were found: what reads them comes before the removal"));
        if (!body.empty()) return;
        for (const ContactKey& k : key)
            if (k.a < 0 || static_cast<std::size_t>(std::max(k.a, k.b)) >= id.size())
                detail::reject(
                    "body of a contact", k.a < 0 ? k.a : std::max(k.a, k.b),
                    detail::numbered("an index from 0 below", id.size(), ", the number of bodies"));
    }
    void clear() {
        key.clear();
        point.clear();
        normal.clear();
        gap.clear();
        slide.clear();
        offset.clear();
        body.clear();
    }
    [[gnu::noinline]] void push_back(BodyIndex a, BodyIndex b, const ContactPoint<Dim>& c) {
        key.push_back({a, b, c.feature});
        point.push_back(c.point);
        normal.push_back(c.normal);
        gap.push_back(c.gap);
        slide.push_back(c.slide);
    }
    /// With an image of b: in a periodic cell all contacts are added so.
    [[gnu::noinline]] void push_back(BodyIndex a, BodyIndex b, const ContactPoint<Dim>& c,
                                     const ImageShift& image, const Vector<Dim>& to_image) {
        push_back(a, b, c);
        key.back().image = image;
        offset.push_back(to_image);
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
            if (!offset.empty()) offset[kept] = offset[c];
            ++kept;
        }
        key.resize(kept);
        point.resize(kept);
        normal.resize(kept);
        gap.resize(kept);
        slide.resize(kept);
        if (!offset.empty()) offset.resize(kept);
    }
};

}  // namespace talus
