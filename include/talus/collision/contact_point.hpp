// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/types.hpp>

#include <cstddef>

namespace talus {

/// A place where two shapes touch, nearly touch or overlap.
///
/// Signs, for all of talus: `gap` > 0 apart, < 0 overlapping; `normal` points from B towards A; so
/// the relative velocity u = velocity of A minus velocity of B has u_n > 0 when separating, and an
/// impulse with r_n > 0 pushes A along n (and B along -n).
template <int Dim>
requires SpaceDimension<Dim>
struct ContactPoint {
    /// One place for both bodies, half-way between the two surfaces; where `slide` is not zero,
    /// half-way between the places on them that will meet [m].
    Vector<Dim> point = Vector<Dim>::Zero();
    Vector<Dim> normal = Vector<Dim>::Zero();  ///< unit, world axes, from B towards A
    double gap = 0.0;                          ///< signed distance along the normal [m]
    FeatureId feature = {};                    ///< touching features, of A first
    /// How far A is to go past B before they touch at this place, zero for bodies seen as they
    /// stand: the arm of A then ends at point - slide / 2, that of B at point + slide / 2 [m].
    Vector<Dim> slide = Vector<Dim>::Zero();
};

/// By insertion, since one pair has few contacts, which mostly come in order; of many first in wide
/// strides.
template <int Dim>
void sort_by_feature(Column<ContactPoint<Dim>>& points) {
    for (const std::size_t stride : {701u, 301u, 132u, 57u, 23u, 1u})
        for (std::size_t i = stride; i < points.size(); ++i) {
            if (!(points[i].feature < points[i - stride].feature)) continue;
            const ContactPoint<Dim> point = points[i];
            std::size_t k = i;
            for (; k >= stride && point.feature < points[k - stride].feature; k -= stride)
                points[k] = points[k - stride];
            points[k] = point;
        }
}

}  // namespace talus
