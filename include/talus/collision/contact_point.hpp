// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/types.hpp>

#include <algorithm>

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

template <int Dim>
void sort_by_feature(Column<ContactPoint<Dim>>& points) {
    std::sort(points.begin(), points.end(),
              [](const auto& x, const auto& y) { return x.feature < y.feature; });
}

}  // namespace talus
