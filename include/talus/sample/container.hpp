// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/geometry/half_space.hpp>

#include <vector>

namespace talus {

/// Which sides of a box have walls.
enum class Lid {
    open,   ///< all but the top, the high end of the last axis
    closed  ///< all
};

/// The walls of a box between two corners [m], as half-spaces whose solid is outside: the floor
/// first, then those of the other axes, low and high, then the lid. Throws input_error unless low <
/// high along each axis.
///
///     const Vector<3> low(0.0, 0.0, 0.0), high(1.0, 1.0, 2.0);
///     for (const auto& wall : container<3>(low, high)) sim.system().add_obstacle(wall);
template <int Dim>
std::vector<HalfSpace<Dim>> container(const Vector<Dim>& low, const Vector<Dim>& high,
                                      Lid lid = Lid::open) {
    require_finite("low corner of the container", low);
    require_finite("high corner of the container", high);
    for (int k = 0; k < Dim; ++k)
        if (!(low[k] < high[k]))
            detail::reject("high corner of the container", high[k],
                           "above the low one, " + detail::text_of(low[k]));
    constexpr int top = Dim - 1;
    std::vector<HalfSpace<Dim>> walls{HalfSpace<Dim>(Vector<Dim>::Unit(top), low[top])};
    for (int k = 0; k < top; ++k) {
        walls.emplace_back(Vector<Dim>::Unit(k), low[k]);
        walls.emplace_back(-Vector<Dim>::Unit(k), -high[k]);
    }
    if (lid == Lid::closed) walls.emplace_back(-Vector<Dim>::Unit(top), -high[top]);
    return walls;
}

}  // namespace talus
