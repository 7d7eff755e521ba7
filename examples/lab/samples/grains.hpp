// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/feed/inlet.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/sample/granulometry.hpp>

#include "../../random_grain.hpp"

namespace lab {

/// Convex grains with corners, irregular, as far as the radius from their centre: polygons in the
/// plane, polyhedra in space.
template <int Dim, talus::RadiusLaw Law>
talus::ShapeSource<Dim> angular_grains(Law radii) {
    return [radii](talus::Random& random) {
        return talus::AnyShape<Dim>(
            talus::ConvexPolytope<Dim>(RandomGrain<Dim>()(random, radii(random))));
    };
}

/// Round grains, or those with corners.
template <int Dim, talus::RadiusLaw Law>
talus::ShapeSource<Dim> grains(bool angular, Law radii) {
    return angular ? angular_grains<Dim>(radii) : talus::balls<Dim>(radii);
}

}  // namespace lab
