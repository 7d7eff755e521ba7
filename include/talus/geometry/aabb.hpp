// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <limits>

namespace talus {

/// Box with sides along the world axes. The default is empty; unbounded shapes have infinite sides.
template <int Dim>
requires SpaceDimension<Dim>
struct Aabb {
    Vector<Dim> low = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());    ///< [m]
    Vector<Dim> high = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity());  ///< [m]

    bool overlaps(const Aabb& o) const {
        bool meet = true;
        for (int k = 0; k < Dim; ++k) meet = meet && low[k] <= o.high[k] && o.low[k] <= high[k];
        return meet;
    }
    bool bounded() const { return low.allFinite() && high.allFinite(); }
    Aabb expanded(double margin) const {
        return {low - Vector<Dim>::Constant(margin), high + Vector<Dim>::Constant(margin)};
    }
    void include(const Vector<Dim>& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    void include(const Aabb& o) {
        low = low.cwiseMin(o.low);
        high = high.cwiseMax(o.high);
    }
};

}  // namespace talus
