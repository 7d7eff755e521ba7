// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_polyhedron.hpp>

#include <vector>

/// Corners of a random grain: a polygon in the plane, a polyhedron in space.
template <int Dim>
struct RandomGrain {
    std::vector<talus::Vector<Dim>> operator()(talus::Random& random, double radius) const {
        if constexpr (Dim == 2)
            return talus::random_polygon(random, radius);
        else
            return talus::random_polyhedron(random, radius);
    }
};
